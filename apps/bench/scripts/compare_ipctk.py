#!/usr/bin/env python3
"""onset against ipctk on the same frames in the same run, in turn: active set, step size, broad phase.

    compare_ipctk.py --server onset_bench_server NAME=A,B ... [--repeats 5] [--threads 1 2]

A and B are two frames of one mesh. Both libraries get the same doubles. With one thread CPU time is compared, with more wall
time. Prints one Markdown table a number of threads; ratios are those of the rounds' times, median [least, most].
"""

import argparse
import json
import platform
import time

import ipctk
import numpy as np
from onset_server import Onset, scene_frames, spread, timed

BROAD_PHASES = ["LBVH", "HashGrid", "SpatialHash", "SweepAndPrune"]


class Peer:
    def __init__(self, frames):
        x_t0, x_t1, edges, faces = frames
        self.x = np.asfortranarray(x_t0), np.asfortranarray(x_t1)
        self.mesh = ipctk.CollisionMesh(self.x[0], edges.copy(), faces.copy())

    def step(self, ccd):
        return ipctk.compute_collision_free_stepsize(self.mesh, *self.x, 0.0, ipctk.LBVH(), ccd)

    def pairs(self, broad_phase):
        candidates = ipctk.Candidates()
        candidates.build(self.mesh, *self.x, 0.0, getattr(ipctk, broad_phase)())
        return len(candidates)  # the lists themselves would become Python objects


def shown(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


class Row:
    """One call of ours against one of a peer's, round by round."""

    def __init__(self, name, ask):
        self.name, self.ask, self.ours, self.theirs = name, ask, [], []

    def print(self, scene, their_result):
        ratios = [b / a for a, b in zip(self.ours, self.theirs)]
        result = ", ".join(f"{k} {shown(v)}" for k, v in self.result.items() if k not in ("wall", "cpu"))
        cells = [scene, self.name, spread(self.ours, 1e3), spread(self.theirs, 1e3), spread(ratios), result, shown(their_result)]
        print("| " + " | ".join(cells) + " |", flush=True)


def measure(scene, threads, repeats, theirs, rows):
    """Prints the rows, which the same runs of the peer's call are measured against; the first round warms up."""
    clock, key = (time.process_time, "cpu") if threads == 1 else (time.perf_counter, "wall")
    for i in range(repeats + 1):
        for row in rows:
            row.result = row.ask()
        seconds, their_result = timed(theirs, clock)
        for row in rows[: len(rows) * (i > 0)]:
            row.ours.append(row.result[key])
            row.theirs.append(seconds)
    for row in rows:
        row.print(scene, their_result)


def compare_scene(name, onset, peer, threads, repeats):
    def row(what, *words):
        return Row(what, lambda: onset.ask(words[0], threads, *words[1:]))

    for ccd in (ipctk.TightInclusionCCD(), ipctk.AdditiveCCD()):
        their_call = f"step size, {type(ccd).__name__}"
        ours = [row(f"step size : {their_call}", "step", "1e-6"), row(f"active set : {their_call}", "active-set", "1e-8")]
        measure(name, threads, repeats, lambda: peer.step(ccd), ours)
    for broad_phase in BROAD_PHASES:
        ours = [row(f"stored pairs : Candidates.build, {broad_phase}", "pairs")]
        measure(name, threads, repeats, lambda: peer.pairs(broad_phase), ours)


def compare(binary, scenes, threads, repeats):
    ipctk.set_num_threads(threads)
    print(f"\n{threads} thread{'s' if threads > 1 else ''}, {'CPU' if threads == 1 else 'wall'} ms, {repeats} rounds\n")
    print("| scene | onset : ipctk | onset | ipctk | ratio | onset's result | ipctk's result |\n|---|---|---|---|---|---|---|")
    for name, (a, b) in scenes.items():
        onset = Onset(binary, a, b)
        peer = Peer(onset.frames())
        compare_scene(name, onset, peer, threads, repeats)
        onset.close()


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=A,B")
    parser.add_argument("--server", required=True)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    return parser.parse_args()


def main():
    options = arguments()
    print(f"ipctk {ipctk.__version__}, Python {platform.python_version()}, {platform.machine()}")
    for threads in options.threads:
        compare(options.server, scene_frames(options.scenes), threads, options.repeats)


if __name__ == "__main__":
    main()
