#!/usr/bin/env python3
"""Two threads against one: active set and step of each scene, in alternating rounds, wall time.

    two_threads.py --server onset_bench_server NAME=A,B ... [--rounds 15]

Ratios are those of the rounds' times, median [least, most]. Prints Markdown.
"""

from onset_server import Onset, scene_frames, scene_parser, spread

CALLS = {"active set": ("active-set", "1e-8"), "step": ("step", "1e-6")}  # and relative tolerance


def measure(onset, call, tolerance, rounds):
    """Wall seconds of each round, for one thread and for two; the first round warms up."""
    seconds = [[onset.ask(call, threads, tolerance)["wall"] for threads in (1, 2)] for _ in range(rounds + 1)]
    return list(zip(*seconds[1:]))


def main():
    parser = scene_parser(__doc__)
    parser.add_argument("--rounds", type=int, default=15)
    options = parser.parse_args()
    print("| scene | call | one thread, ms | two threads, ms | times as fast |\n|---|---|---|---|---|")
    for name, frames in scene_frames(options.scenes).items():
        onset = Onset(options.server, *frames)
        for what, (call, tolerance) in CALLS.items():
            one, two = measure(onset, call, tolerance, options.rounds)
            ratio = spread([a / b for a, b in zip(one, two)], digits=2)
            print(f"| {name} | {what} | {spread(one, 1e3)} | {spread(two, 1e3)} | {ratio} |", flush=True)
        onset.close()


if __name__ == "__main__":
    main()
