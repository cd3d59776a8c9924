#!/usr/bin/env python3
"""Steps of random polygons in the plane beside ipctk's, in one run, in turn, and against the exact first contact.

    planar_steps_beside_ipctk.py --program onset_planar_steps [--scenes 200] [--repeats 5] [--seed 1]

CPU time of one thread each. Onset's step is that of compute_collision_free_stepsize, ipctk's that of the function of the same
name with its defaults. The exact first contact is found from exact coefficients in 120 digits. The last lines say whether any
step of onset's was before ipctk's, or after the exact contact, and what an active set costs a contact.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import time
from decimal import Decimal, getcontext
from fractions import Fraction

import ipctk
import numpy as np

getcontext().prec = 120


def polygons(random, bodies, speed):
    """Stars in cells of their own, closed or open, that drift, turn and shake."""
    side = int(np.ceil(np.sqrt(bodies)))
    t0, t1, edges = [], [], []
    for b in range(bodies):
        corners, first = int(random.integers(3, 40)), len(t0)
        middle, drift = np.array([b % side, b // side]), random.uniform(-speed, speed, 2)
        angles = 2 * np.pi * (np.arange(corners) + 0.3 * random.uniform(size=corners)) / corners
        radii, turn = random.uniform(0.2, 0.45, corners), random.uniform(-1, 1) * speed
        ring = lambda a: np.stack([radii * np.cos(a), radii * np.sin(a)], 1)
        t0.extend(middle + ring(angles))
        t1.extend(middle + drift + ring(angles + turn) + 0.1 * speed * random.uniform(size=(corners, 2)))
        edges += [[first + k, first + (k + 1) % corners] for k in range(corners - int(random.integers(0, 2)))]
    return np.array(t0), np.array(t1), np.array(edges, np.int32)


def to_decimal(x):
    return Decimal(x.numerator) / Decimal(x.denominator)


def roots(c):
    """Of c[0] + c[1] t + c[2] t^2 in [0, 1], in 120 digits."""
    if c[2] == 0:
        found = [] if c[1] == 0 else [to_decimal(-c[0] / c[1])]
    else:
        d = c[1] * c[1] - 4 * c[0] * c[2]
        root = to_decimal(d).sqrt() if d >= 0 else None
        found = [] if root is None else sorted((to_decimal(-c[1]) + s * root) / to_decimal(2 * c[2]) for s in (-1, 1))
    return [t for t in found if 0 <= t <= 1]


def times(p, q):
    return [p[0] * q[0], p[0] * q[1] + p[1] * q[0], p[1] * q[1]]


def minus(p, q):
    return [a - b for a, b in zip(p, q)]


def first_contact(x0, x1, edges):
    """The least time at which a vertex is on an edge that is not its own; infinite where there is none."""
    first = Decimal("Infinity")
    lo, hi = np.minimum(x0, x1), np.maximum(x0, x1)
    for a, b in edges:
        low, high = np.minimum(lo[a], lo[b]), np.maximum(hi[a], hi[b])
        for v in np.flatnonzero(np.all((hi >= low) & (lo <= high), 1)):
            if v in (a, b):
                continue
            path = [[[Fraction(x0[i, k]), Fraction(x1[i, k]) - Fraction(x0[i, k])] for k in (0, 1)] for i in (v, a, b)]
            w = [minus(path[0][k], path[1][k]) for k in (0, 1)]
            e = [minus(path[2][k], path[1][k]) for k in (0, 1)]
            rest = [minus(e[k], w[k]) for k in (0, 1)]
            inside = [x + y for x, y in zip(times(w[0], rest[0]), times(w[1], rest[1]))]
            for t in roots(minus(times(w[0], e[1]), times(w[1], e[0]))):
                if t < first and sum(to_decimal(c) * t**i for i, c in enumerate(inside)) >= 0:
                    first = t
    return first


def median_seconds(call, repeats):
    call()
    taken = []
    for _ in range(repeats):
        begun = time.process_time()
        answer = call()
        taken.append(time.process_time() - begun)
    return answer, sorted(taken)[repeats // 2]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    for name, value in [("scenes", 200), ("repeats", 5), ("seed", 1)]:
        parser.add_argument("--" + name, type=int, default=value)
    options = parser.parse_args()
    ipctk.set_num_threads(1)
    random = np.random.default_rng(options.seed)
    before = late = contacts = limited = 0
    ours_total = theirs_total = set_total = conservative_total = 0.0
    per_contact, ratios = [], []
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "scene")
        for i in range(options.scenes):
            x0, x1, edges = polygons(random, int(random.integers(4, 60)), 10 ** random.uniform(-1.5, 0.3))
            path.write_bytes(np.array([len(x0), len(edges)], np.int64).tobytes() + x0.tobytes() + x1.tobytes() + edges.tobytes())
            out = subprocess.run([options.program, path, str(options.repeats)], capture_output=True, text=True, check=True).stdout
            step, _, count, seconds, of_set, of_conservative = map(float, out.split())
            f = np.asfortranarray
            mesh = ipctk.CollisionMesh(f(x0), f(edges))
            a, b = f(x0), f(x1)
            theirs, their_seconds = median_seconds(lambda: ipctk.compute_collision_free_stepsize(mesh, a, b), options.repeats)
            exact = first_contact(x0, x1, edges)
            before += step < theirs
            late += Decimal(step) > exact
            limited += exact <= 1
            contacts += count
            ours_total += seconds
            theirs_total += their_seconds
            ratios.append(their_seconds / seconds)
            if count:
                set_total += of_set
                conservative_total += of_conservative
                per_contact.append(1e6 * of_set / count)
    print(f"{options.scenes} scenes, {limited} with a contact, ipctk {ipctk.__version__}; {options.repeats} repeats, one thread")
    print(f"steps of onset before ipctk's: {before}; after the exact first contact: {late}")
    print(f"CPU ms of all steps: onset {1e3 * ours_total:.2f}, ipctk {1e3 * theirs_total:.2f}; ipctk / onset by scene: "
          f"median {np.median(ratios):.2f}, least {min(ratios):.2f}, most {max(ratios):.2f}")
    print(f"active sets, certify: {contacts:.0f} contacts, {1e6 * set_total / max(contacts, 1):.2f} us a contact over all scenes "
          f"(conservative {1e6 * conservative_total / max(contacts, 1):.2f}), by scene median {np.median(per_contact):.2f}, "
          f"most {max(per_contact):.2f}")
    if before or late:
        sys.exit("a step is worse than ipctk's, or late")


if __name__ == "__main__":
    main()
