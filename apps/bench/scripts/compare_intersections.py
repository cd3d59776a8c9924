#!/usr/bin/env python3
"""onset's intersections and has_intersections against ipctk's has_intersections, on the same frames in one run, in turn.

    compare_intersections.py --server onset_bench_server NAME=A,B ... [--repeats 5]

A and B are two frames of one mesh; each is asked about on its own. CPU time of one thread each. ipctk stops at the first
intersection and does not say which; it counts an edge that ends on a face as one as well, up to rounding.
"""

import time

import ipctk
import numpy as np
from onset_server import Onset, scene_frames, scene_parser, spread, timed

BROAD_PHASES = ["LBVH", "HashGrid"]  # the first is its default


def of_frame(name, onset, end, mesh, x, repeats):
    calls = {
        "intersections": lambda: onset.ask("intersections", 1, end),
        "has_intersections": lambda: onset.ask("has-intersections", 1, end),
    }
    ours = {call: [] for call in calls}
    theirs = {broad_phase: [] for broad_phase in BROAD_PHASES}
    for round_ in range(repeats + 1):  # the first warms up
        answers = {call: ask() for call, ask in calls.items()}
        for broad_phase, times in theirs.items():
            method = getattr(ipctk, broad_phase)()
            seconds, verdict = timed(lambda method=method: ipctk.has_intersections(mesh, x, method), time.process_time)
            times.extend([seconds] * (round_ > 0))
        for call, answer in answers.items():
            ours[call].extend([answer["cpu"]] * (round_ > 0))
    found = answers["intersections"]
    counts = " / ".join(str(found[kind]) for kind in ("crossing", "touching", "overlapping"))
    times = [spread(values, 1e3) for values in (*ours.values(), *theirs.values())]
    print("| " + " | ".join([f"{name}, {'start' if end == 0 else 'end'}", counts, str(verdict), *times]) + " |", flush=True)


def main():
    parser = scene_parser(__doc__)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--threads", nargs="+", help="not looked at: for whoever passes on the arguments of compare_ipctk.py")
    options = parser.parse_args()
    ipctk.set_num_threads(1)
    print(f"ipctk {ipctk.__version__}; CPU ms, one thread, {options.repeats} rounds: median [least, most]\n")
    heads = ["frame", "crossing / touching / overlapping", "ipctk", "intersections", "has_intersections"]
    heads += [f"ipctk has_intersections, {broad_phase}" for broad_phase in BROAD_PHASES]
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for name, (a, b) in scene_frames(options.scenes).items():
        onset = Onset(options.server, a, b)
        x_t0, x_t1, edges, faces = onset.frames()
        for end, x in enumerate((x_t0, x_t1)):
            x = np.asfortranarray(x)
            of_frame(name, onset, end, ipctk.CollisionMesh(x, edges.copy(), faces.copy()), x, options.repeats)
        onset.close()


if __name__ == "__main__":
    main()
