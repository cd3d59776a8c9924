#!/usr/bin/env python3
"""Where the time of an active set goes: shares of CPU time by stage, from perf's samples of a server that computes nothing else.

    profile.py --server onset_bench_server NAME=A,B ... [--seconds 4] [--others]

One thread. A symbol belongs to the first stage below whose pattern it has; what the compiler inlined counts where it went.
--others lists on stderr the symbols that no pattern has. Needs perf, with cpu-clock samples allowed. Prints Markdown.
"""

import re
import signal
import subprocess
import sys
import tempfile
import time

from onset_server import Onset, scene_frames, scene_parser

STAGES = {
    "order of the contacts": r"FoundPair|PairTraversal::(take|merge)|radix_sort|Place",
    "contact points and normals": r"contact_geometr|fill_(geometry|contacts)|closest_points|make_corners|Corners::|construct_active_set",
    "certificates of contact, exact decisions, root finder":
        r"touched_by|certif|[Ee]xact|CubicSign|Wide<|Integer|roots|completely|complete_first|sharpen|initial|find_parting|inclusion|"
        r"[Ss]earch|Interval|on_grid|bracket_of|scalbn|ilogb|"
        r"NarrowPhase::sharpen|PairDecision::|PairResult",
    "culls": r"cull|round_(positions|row)|NarrowPhase::(gather|process|prepare)",
    "advancement": r"(avx512|avx2|scalar)::.*(advance|set_cubic|gather|direction|maximum_norm)",
    "boxes and tree":
        r"fit_|BoxTree|order_|_order|hilbert|make_supports|make_motion|finish_motion|motion_box|FloatMap|sort_range|Keyed|roughness|"
        r"largest_swept|[Ee]xtents|StepSetup::|StaticTrees|StaticMotion|count_filtered|make_keys",
    "traversal and box tests": r"bvh_(avx2|scalar)::|make_bvh|Bvh|may_meet|share_vertex|boxes_overlap|excluded|pair_vertices|PairBatch",
    "kernel, copies, allocation": r"\[k\]|allocate|mem(move|cpy|set)|malloc|free$|_int_|operator new|operator delete|_M_(default_append|realloc)",
    "other": "",
}


def samples(server, frames, seconds):
    """{symbol: samples} of active sets, one after another, for about so long."""
    onset = Onset(server, *frames)
    ask = lambda: onset.ask("active-set", 1, "1e-8")
    ask()
    with tempfile.NamedTemporaryFile() as data:
        perf = subprocess.Popen(["perf", "record", "-q", "-e", "cpu-clock", "-F", "1999", "-o", data.name, "-p", str(onset.process.pid)])
        time.sleep(1)  # until it listens
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            ask()
        perf.send_signal(signal.SIGINT)
        perf.wait()
        onset.close()
        command = ["perf", "report", "-i", data.name, "--no-children", "--stdio", "-F", "sample,sym", "-t", "\t"]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    rows = (line.split("\t") for line in text.splitlines() if line.strip() and not line.startswith("#"))
    return {symbol.strip(): int(count) for count, symbol in rows}


def stage_of(symbol):
    return next(stage for stage, pattern in STAGES.items() if re.search(pattern, symbol))


def shares(found):
    total, share = sum(found.values()), dict.fromkeys(STAGES, 0.0)
    for symbol, count in found.items():
        share[stage_of(symbol)] += 100 * count / total
    return share


def main():
    parser = scene_parser(__doc__)
    parser.add_argument("--seconds", type=float, default=4)
    parser.add_argument("--others", action="store_true")
    options = parser.parse_args()
    found = {name: samples(options.server, frames, options.seconds) for name, frames in scene_frames(options.scenes).items()}
    for name, symbols in found.items() if options.others else ():
        for symbol, count in symbols.items():
            if stage_of(symbol) == "other":
                print(name, count, symbol, file=sys.stderr)
    columns = [shares(symbols) for symbols in found.values()]
    print("| share of CPU time, % | " + " | ".join(found) + " |\n" + "|---" * (1 + len(found)) + "|")
    for stage in STAGES:
        print(f"| {stage} | " + " | ".join(f"{column[stage]:.1f}" for column in columns) + " |")
    print("| samples | " + " | ".join(str(sum(symbols.values())) for symbols in found.values()) + " |")


if __name__ == "__main__":
    main()
