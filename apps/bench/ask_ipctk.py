#!/usr/bin/env python3
"""ipctk, asked queries with truth one by one; the counts of onset_baselines, as JSON on stdout.

    ask_ipctk.py [--every N] [--checks N] FILE ...

Each FILE as for onset_baselines; of each every N-th query. Times include the call from Python; what a call costs that does
nothing (a test of two boxes) is printed as call_us. --checks: most iterations of TightInclusionCCD and AdditiveCCD; a
query that needs them all is not told from others by the wheel. The wheel has no inexact algorithm in three dimensions.
"""

import argparse
import csv
import json
import math
import os
import re
import sys
import time
from fractions import Fraction
from pathlib import Path

import ipctk
import numpy as np


def finders(checks):
    return {
        "TightInclusionCCD": ipctk.TightInclusionCCD(max_iterations=checks),
        "TightInclusionCCD, rescaling 1": ipctk.TightInclusionCCD(max_iterations=checks, conservative_rescaling=1.0),
        "AdditiveCCD": ipctk.AdditiveCCD(max_iterations=checks),
    }


def kind_of(path):
    for part in reversed(Path(path).parts):
        words = re.split("[^a-z]+", part.lower().replace("vertex-face", "vf").replace("edge-edge", "ee"))
        for kind in ("vf", "ee"):
            if kind in words:
                return kind
    sys.exit(f"{path}: vertex-face or edge-edge?")


def read_queries(path):
    """[(eight points, collides, lo, hi)]; lo and hi are nan where there is no toi.csv."""
    with open(path) as file:
        rows = list(csv.reader(file))
    beside = Path(path).with_name("toi.csv")
    brackets = [[math.nan] * 2] * (len(rows) // 8)
    if beside.exists():
        with open(beside) as file:
            brackets = [[float.fromhex(x) for x in row] for row in csv.reader(file)]
    points = [np.array([float(Fraction(int(r[i]), int(r[i + 1]))) for i in (0, 2, 4)]) for r in rows]
    return [(points[8 * i : 8 * i + 8], rows[8 * i][6] == "1", *bracket) for i, bracket in enumerate(brackets)]


def ask(call, points):
    start = time.perf_counter()
    try:
        collides, toi = call(*points)
    except Exception:  # no answer: neither a contact nor a time
        collides, toi = False, math.nan
    return 1e6 * (time.perf_counter() - start), collides, toi


def tally(name, call, queries):
    t = {"name": name, "queries": len(queries)}
    t |= dict.fromkeys(["positives", "false_positives", "false_negatives", "late", "latest", "zero", "cut"], 0)
    t |= {"total_us": 0.0, "slowest_us": 0.0, "early_sum": 0.0}
    for points, truth, lo, hi in queries:
        us, collides, toi = ask(call, points)
        if us < 1000:
            us = min(us, ask(call, points)[0])
        t["total_us"] += us
        t["slowest_us"] = max(t["slowest_us"], us)
        t["positives"] += collides
        t["false_positives"] += collides and not truth
        t["false_negatives"] += truth and not collides
        if truth and collides and lo <= hi:
            t["late"] += not toi <= hi
            t["latest"] = max(t["latest"], toi - hi)
            t["zero"] += toi == 0 and lo > 0
            t["early_sum"] += max(0.0, lo - toi)
    return t


def call_us(points):
    return min(ask(lambda *x: (ipctk.point_triangle_aabb_ccd(*x, 0.0), 1.0), points)[0] for _ in range(1000))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--checks", type=int, default=1_000_000)
    options = parser.parse_args()
    report = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # its root finder logs to stdout
    ipctk.set_num_threads(1)
    ipctk.set_logger_level(ipctk.LoggerLevel.off)
    result = {"ipctk": ipctk.__version__, "every": options.every, "checks": options.checks, "files": []}
    for path in options.files:
        kind, queries = kind_of(path), read_queries(path)[:: options.every]
        result.setdefault("call_us", call_us(queries[0][0]))
        row = {"file": path, "kind": kind, "finders": []}
        for name, ccd in finders(options.checks).items():
            call = ccd.point_triangle_ccd if kind == "vf" else ccd.edge_edge_ccd
            row["finders"].append(tally(name, call, queries))
        result["files"].append(row)
    json.dump(result, report, indent=1)
    report.close()


if __name__ == "__main__":
    main()
