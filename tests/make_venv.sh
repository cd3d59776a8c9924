#!/bin/sh
# Makes a virtual environment with what a requirements file names, once, also where several tests want it at one time.
#   make_venv.sh VENV REQUIREMENTS
set -eu
venv=$1 wanted=$2
mkdir -p "$(dirname "$venv")"
exec 9>"$venv.lock"
flock 9
if ! cmp -s "$wanted" "$venv/installed.txt"; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$wanted"
  cp "$wanted" "$venv/installed.txt"
fi
