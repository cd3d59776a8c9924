#!/usr/bin/env python3
"""Whether an active set waits for memory: what it fetches past a core's own caches, beside the time it takes.

    memory_traffic.py --server onset_bench_server --copied GB_PER_S NAME=A,B ... [--cache BYTES]

Valgrind's cachegrind counts the misses of a cache of BYTES (default 1 MiB, as a core's second level has or more), simulated without
prefetching; two active sets less one is a set in warm memory. --copied: what onset_memory_bandwidth prints for one thread. The
last column is an upper bound of the share of the time that memory can take: as if every line came from memory, none of it
while something is computed. One thread. Prints Markdown.
"""

import subprocess
import tempfile

from onset_server import Onset, scene_frames, scene_parser, spread

LINE = 64
ASK = ("active-set", 1, "1e-8")


def counted(server, frames, sets, cache):
    """Cachegrind's events of reading the scene and so many active sets."""
    with tempfile.NamedTemporaryFile("r") as out:
        ways = 16
        command = ["valgrind", "--tool=cachegrind", "--cache-sim=yes", f"--LL={cache},{ways},{LINE}",
                   f"--cachegrind-out-file={out.name}", server, *frames]
        text = f"{' '.join(map(str, ASK))}\n" * sets
        subprocess.run(command, input=text, text=True, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        lines = dict(line.split(": ", 1) for line in out.read().splitlines() if line.startswith(("events: ", "summary: ")))
    return dict(zip(lines["events"].split(), map(int, lines["summary"].split())))


def measured(server, frames, rounds=5):
    """CPU seconds of each round, and the candidates."""
    onset = Onset(server, *frames)
    answers = [onset.ask(*ASK) for _ in range(rounds + 1)][1:]
    onset.close()
    return [a["cpu"] for a in answers], answers[0]["candidates"]


def main():
    parser = scene_parser(__doc__)
    parser.add_argument("--copied", type=float, required=True)
    parser.add_argument("--cache", type=int, default=1 << 20)
    options = parser.parse_args()
    print("| scene | instructions, 10^6 | a candidate | misses of level 1, 10^6 | past "
          f"{options.cache / 2**20:g} MiB, MB | bytes a candidate | CPU ms | of it memory, at most |\n" + "|---" * 8 + "|")
    for name, frames in scene_frames(options.scenes).items():
        once, twice = (counted(options.server, frames, sets, options.cache) for sets in (1, 2))
        one = {event: twice[event] - once[event] for event in once}
        seconds, candidates = measured(options.server, frames)
        bytes_fetched = LINE * (one["DLmr"] + one["DLmw"])
        share = bytes_fetched / (1e9 * options.copied) / sorted(seconds)[len(seconds) // 2]
        cells = [name, f"{1e-6 * one['Ir']:.0f}", f"{one['Ir'] / candidates:.0f}", f"{1e-6 * (one['D1mr'] + one['D1mw']):.2f}",
                 f"{1e-6 * bytes_fetched:.1f}", f"{bytes_fetched / candidates:.1f}", spread(seconds, 1e3), f"{100 * share:.0f} %"]
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
