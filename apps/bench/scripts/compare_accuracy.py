#!/usr/bin/env python3
"""Extreme queries with exact truth, asked of onset and of ipctk: who misses, who is late, who stops at zero, how long it takes.

    compare_accuracy.py --onset onset --queries FOLDER [--limit SECONDS]

FOLDER is what onset_extreme_queries wrote. Every library answers with its defaults; onset also at a relative tolerance of
1e-12, for many families have gaps far below any default. A query that ipctk does not answer within the limit is cut off and
counted as such. Prints Markdown.
"""

import argparse
import csv
import ctypes
import json
import math
import multiprocessing
import os
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

KINDS = {"vertex-face": "vf", "edge-edge": "ee"}
TIGHT, ADDITIVE = "TightInclusionCCD", "AdditiveCCD"


@dataclass
class Query:
    kind: str
    points: list  # eight: four at t = 0, four at t = 1
    lo: float = math.inf  # bracket of the exact time of impact, infinite without contact
    hi: float = math.inf


@dataclass
class Answer:
    collides: bool
    toi: float


class Tally:
    """Answers of one library to one family."""

    def __init__(self):
        self.missed = self.late = self.zero = self.false = self.cut = self.queries = 0
        self.seconds = 0.0

    def add(self, query, answer):
        truth = query.lo < math.inf
        self.queries += 1
        if answer is None:
            self.cut += 1
            return
        self.missed += truth and not answer.collides
        self.false += answer.collides and not truth
        if truth and answer.collides:
            self.late += not answer.toi <= query.hi  # nan is late
        self.zero += answer.collides and answer.toi == 0 and query.lo > 0 and truth

    def time(self, seconds):
        self.seconds = max(self.seconds, seconds)

    def sum(self, other):
        for name in ("missed", "late", "zero", "false", "cut", "queries"):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        self.time(other.seconds)

    def cells(self, limit):
        worst = f"> {limit:g} s ({self.cut})" if self.cut else shown_time(self.seconds)
        return [self.missed, self.late, self.zero, self.false, worst]


def shown_time(seconds):
    return f"{1e6 * seconds:.0f} us" if seconds < 1e-3 else f"{1e3 * seconds:.3g} ms" if seconds < 1 else f"{seconds:.2g} s"


# ---- queries as files

def read_queries(folder, kind):
    with open(folder / "data.csv") as file:
        rows = [[float(Fraction(int(r[i]), int(r[i + 1]))) for i in (0, 2, 4)] for r in csv.reader(file)]
    with open(folder / "toi.csv") as file:
        brackets = [[float.fromhex(x) for x in row] for row in csv.reader(file)]
    return [Query(kind, rows[8 * i : 8 * i + 8], *bracket) for i, bracket in enumerate(brackets)]


def write_queries(path, queries):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w") as file:
        for query in queries:
            for point in query.points:
                numbers = (str(n) for x in point for n in x.as_integer_ratio())
                print(*numbers, int(query.lo < math.inf), sep=",", file=file)


# ---- onset

class Onset:
    def __init__(self, binary):
        self.binary = binary

    def ask_file(self, path, *options):
        """Answers, and the seconds of the slowest."""
        with tempfile.TemporaryDirectory() as folder:
            out, report = f"{folder}/answers.csv", f"{folder}/report.json"
            command = [self.binary, "queries", path, "--csv", out, "--json", report, *options]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            with open(out) as file:
                rows = list(csv.DictReader(file))
            with open(report) as file:
                worst = json.load(file)["total"]["max_us"]
        return [Answer(row["outcome"] != "free", float(row["toi"])) for row in rows], 1e-6 * worst, [
            row["outcome"] for row in rows
        ]

    def ask(self, query, *options):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / query.kind / "data.csv"
            write_queries(path, [query])
            [answer], seconds, [outcome] = self.ask_file(path, *options)
        return answer, seconds, outcome


# ---- ipctk, in a process that can be ended

def serve_ipctk(name, options, pipe):
    import ipctk
    import numpy as np

    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: a query may outlive the script by hours, and grow
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # its root finder logs to stdout
    ipctk.set_num_threads(1)
    ipctk.set_logger_level(ipctk.LoggerLevel.error)
    ccd = getattr(ipctk, name)(**options)
    ask = {"vertex-face": ccd.point_triangle_ccd, "edge-edge": ccd.edge_edge_ccd}
    pipe.send("ready")
    while True:
        try:
            kind, points, separation = pipe.recv()
        except EOFError:
            return
        points = [np.array(p) for p in points]
        start = time.process_time()
        try:
            collides, toi = ask[kind](*points, min_distance=separation)
        except Exception:  # no answer: neither a contact nor a time
            collides, toi = False, math.nan
        pipe.send((collides, toi, time.process_time() - start))


class Ipctk:
    def __init__(self, name, limit, **options):
        self.name, self.limit, self.options = name, limit, options
        self.start()

    def start(self):
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=serve_ipctk, args=(self.name, self.options, theirs), daemon=True)
        self.process.start()
        if not self.pipe.poll(60):
            sys.exit("ipctk does not start")
        self.pipe.recv()

    def ask(self, query, separation=0.0):
        """The answer and its seconds; None and the limit where it takes longer."""
        self.pipe.send((query.kind, query.points, separation))
        try:
            if self.pipe.poll(self.limit):
                collides, toi, seconds = self.pipe.recv()
                return Answer(collides, toi), seconds
        except EOFError:  # it crashed
            pass
        self.process.kill()
        self.process.join()
        self.start()
        return None, self.limit


# ---- the tables

def family_tallies(folder, onset, peers):
    tallies = [Tally() for _ in range(2 + len(peers))]
    for kind in KINDS:
        queries = read_queries(folder / kind, kind)
        for tally, options in zip(tallies, ([], ["--relative-tolerance", "1e-12"])):
            answers, worst, _ = onset.ask_file(folder / kind / "data.csv", *options)
            for query, answer in zip(queries, answers, strict=True):
                tally.add(query, answer)
            tally.time(worst)
        for tally, peer in zip(tallies[2:], peers):
            for query in queries:
                answer, seconds = peer.ask(query)
                tally.add(query, answer)
                tally.time(seconds)
    return tallies


def print_families(folder, onset, peers, limit):
    names = ["onset", "onset, 1e-12", *(peer.name for peer in peers)]
    print("A cell: missed / late / zero / false, slowest.\n")
    print("| family | queries |", " | ".join(names), "|")
    print("|---" * (2 + len(names)) + "|")
    totals = [Tally() for _ in names]

    def line(name, tallies):
        cells = ["{} / {} / {} / {}, {}".format(*tally.cells(limit)) for tally in tallies]
        print("|", " | ".join([name, str(tallies[0].queries), *cells]), "|", flush=True)

    for family in sorted(p for p in folder.iterdir() if p.is_dir()):
        tallies = family_tallies(family, onset, peers)
        line(family.name, tallies)
        for total, tally in zip(totals, tallies):
            total.sum(tally)
    line("**all**", totals)


def above_oblique_face(norm, start, end):
    """A vertex above the middle of a face with normal (1, 1, 1), its distance in `norm` going from start to end."""
    length = {"euclidean": math.sqrt(3), "maximum": 1}[norm]
    face = [[1.0, -0.5, -0.5], [-0.5, 1.0, -0.5], [-0.5, -0.5, 1.0]]
    return Query("vertex-face", [[start / length] * 3, *face, [end / length] * 3, *face])


def shown(answer, outcome=None):
    if answer is None:
        return "no answer"
    return f"{outcome or 'contact'} at {answer.toi:.6g}" if answer.collides else "free"


def print_separation(onset, peers):
    d = 0.01
    cases = [(0.011, 0.009, "0.5"), (0.012, 0.0, "0.16667"), (0.009, 0.012, "below d, parting"), (0.009, 0.0, "below d, pressing: 0")]
    print(f"A vertex over a face with normal (1, 1, 1), minimum separation {d}; distances in the norm named.\n")
    print("| norm | distance | exact | onset |", " | ".join(peer.name for peer in peers), "|")
    print("|---" * (4 + len(peers)) + "|")
    for norm in ("euclidean", "maximum"):
        for start, end, exact in cases:
            query = above_oblique_face(norm, start, end)
            answer, _, outcome = onset.ask(query, "--min-separation", str(d), "--norm", norm)
            theirs = [shown(peer.ask(query, d)[0]) if norm == "euclidean" else "-" for peer in peers]
            print("|", " | ".join([norm, f"{start} to {end}", exact, shown(answer, outcome), *theirs]), "|")


def sliding_edges(gap):
    """Two nearly parallel unit edges, `gap` apart, that slide along each other; no axis is special."""
    along, across, apart = (2 / 7, 3 / 7, 6 / 7), (3 / 7, -6 / 7, 2 / 7), (6 / 7, 2 / 7, -3 / 7)  # orthonormal

    def point(x, y, z):
        return [x * a + y * b + z * c for a, b, c in zip(along, across, apart)]

    def edges(start):
        return [point(0, 0, 0), point(1, 0, 0), point(start, 1e-9, gap), point(start + 1, -1e-9, gap)]

    return Query("edge-edge", edges(-0.5) + edges(0.5))


def print_sliding(onset, peers):
    print("Nearly parallel unit edges that slide along each other at a constant gap: no contact.\n")
    print("| gap | onset |", " | ".join(peer.name for peer in peers), "|")
    print("|---" * (2 + len(peers)) + "|")
    for exponent in range(3, 10):
        query = sliding_edges(10.0**-exponent)
        answer, seconds, outcome = onset.ask(query)
        cells = [f"{shown(answer, outcome)}, {shown_time(seconds)}"]
        for peer in peers:
            answer, seconds = peer.ask(query)
            cells.append(f"{shown(answer)}, {'> ' if answer is None else ''}{shown_time(seconds)}")
        print("|", " | ".join([f"1e-{exponent}", *cells]), "|", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--onset", required=True)
    parser.add_argument("--queries", required=True, type=Path)
    parser.add_argument("--limit", type=float, default=3.0)
    options = parser.parse_args()
    onset = Onset(options.onset)
    peers = [Ipctk(name, options.limit) for name in (TIGHT, ADDITIVE)]
    print_families(options.queries, onset, peers, options.limit)
    print()
    print_separation(onset, peers)
    print()
    print_sliding(onset, [Ipctk(name, 20.0) for name in (TIGHT, ADDITIVE)])


if __name__ == "__main__":
    main()
