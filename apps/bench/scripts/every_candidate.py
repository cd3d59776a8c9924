#!/usr/bin/env python3
"""The active set against ipctk's TightInclusionCCD asked every candidate on its own, as a code does that needs all contacts.

    every_candidate.py --server onset_bench_server NAME=A,B ... [--every 60] [--samples 3]

The wheel has no call for that (its step size shortens the step as it goes), so its narrow phase is asked from Python: of each
scene's pairs whose swept boxes overlap, every N-th (more of a few), for several samples without a pair in common; times are scaled to all pairs,
less what the same calls from Python cost with a function that only tests two boxes. ipctk's own broad phase is not in them. One
thread, CPU time; ratios are those of the samples, median [least, most]. Prints Markdown.
"""

import time

import ipctk
import numpy as np
from onset_server import Onset, scene_frames, scene_parser, spread, timed

ENOUGH = 30_000  # pairs of a sample
RESCALINGS = [ipctk.TightInclusionCCD().conservative_rescaling, 1.0]


def queries(frames, pairs, start, every):
    """Arguments of the calls: the four points at either end of the step, vertex-face and edge-edge."""
    x_t0, x_t1, edges, faces = frames
    vertex_face, edge_edge = (p[start::every] for p in pairs)
    ids = [np.column_stack([vertex_face[:, :1], faces[vertex_face[:, 1]]]), edges[edge_edge].reshape(-1, 4)]
    return [[(*x_t0[four], *x_t1[four]) for four in rows] for rows in ids]


def count_hits(calls, asked):
    """Over both kinds, how many answer contact; the calls give a bool, or one and a time."""
    hits = 0
    for call, arguments in zip(calls, asked):
        for points in arguments:
            answer = call(*points, 0.0)
            hits += answer if isinstance(answer, bool) else answer[0]
    return hits


def calls_of(ccd):
    def bound(method):
        return lambda *arguments: method(*arguments)

    return [bound(ccd.point_triangle_ccd), bound(ccd.edge_edge_ccd)]


def boxes_alone():
    return [lambda *arguments: ipctk.point_triangle_aabb_ccd(*arguments), lambda *arguments: ipctk.edge_edge_aabb_ccd(*arguments)]


def samples_of(onset, frames, pairs, options):
    """{rescaling: [(seconds of ours, of theirs scaled to all pairs, their hits scaled)]}, and our answer."""
    found = {rescaling: [] for rescaling in RESCALINGS}
    total = sum(map(len, pairs))
    onset.ask("active-set", 1, "1e-8")
    every = max(options.samples, min(options.every, total // ENOUGH))
    for i in range(options.samples):
        asked = queries(frames, pairs, i * every // options.samples, every)
        scale = total / sum(map(len, asked))
        overhead, _ = timed(lambda: count_hits(boxes_alone(), asked), time.process_time)
        for rescaling in RESCALINGS:
            mine = onset.ask("active-set", 1, "1e-8")
            calls = calls_of(ipctk.TightInclusionCCD(conservative_rescaling=rescaling))
            seconds, hits = timed(lambda: count_hits(calls, asked), time.process_time)
            found[rescaling].append((mine["cpu"], scale * (seconds - overhead), scale * hits))
    return found, mine


def main():
    parser = scene_parser(__doc__)
    parser.add_argument("--every", type=int, default=60)
    parser.add_argument("--samples", type=int, default=3)
    options = parser.parse_args()
    ipctk.set_num_threads(1)
    print("| scene | pairs | rescaling | active set, ms | contacts | TightInclusionCCD, ms | its contacts, about | ratio |\n" + "|---" * 8 + "|")
    for name, frames in scene_frames(options.scenes).items():
        onset = Onset(options.server, *frames)
        pairs = onset.pairs()
        found, mine = samples_of(onset, onset.frames(), pairs, options)
        onset.close()
        for rescaling, rows in found.items():
            ours, theirs, hits = zip(*rows)
            cells = [name, sum(map(len, pairs)), rescaling, spread(ours, 1e3), mine["contacts"], spread(theirs, 1e3),
                     round(sum(hits) / len(hits)), spread([b / a for a, b in zip(ours, theirs)])]
            print("| " + " | ".join(map(str, cells)) + " |", flush=True)


if __name__ == "__main__":
    main()
