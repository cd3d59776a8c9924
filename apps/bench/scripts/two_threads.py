#!/usr/bin/env python3
"""Two threads against one: active set and step of each scene, and of small generated ones, in alternating rounds, wall time.

    two_threads.py --server onset_bench_server --onset onset NAME=A,B ... [--rounds 15] [--repeats 60]

Ratios are those of the rounds' times, median [least, most]; of a small scene a round's time is the median of so many repeats. Prints
Markdown.
"""

import json
import subprocess

from onset_server import Onset, scene_frames, scene_parser, spread

CALLS = {"active set": ("active-set", "1e-8"), "step": ("step", "1e-6")}  # and relative tolerance


def measure(onset, call, tolerance, rounds):
    """Wall seconds of each round, for one thread and for two; the first round warms up."""
    seconds = [[onset.ask(call, threads, tolerance)["wall"] for threads in (1, 2)] for _ in range(rounds + 1)]
    return list(zip(*seconds[1:]))


SMALL = {"at rest": ["--small"], "layered": ["--cloth", "200,500,1000,2000,5000"]}


def bench_small(options, scene, threads):
    """Each generated scene."""
    command = [options.onset, "bench", *SMALL[scene], "--threads", str(threads), "--repeats", str(options.repeats), "--json", "-"]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["scenes"]


def print_small(options):
    print("\nSmall meshes, which stay on one thread until many contacts are found:\n")
    print("| triangles | call | one thread, ms | two threads, ms | times as fast |\n|---|---|---|---|---|")
    for scene in SMALL:
        rounds = [[bench_small(options, scene, threads) for threads in (1, 2)] for _ in range(options.rounds)]
        for i, first in enumerate(rounds[0][0]):
            for what, call in (("active set", "active_set"), ("step", "step")):
                one, two = ([r[t][i][call]["wall"]["median"] for r in rounds] for t in (0, 1))
                ratio = spread([a / b for a, b in zip(one, two)], digits=2)
                size = f"{first['faces']}, {scene}"
                print(f"| {size} | {what} | {spread(one, 1e3, 3)} | {spread(two, 1e3, 3)} | {ratio} |", flush=True)


def main():
    parser = scene_parser(__doc__)
    parser.add_argument("--onset", required=True)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--repeats", type=int, default=60)
    options = parser.parse_args()
    print("| scene | call | one thread, ms | two threads, ms | times as fast |\n|---|---|---|---|---|")
    for name, frames in scene_frames(options.scenes).items():
        onset = Onset(options.server, *frames)
        for what, (call, tolerance) in CALLS.items():
            one, two = measure(onset, call, tolerance, options.rounds)
            ratio = spread([a / b for a, b in zip(one, two)], digits=2)
            print(f"| {name} | {what} | {spread(one, 1e3)} | {spread(two, 1e3)} | {ratio} |", flush=True)
        onset.close()
    print_small(options)


if __name__ == "__main__":
    main()
