#!/bin/sh
# Runs SCRIPT in a virtual environment with the requirements.txt beside it. No network and no environment: the test fails.
#   in_venv.sh VENV SCRIPT ARGUMENT...
set -eu
venv=$1
shift
"$(dirname "$0")/make_venv.sh" "$venv" "$(dirname "$1")/requirements.txt"
exec "$venv/bin/python" "$@"
