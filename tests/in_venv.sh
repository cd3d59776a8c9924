#!/bin/sh
# Runs SCRIPT in a virtual environment with the requirements.txt beside it, made once, also where several tests want it at one time.
# No network and no environment: the test fails.
#   in_venv.sh VENV SCRIPT ARGUMENT...
set -eu
venv=$1
shift
wanted=$(dirname "$1")/requirements.txt
exec 9>"$venv.lock"
flock 9
if ! cmp -s "$wanted" "$venv/installed.txt"; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$wanted"
  cp "$wanted" "$venv/installed.txt"
fi
exec 9>&-
exec "$venv/bin/python" "$@"
