#!/usr/bin/env python3
"""onset against ipctk on the same frames in the same run, in turn: active set, step size, broad phase.

    compare_ipctk.py --server onset_bench_server NAME=A,B ... [--repeats 5] [--threads 1 2]

A and B are two frames of one mesh. Both libraries get the same doubles. With one thread CPU time is compared, with more wall
time. Prints one Markdown table a number of threads; ratios are those of the rounds' times, median [least, most].
"""

import argparse
import json
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import ipctk
import numpy as np

BROAD_PHASES = ["LBVH", "HashGrid", "SpatialHash", "SweepAndPrune"]


class Onset:
    """The server: one process a scene, so that memory is as warm as in a simulator."""

    def __init__(self, binary, a, b):
        self.process = subprocess.Popen([binary, a, b], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, *words):
        print(*words, file=self.process.stdin, flush=True)
        line = self.process.stdout.readline()
        if not line:
            sys.exit("the server ended")
        return json.loads(line)

    def frames(self):
        with tempfile.NamedTemporaryFile() as file:
            self.ask("dump", file.name)
            raw = open(file.name, "rb").read()
        v, e, f = np.frombuffer(raw, np.int64, 3)
        x = np.frombuffer(raw, np.float64, 6 * v, 24).reshape(2, v, 3)
        ids = np.frombuffer(raw, np.int32, 2 * e + 3 * f, 24 + 48 * v)
        return x[0], x[1], ids[: 2 * e].reshape(e, 2), ids[2 * e :].reshape(f, 3)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


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


def timed(call, clock):
    start = clock()
    result = call()
    return clock() - start, result


def spread(values, unit=1):
    median, least, most = (f"{unit * x:.1f}" for x in (statistics.median(values), min(values), max(values)))
    return f"{median} [{least}, {most}]"


def shown(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


class Row:
    """One peer against one call of ours, round by round."""

    def __init__(self, name, ours, theirs):
        self.name, self.ours, self.theirs = name, ours, theirs
        self.seconds = [], []

    def round(self, threads, keep):
        clock = time.process_time if threads == 1 else time.perf_counter
        mine = self.ours()
        seconds, self.their_result = timed(self.theirs, clock)
        self.our_result = mine
        if keep:
            self.seconds[0].append(mine["cpu" if threads == 1 else "wall"])
            self.seconds[1].append(seconds)

    def print(self, scene):
        ours, theirs = self.seconds
        ratios = [b / a for a, b in zip(ours, theirs)]
        result = ", ".join(f"{k} {shown(v)}" for k, v in self.our_result.items() if k not in ("wall", "cpu"))
        cells = [scene, self.name, spread(ours, 1e3), spread(theirs, 1e3), spread(ratios), result, shown(self.their_result)]
        print("| " + " | ".join(cells) + " |", flush=True)


def rows(onset, peer, threads):
    def ask(*words):
        return lambda: onset.ask(*words)

    def step(ccd):
        return lambda: peer.step(ccd)

    tight, additive = ipctk.TightInclusionCCD(), ipctk.AdditiveCCD()
    step_size = ask("step", threads, "1e-6")
    active_set = ask("active-set", threads, "1e-8")
    yield Row("step size : step size, TightInclusionCCD", step_size, step(tight))
    yield Row("step size : step size, AdditiveCCD", step_size, step(additive))
    yield Row("active set : step size, TightInclusionCCD", active_set, step(tight))
    yield Row("active set : step size, AdditiveCCD", active_set, step(additive))
    for broad_phase in BROAD_PHASES:
        yield Row(
            f"stored pairs : Candidates.build, {broad_phase}",
            ask("pairs", threads),
            lambda broad_phase=broad_phase: peer.pairs(broad_phase),
        )


def compare(binary, scenes, threads, repeats):
    ipctk.set_num_threads(threads)
    print(f"\n{threads} thread{'s' if threads > 1 else ''}, {'CPU' if threads == 1 else 'wall'} ms, {repeats} rounds\n")
    print("| scene | onset : ipctk | onset | ipctk | ratio | onset's result | ipctk's result |\n|---|---|---|---|---|---|---|")
    for name, (a, b) in scenes.items():
        onset = Onset(binary, a, b)
        peer = Peer(onset.frames())
        for row in rows(onset, peer, threads):
            for i in range(repeats + 1):
                row.round(threads, keep=i > 0)
            row.print(name)
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
    scenes = {}
    for scene in options.scenes:
        name, _, frames = scene.partition("=")
        a, _, b = frames.partition(",")
        scenes[name] = a, b
    print(f"ipctk {ipctk.__version__}, Python {platform.python_version()}, {platform.machine()}")
    for threads in options.threads:
        compare(options.server, scenes, threads, options.repeats)


if __name__ == "__main__":
    main()
