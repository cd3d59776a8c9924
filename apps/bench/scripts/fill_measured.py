#!/usr/bin/env python3
"""Puts what was measured into a document.

    fill_measured.py DOCUMENT FOLDER

In DOCUMENT what stands between <!-- measured: NAME --> and <!-- end --> becomes FOLDER/NAME.md; parts that were not measured this
time stay.
"""

import re
import sys
from pathlib import Path

MARKED = re.compile(r"<!-- measured: (\S+) -->\n.*?<!-- end -->", re.S)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def fill(path, part_of):
    """part_of(name): the text of a part, or None to leave what stands there."""

    def replace(match):
        part = part_of(match[1])
        return match[0] if part is None else f"<!-- measured: {match[1]} -->\n{part}\n<!-- end -->"

    path.write_text(MARKED.sub(replace, path.read_text()))


def main():
    document, folder = map(Path, sys.argv[1:])

    def part(name):
        file = folder / f"{name}.md"
        return file.read_text().strip("\n") if file.exists() else None

    fill(document, part)


if __name__ == "__main__":
    main()
