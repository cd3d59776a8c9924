#!/bin/sh
# Formats every C++ file with the one clang-format that the project is written in, or tells which are not so.
#   format.sh [--check]
set -eu
cd "$(dirname "$0")/.."
version=17.0.6
venv=build/venv-format-$version
if [ ! -x "$venv/bin/clang-format" ]; then
  scripts/install-packages.sh tests
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check "clang-format==$version"
fi
case "${1:-}" in
  "") options=-i ;;
  --check) options="--dry-run --Werror" ;;
  *) echo "usage: format.sh [--check]" >&2; exit 2 ;;
esac
# shellcheck disable=SC2086
git ls-files -z -- '*.cpp' '*.hpp' '*.inl' | xargs -0 -n 40 -P "$(nproc)" "$venv/bin/clang-format" --style=file $options
