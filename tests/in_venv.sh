#!/bin/sh
# Makes the virtual environment, once, and runs the comparison in it. No network and no environment: the test fails.
#   run.sh VENV PRINT_IPC_STEPS
set -eu
here=$(cd "$(dirname "$0")" && pwd)
venv=$1
if ! cmp -s "$here/requirements.txt" "$venv/installed.txt"; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$here/requirements.txt"
  cp "$here/requirements.txt" "$venv/installed.txt"
fi
exec "$venv/bin/python" "$here/steps_beside_ipctk.py" "$2"
