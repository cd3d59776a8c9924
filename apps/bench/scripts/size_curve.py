#!/usr/bin/env python3
"""Time and memory of an active set and of a step over the size of the scene, up to millions of triangles.

    size_curve.py --onset onset [--largest 10000000] [--refine 4] [--threads 1 2]

Each size and number of threads is a process of `onset bench` of its own. First table: layered cloths of 10^3 triangles and more,
whose step is a fixed number of edge lengths, so that contacts grow with them. Second: one such cloth of 10^3 triangles, each
divided into four again and again, the motion unchanged. `ns` is CPU time over n log2 n + contacts, where n counts vertices,
edges and faces: it stays where it is if time grows no faster than that. Prints Markdown.
"""

import argparse
import json
import math
import subprocess
import sys

SMALLEST = 1000  # triangles
HEAD = ["triangles", "threads", "candidates", "contacts", "active set: CPU ms", "wall ms", "ns", "step: CPU ms", "wall ms", "ns",
        "peak memory: MiB", "bytes a primitive"]


def bench(onset, triangles, threads, *arguments):
    repeats = 5 if triangles < 100_000 else 1 if triangles < 3_000_000 else 0  # 0: only the first run, which the others warm up with
    command = [onset, "bench", *arguments, "--threads", str(threads), "--repeats", str(repeats), "--json", "-"]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["scenes"][-1]


def row(scene, threads):
    n = scene["vertices"] + scene["edges"] + scene["faces"]
    candidates, contacts = (sum(scene["stats"][stage].values()) for stage in ("candidates", "contacts"))
    cells = [scene["faces"], threads, candidates, contacts]
    for call in ("active_set", "step"):
        cpu, wall = (scene[call][clock]["median"] for clock in ("cpu", "wall"))
        cells += [f"{1e3 * cpu:.4g}", f"{1e3 * wall:.4g}", f"{1e9 * cpu / (n * math.log2(n) + contacts):.2f}"]
    peak = scene["active_set"]["peak_bytes"]
    return cells + (["-", "-"] if peak is None else [f"{peak / 2**20:.1f}", f"{peak / n:.0f}"])


def print_curve(onset, threads, scenes):
    """scenes: (about how many triangles, what bench is told)."""
    print("| " + " | ".join(HEAD) + " |\n" + "|---" * len(HEAD) + "|")
    for triangles, arguments in scenes:
        for count in threads:
            print(f"{triangles} triangles, {count} threads", file=sys.stderr)
            print("| " + " | ".join(map(str, row(bench(onset, triangles, count, *arguments), count))) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--onset", required=True)
    parser.add_argument("--largest", type=int, default=10_000_000)
    parser.add_argument("--refine", type=int, default=4)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    options = parser.parse_args()
    sizes = [SMALLEST * 10**i for i in range(20) if SMALLEST * 10**i <= options.largest]
    print_curve(options.onset, options.threads, [(size, ["--cloth", str(size)]) for size in sizes])
    print("\nOne scene, finer and finer:\n")
    refined = [(SMALLEST * 4**i, i) for i in range(options.refine + 1)]
    print_curve(options.onset, options.threads, [(n, ["--cloth", str(SMALLEST), "--refine", str(i)]) for n, i in refined])


if __name__ == "__main__":
    main()
