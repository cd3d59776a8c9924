#!/bin/sh
# Runs SCRIPT in a virtual environment with the requirements.txt beside it, made once. No network and no environment: the test fails.
#   in_venv.sh VENV SCRIPT ARGUMENT...
set -eu
venv=$1
shift
wanted=$(dirname "$1")/requirements.txt
if ! cmp -s "$wanted" "$venv/installed.txt"; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$wanted"
  cp "$wanted" "$venv/installed.txt"
fi
exec "$venv/bin/python" "$@"
