#!/bin/sh
# Writes the manual page of the command line from what it says about itself, subcommand by subcommand.
#   manual-page.sh PROGRAM PAGE       HELP2MAN: the help2man to use
set -eu
program=$1 page=$2
mkdir -p "$(dirname "$page")"
# As it stands, in a block that nothing fills: backslashes, and dots and quotes at the beginning of a line, are words to troff.
verbatim() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; }

for command in $("$program" --help | sed -n '/^Subcommands:/,/^[^ ]/s/^  \([a-z][a-z-]*\) .*/\1/p'); do
  printf '[>onset %s]\n.nf\n' "$command"
  "$program" "$command" --help | verbatim
  printf '.fi\n'
done >"$page.include"
grep -q '^\[>onset step\]' "$page.include"
SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-0}" "${HELP2MAN:-help2man}" --no-info --section=1 --name="conservative continuous collision detection" \
  --include="$page.include" --output="$page" "$program"
rm "$page.include"
