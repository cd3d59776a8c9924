#!/usr/bin/env python3
"""What of a call is not parallel, in instructions that valgrind counts, and the speed on many cores that follows.

    serial_share.py --server onset_bench_server NAME=A,B ...

All instructions are those of a call with one thread; those that are not in a parallel loop are what the calling thread spends outside of
such loops in a call with four. The speeds are those of Amdahl's law. Prints Markdown.
"""

import re
import subprocess
import tempfile

from onset_server import scene_frames, scene_parser

CALLS = {"active set": "active-set {} 1e-8", "step": "step {} 1e-6"}  # {}: threads
FIRST = 4  # calls until all that is kept from call to call is there
CORES = (2, 16, 64)
THREADS = 4  # so that what is divided only among several is divided
# What every parallel loop goes through (base/parallel.hpp), but not those within another.
LOOP = r"\S*:onset::backend::run_ranges\([^'\n]*$"


def profile(server, frames, call, count, threads):
    """Millions of instructions of a process that makes so many calls: of its first thread, and what that spends inside of parallel loops."""
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/counts"
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--separate-threads=yes", server, *frames]
        subprocess.run(command, input=f"{call.format(threads)}\n" * count, check=True, capture_output=True, text=True)
        text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", f"{out}-01"], check=True, capture_output=True,
                              text=True).stdout
    number = lambda pattern: sum(int(n.replace(",", "")) for n in re.findall(pattern, text, re.M)) / 1e6
    return number(r"^ *([\d,]+) .*PROGRAM TOTALS"), number(r"^ *([\d,]+) \([ \d.]+%\)  " + LOOP)


def of_a_call(server, frames, call, threads):
    """The same of a later call: the difference of two processes, over two calls."""
    few, more = (profile(server, frames, call, count, threads) for count in (FIRST, FIRST + 2))
    return [(b - a) / 2 for a, b in zip(few, more)]


def main():
    options = scene_parser(__doc__).parse_args()
    head = "".join(f" | {n} cores" for n in CORES)
    print(f"| scene | call | million instructions | not parallel | share{head} |\n" + "|---" * (5 + len(CORES)) + "|")
    for name, frames in scene_frames(options.scenes).items():
        for what, call in CALLS.items():
            whole, _ = of_a_call(options.server, frames, call, 1)
            first, inside = of_a_call(options.server, frames, call, THREADS)
            serial = (first - inside) / whole
            speeds = "".join(f" | {1 / (serial + (1 - serial) / n):.1f}" for n in CORES)
            print(f"| {name} | {what} | {whole:.1f} | {serial * whole:.2f} | {100 * serial:.2f} %{speeds} |", flush=True)


if __name__ == "__main__":
    main()
