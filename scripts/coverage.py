#!/usr/bin/env python3
"""Counts the lines and branches that tests reached, by folder, from what `llvm-cov export` printed.

    coverage.py COVERAGE.json MISSING.txt

Code that is compiled several times, such as templates and the kernels of each instruction set, counts once: a line or a
side of a branch is reached where any of its copies was."""
import collections
import json
import os
import sys

FLOORS = ("include", "src", "scene", "broadphase", "narrowphase", "base")
BRANCH = 4  # a kind of region, as LLVM numbers them


class File:
    def __init__(self, path):
        with open(path) as source:
            self.text = source.read().split("\n")
        self.lines = {}                                  # line: reached
        self.branches = collections.defaultdict(lambda: [0, 0])  # place: how often true, false

    def add_segments(self, segments):
        """Lines as llvm-cov counts them: a line has the largest count of the regions that begin on it or wrap it."""
        wrapped, at = None, 0
        for line in range(segments[0][0], segments[-1][0] + 1):
            here = []
            while at < len(segments) and segments[at][0] == line:
                here.append(segments[at])
                at += 1
            entries = [s for s in here if s[3] and s[4] and not s[5]]
            mapped = bool(entries) or (wrapped is not None and wrapped[3])
            if here and here[0][3] is False and here[0][4] and not entries:
                mapped = False
            if mapped:
                count = max([s[2] for s in entries] + ([wrapped[2]] if wrapped is not None and wrapped[3] else [0]))
                self.lines[line] = self.lines.get(line, False) or count > 0
            if here:
                wrapped = here[-1]


def read(path, root):
    with open(path) as exported:
        data = json.load(exported)["data"][0]
    files = {}
    for entry in data["files"]:
        name = os.path.relpath(entry["filename"], root)
        if name.split(os.sep)[0] in FLOORS and entry["segments"]:
            files.setdefault(name, File(entry["filename"])).add_segments(entry["segments"])
    for function in data["functions"]:
        names = [os.path.relpath(name, root) for name in function["filenames"]]
        for line, column, _, _, true, false, file_id, _, kind in function.get("branches", []):
            if kind == BRANCH and names[file_id] in files:
                counts = files[names[file_id]].branches[line, column]
                counts[0] += true
                counts[1] += false
    return files


def count(file):
    sides = [side > 0 for branch in file.branches.values() for side in branch]
    return collections.Counter({"lines": len(file.lines), "lines reached": sum(file.lines.values()),
                                "branches": len(sides), "branches reached": sum(sides)})


def percent(part, whole):
    return f"{100.0 * part / whole:6.2f} %" if whole else "       -"


def write_missing(files, path):
    with open(path, "w") as out:
        for name in sorted(files):
            file = files[name]
            for line in sorted(n for n, reached in file.lines.items() if not reached):
                out.write(f"{name}:{line}: line: {file.text[line - 1].strip()}\n")
            for (line, column), (true, false) in sorted(file.branches.items()):
                if file.lines.get(line, True) and (true == 0 or false == 0):
                    never = "true" if true == 0 else "false"
                    out.write(f"{name}:{line}:{column}: never {never}: {file.text[line - 1].strip()}\n")


def main():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    files = read(sys.argv[1], root)
    rows = collections.defaultdict(collections.Counter)
    for name, file in files.items():
        row = count(file)
        rows[os.path.dirname(name)].update(row)
        rows["all"].update(row)
    print(f"{'folder':32} {'lines':>7} {'reached':>8} {'branches':>9} {'reached':>8}")
    for folder in sorted(rows, key=lambda f: (f == "all", f)):
        row = rows[folder]
        print(f"{folder:32} {row['lines']:7} {percent(row['lines reached'], row['lines'])} {row['branches']:9} "
              f"{percent(row['branches reached'], row['branches'])}")
    write_missing(files, sys.argv[2])


if __name__ == "__main__":
    main()
