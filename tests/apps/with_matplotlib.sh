#!/bin/sh
# Runs a Python script with matplotlib: the system's, or else one in a virtual environment, made once. Neither: skipped (77).
#   with_matplotlib.sh VENV SCRIPT
set -eu
venv=$1
python=python3
if ! python3 -c 'import matplotlib, numpy' 2>/dev/null; then
  python="$venv/bin/python"
  "$python" -c 'import matplotlib' 2>/dev/null ||
    { python3 -m venv "$venv" && "$python" -m pip install --quiet --disable-pip-version-check matplotlib==3.11.2; } || {
      echo "skipped: matplotlib is neither installed nor to be had"
      exit 77
    }
fi
exec "$python" -B "$2"
