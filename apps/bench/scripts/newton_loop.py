#!/usr/bin/env python3
"""Calls as a Newton solver makes them, by `onset bench --loop`: positions change a little, and memory that is no cache's is
touched in between.

    newton_loop.py --onset onset NAME=A,B ... [--calls 15] [--pause 64] [--motion 1 0.1]

`later call`: with pairs held from call to call; `one call`: without, so that each finds its pairs anew. One thread, CPU time. Prints
Markdown.
"""

import argparse
import json
import subprocess

from fill_measured import table
from onset_server import scene_frames

HEAD = ["scene", "motion", "call", "later call, ms", "one call, ms", "times as fast", "by held pairs"]
CALLS = {"active set": "active_set", "step": "step"}


def spread(times):
    return "{median:.2f} [{min:.2f}, {max:.2f}]".format(**{key: 1e3 * x for key, x in times.items()})


def rows(name, frames, motion, options):
    command = [options.onset, "bench", *frames, "--threads", "1", "--repeats", "0", "--loop", str(options.calls)]
    command += ["--motion", str(motion), "--pause", str(options.pause), "--relative-tolerance", "1e-8", "--json", "-"]
    loop = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["scenes"][-1]["loop"]
    for call, key in CALLS.items():
        held, fresh = loop[key]["held"], loop[key]["fresh"]
        ratio = f"{fresh['median'] / held['median']:.2f}"
        yield [name, motion, call, spread(held), spread(fresh), ratio, f"{loop[key]['served']} of {loop['later_calls']}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=A,B")
    parser.add_argument("--onset", required=True)
    parser.add_argument("--calls", type=int, default=15)
    parser.add_argument("--pause", type=int, default=64, help="MiB")
    parser.add_argument("--motion", type=float, nargs="+", default=[1, 0.1])
    options = parser.parse_args()
    found = []
    for name, frames in scene_frames(options.scenes).items():
        for motion in options.motion:
            found += rows(name, frames, motion, options)
    print(table(HEAD, found))


if __name__ == "__main__":
    main()
