"""Vertices at exactly the same place: which they are, and one in place of the corners of an STL file, which names no vertices."""

import numpy as np

from .errors import InputError


def first_at_place(x):
    """For each row the first row that is the same; -0 and 0 are, and NaN is like nothing."""
    order = np.lexsort(x.T[::-1])
    new = np.ones(len(x), bool)
    new[1:] = (x[order[1:]] != x[order[:-1]]).any(axis=1)
    first = np.empty(len(x), np.int64)
    first[order] = order[np.flatnonzero(new)][np.cumsum(new) - 1]  # lexsort is stable: the first of equals comes first
    return first


def copies_together(x_t0, x_t1):
    """[first vertex at a place, another one there], by both, of those that are together in both frames."""
    first = first_at_place(np.hstack([x_t0, x_t1]))
    copies = np.flatnonzero(first != np.arange(len(first)))
    pairs = np.column_stack([first[copies], copies])
    return pairs[np.lexsort(pairs.T[::-1])].tolist()


def check_still_together(first, t0, t1):
    x = t1.positions
    same = (x == x[first]) | (np.isnan(x) & np.isnan(x[first]))
    apart = ~same.all(axis=1)
    if apart.any():
        v = int(np.argmax(apart))
        a, b = (f"corner {i % 3} of face {i // 3}" for i in (first[v], v))
        raise InputError(f"{t0.path} and {t1.path}: {a} and {b} are at one place in the first and not in the second, and STL does not "
                         "tell whether they are one vertex: write .ply or .obj")


def merge(mesh, first):
    kept = first == np.arange(len(first))
    number = np.cumsum(kept) - 1
    corners = number[first][mesh.corners].reshape(-1, 3)
    ordered = np.sort(corners, axis=1)
    different = 1 + (ordered[:, 1:] != ordered[:, :-1]).sum(axis=1)
    mesh.positions = mesh.positions[kept]
    mesh.set_polygons([corners[different == 3]])
    mesh.wires, mesh.points = ordered[different == 2][:, [0, 2]], ordered[different == 1][:, 0]
    thin = int((different < 3).sum())
    mesh.notes.append(f"merged {len(first)} corners into {kept.sum()} vertices" +
                      (f"; wires or points for {thin} face{'s' * (thin != 1)} without area" if thin else ""))
    mesh.shares_vertices = True


def merge_corners(t0, t1):
    """Corners at exactly the same place in `t0` become one vertex in both, with a note; `t1` may be the same file, or have vertices of its
    own. A face whose corners become two vertices or one is a wire or a point. Raises InputError for corners that are at one place in `t0`
    and not in `t1`: whether they are one vertex, STL cannot say."""
    if not t0.shares_vertices:
        first = first_at_place(t0.positions)
        if t1 is not t0 and not t1.shares_vertices and len(t1.positions) == len(t0.positions):
            check_still_together(first, t0, t1)
            merge(t1, first)
        merge(t0, first)
    if not t1.shares_vertices:
        merge(t1, first_at_place(t1.positions))
