#!/usr/bin/env python3
"""What calling from Python costs beyond the call itself.

    python_overhead.py A.ply B.ply [--repeats N]        needs onset_ccd, numpy and plyfile

Prints the median time of a single query on the same arrays again and again, and for an active set of the step from A to B the
time that a caller sees less the time that the library measures for itself (Stats.seconds_total), medians and shares of one run.
"""

import argparse
import statistics
import time

import numpy as np
import onset_ccd
import plyfile


def read(path):
    file = plyfile.PlyData.read(path)
    x = np.column_stack([np.asarray(file["vertex"][axis], float) for axis in "xyz"])
    name = "vertex_indices" if "vertex_indices" in file["face"].data.dtype.names else "vertex_index"
    return x, np.vstack(file["face"][name])


def query_microseconds(repeats):
    t0 = np.array([[0.25, 0.25, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0]])
    t1 = t0 - [[0, 0, 2], [0, 0, 0], [0, 0, 0], [0, 0, 0]]
    times = []
    for _ in range(100 * repeats):
        start = time.perf_counter()
        onset_ccd.vertex_face_ccd(t0, t1)
        times.append(time.perf_counter() - start)
    return 1e6 * statistics.median(times)


def active_set_overhead(a, b, repeats):
    (x_t0, faces), (x_t1, _) = read(a), read(b)
    mesh = onset_ccd.Mesh(x_t0, faces)
    rows = []
    for _ in range(repeats + 1):
        start = time.perf_counter()
        found = onset_ccd.construct_active_set(mesh, x_t0, x_t1, threads=1)
        contacts = found.contacts
        seen = time.perf_counter() - start
        rows.append((seen, seen - found.stats.seconds_total))
    rows = rows[1:]  # the first one finds nothing in the caches
    return len(contacts), *(statistics.median(column) for column in zip(*rows))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("a")
    parser.add_argument("b")
    parser.add_argument("--repeats", type=int, default=51)
    arguments = parser.parse_args()
    print(f"single query: {query_microseconds(arguments.repeats):.1f} us")
    count, seen, beyond = active_set_overhead(arguments.a, arguments.b, arguments.repeats)
    print(f"active set, {count} contacts: {1e3 * seen:.2f} ms, of which {1e6 * beyond:.0f} us ({100 * beyond / seen:.2f} %) beyond the library's own")


if __name__ == "__main__":
    main()
