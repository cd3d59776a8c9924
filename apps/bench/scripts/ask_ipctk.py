#!/usr/bin/env python3
"""ipctk, asked queries with truth one by one; the counts of onset_baselines, as JSON on stdout.

    ask_ipctk.py [--every N] [--checks N] [--limit SECONDS] FOLDER ...

Each FOLDER holds data.csv and toi.csv, as onset_recorded_queries and its like write them; of each every N-th query. Times
are CPU time and include the call from Python; what a call costs that does nothing (a test of two boxes) is given as call_us. --checks: most
iterations of TightInclusionCCD and AdditiveCCD. A query that is not answered within the limit is cut: counted as one,
and as taking the limit. The wheel has no inexact algorithm in three dimensions.
"""

import argparse
import json
import time
from pathlib import Path

import ipctk
import numpy as np
from compare_accuracy import ADDITIVE, KINDS, TIGHT, Ipctk, read_queries

COUNTS = ["positives", "false_positives", "false_negatives", "late", "latest", "zero", "cut"]


def finders(options):
    def finder(name, **more):
        return Ipctk(name, options.limit, max_iterations=options.checks, **more)

    return {
        TIGHT: finder(TIGHT),
        f"{TIGHT}, rescaling 1": finder(TIGHT, conservative_rescaling=1.0),
        ADDITIVE: finder(ADDITIVE),
    }


def count(tally, query, answer):
    truth = query.lo < float("inf")
    tally["positives"] += answer.collides
    tally["false_positives"] += answer.collides and not truth
    tally["false_negatives"] += truth and not answer.collides
    if truth and answer.collides:
        tally["late"] += not answer.toi <= query.hi  # nan is late
        tally["latest"] = max(tally["latest"], answer.toi - query.hi)
        tally["zero"] += answer.toi == 0 and query.lo > 0
        tally["early_sum"] += max(0.0, query.lo - answer.toi)


def measure(name, finder, queries):
    tally = {"name": name, "queries": len(queries), **dict.fromkeys(COUNTS, 0)}
    tally |= {"total_us": 0.0, "slowest_us": 0.0, "early_sum": 0.0}
    for query in queries:
        answer, seconds = finder.ask(query)
        if answer is None:
            tally["cut"] += 1
        else:
            if seconds < 1e-3:
                seconds = min(seconds, finder.ask(query)[1])
            count(tally, query, answer)
        tally["total_us"] += 1e6 * seconds
        tally["slowest_us"] = max(tally["slowest_us"], 1e6 * seconds)
    return tally


def call_us(query):
    points, shortest = [np.array(p) for p in query.points], float("inf")
    for _ in range(1000):
        start = time.perf_counter()
        ipctk.point_triangle_aabb_ccd(*points, 0.0)
        shortest = min(shortest, 1e6 * (time.perf_counter() - start))
    return shortest


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="FOLDER", type=Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--checks", type=int, default=1_000_000)
    parser.add_argument("--limit", type=float, default=3.0)
    options = parser.parse_args()
    peers = finders(options)
    result = {"ipctk": ipctk.__version__, "every": options.every, "checks": options.checks, "limit": options.limit, "files": []}
    for folder in options.folders:
        queries = read_queries(folder, folder.name)[:: options.every]
        result.setdefault("call_us", call_us(queries[0]))
        tallies = [measure(name, finder, queries) for name, finder in peers.items()]
        result["files"].append({"file": str(folder / "data.csv"), "kind": KINDS[folder.name], "finders": tallies})
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
