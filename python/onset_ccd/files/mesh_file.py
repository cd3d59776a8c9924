"""A mesh as a file has it: vertices, polygons, wires (edges on their own), points and cells of volumes."""

import os
import stat
from dataclasses import dataclass, field

import numpy as np

from .errors import InputError


def no_rows(width):
    return np.empty((0, width), np.int64)


@dataclass
class MeshFile:
    """All in the order of the file; ids are in range, and those of one element differ."""

    path: str
    positions: np.ndarray  # #V x 3; may hold NaN and infinities, for which the calls have outcomes
    corners: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))  # of the polygons, one after another
    ends: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))  # where in `corners` each one ends
    wires: np.ndarray = field(default_factory=lambda: no_rows(2))
    points: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))  # vertices that the file declares as points
    solids: list = field(default_factory=list)  # (kind, #cells x corners)
    notes: list = field(default_factory=list)  # what whoever reads the result should know about how the file was taken
    shares_vertices: bool = True  # STL: False, each corner is a vertex of its own

    def polygons(self):
        """The corners of each."""
        return np.split(self.corners, self.ends[:-1]) if len(self.ends) else []

    def set_polygons(self, groups):
        """Takes groups of rows of corners: arrays, or lists of rows of any length."""
        sizes, flat = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
        for rows in groups:
            if isinstance(rows, np.ndarray):
                sizes.append(np.full(len(rows), rows.shape[1]))
                flat.append(rows.ravel())
            else:
                sizes.append(np.array([len(row) for row in rows], np.int64))
                flat += [np.asarray(row, np.int64) for row in rows]
        self.corners = np.concatenate(flat)
        self.ends = np.cumsum(np.concatenate(sizes))


def check_elements(mesh, base=0):
    """Raises InputError for a vertex id out of range or repeated in an element; `base` is the first id of the file."""
    sizes = np.diff(mesh.ends, prepend=0)
    for size in np.unique(sizes):
        rows = np.flatnonzero(sizes == size)
        first = mesh.ends[rows] - size
        check_rows(mesh, "face", mesh.corners[first[:, None] + np.arange(size)], base, rows)
    check_rows(mesh, "wire", mesh.wires, base)
    check_rows(mesh, "point", mesh.points.reshape(-1, 1), base)
    for kind, cells in mesh.solids:
        check_rows(mesh, kind, cells, base)


def check_rows(mesh, what, ids, base=0, names=None):
    count = len(mesh.positions)
    outside = (ids < 0) | (ids >= count)
    ordered = np.sort(ids, axis=1)
    bad = outside.any(axis=1) | (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)
    if not bad.any():
        return
    row = int(np.argmax(bad))
    place = f"{mesh.path}: {what} {row if names is None else names[row]}"
    if outside[row].any():
        index = ids[row][outside[row]][0] + base
        if count == 0:
            raise InputError(f"{place} has vertex index {index}, but there are no vertices")
        span = f"[0, {count})" if base == 0 else f"[1, {count}]"
        raise InputError(f"{place} has vertex index {index}, not in {span}")
    twice = ordered[row][1:][ordered[row][1:] == ordered[row][:-1]][0]
    raise InputError(f"{place} has vertex {twice} repeated")


def finish(mesh, base=0):
    """The mesh, all indices checked. Without any element, every vertex is a point."""
    check_elements(mesh, base)
    if len(mesh.positions) == 0:
        raise InputError(f"{mesh.path}: no vertices")
    if len(mesh.ends) == 0 and len(mesh.wires) == 0 and len(mesh.points) == 0 and not mesh.solids:
        mesh.points = np.arange(len(mesh.positions))
        mesh.notes.append("no faces, wires or points: each vertex is a point")
    return mesh


def check_is_file(path):
    try:
        status = os.stat(path)
        with open(path, "rb") if stat.S_ISREG(status.st_mode) else open(os.devnull, "rb"):
            pass
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: {getattr(error, 'strerror', None) or error}") from None
    if stat.S_ISDIR(status.st_mode):
        raise InputError(f"{path}: is a directory")
    if not stat.S_ISREG(status.st_mode):
        raise InputError(f"{path}: is no file: write what it gives into one")
    if status.st_size == 0:
        raise InputError(f"{path}: the file is empty")


def read_mesh(path):
    """Reads a mesh. Raises InputError naming the file and the cause."""
    from .meshio_file import read_with_meshio
    from .obj_file import read_obj
    from .ply_file import read_ply
    from .stl_file import read_stl

    check_is_file(path)
    own = {".obj": read_obj, ".ply": read_ply, ".stl": read_stl}
    return own.get(os.path.splitext(path)[1].lower(), read_with_meshio)(path)
