"""Polygons as triangles, by cutting off ears in the plane that each lies in best."""

import numpy as np

from .errors import InputError

MOST_CORNERS = 4000  # half a minute: what is refused is refused soon


def turn(a, b, c):
    """> 0: a b c turn left. What rounding does to it changes which diagonals are taken, no more."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def flatten(x):
    """Without the axis along which its normal (Newell's) is longest, so that it turns left."""
    a, b = x - x[0], np.roll(x, -1, axis=0) - x[0]
    normal = [0.0, 0.0, 0.0]
    for p, q in zip(a.tolist(), b.tolist()):
        for c in range(3):
            normal[c] += p[(c + 1) % 3] * q[(c + 2) % 3] - p[(c + 2) % 3] * q[(c + 1) % 3]
    axis = 0
    for c in (1, 2):
        if abs(normal[c]) > abs(normal[axis]):
            axis = c
    u, v = (axis + 1) % 3, (axis + 2) % 3
    return x[:, [v, u] if normal[axis] < 0 else [u, v]].tolist()


def is_empty(flat, ring, a, b, c):
    for other in ring:
        p = flat[other]
        outside = turn(a, b, p) < 0 or turn(b, c, p) < 0 or turn(c, a, p) < 0
        if not outside and p != a and p != b and p != c:
            return False
    return True


def find_ear(flat, ring):
    """The first one with area and without other corners in it; else, where the polygon crosses itself or has no area, the first one with
    area, or the first."""
    convex = None
    for i in range(len(ring)):
        a, b, c = flat[ring[i - 1]], flat[ring[i]], flat[ring[(i + 1) % len(ring)]]
        if not turn(a, b, c) > 0:
            continue
        convex = i if convex is None else convex
        if is_empty(flat, ring, a, b, c):
            return i
    return convex or 0


def cut(ids, x):
    """Triangles of one polygon with these ids and positions."""
    flat, ring, triangles = flatten(x), list(range(len(ids))), []
    while len(ring) > 3:
        ear = find_ear(flat, ring)
        triangles.append((ids[ring[ear - 1]], ids[ring[ear]], ids[ring[(ear + 1) % len(ring)]]))
        del ring[ear]
    return [*triangles, tuple(ids[i] for i in ring)]


def triangulate(mesh, x):
    """#F x 3, in the order of the polygons: n - 2 triangles of the same winding for n corners. One that is planar and does not cross
    itself is covered exactly."""
    sizes = np.diff(mesh.ends, prepend=0)
    if (sizes == 3).all():
        return mesh.corners.reshape(-1, 3).astype(np.int32)
    if sizes.max() > MOST_CORNERS:
        row = int(np.argmax(sizes))
        raise InputError(f"{mesh.path}: the polygon of face {row} has {sizes[row]} corners, too many to cut into triangles: write triangles")
    faces = []
    with np.errstate(invalid="ignore", over="ignore"):
        for polygon in mesh.polygons():
            faces += [tuple(polygon)] if len(polygon) == 3 else cut(polygon.tolist(), x[polygon])
    return np.array(faces, np.int32).reshape(-1, 3)
