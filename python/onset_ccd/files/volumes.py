"""Volume meshes by their surface: the faces that belong to one cell only."""

import numpy as np

import onset_ccd

from .errors import InputError

FACES = {
    "tetra": [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)],
    "hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    "wedge": [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
    "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
}


def padded(polygons):
    """#faces x 4, -1 behind the corners of a triangle."""
    return np.pad(polygons, ((0, 0), (0, 4 - polygons.shape[1])), constant_values=-1)


def faces_of_cells(solids):
    """The faces of all cells, in the order of the cells, padded."""
    rows = [np.empty((0, 4), np.int64)]
    for kind, cells in solids:
        faces = np.stack([padded(cells[:, list(face)]) for face in FACES[kind]], axis=1)
        rows.append(faces.reshape(-1, 4))
    return np.concatenate(rows)


def check_twice(path, solids):
    for kind, cells in solids:
        _, first, inverse = np.unique(np.sort(cells, axis=1), axis=0, return_index=True, return_inverse=True)
        again = np.flatnonzero(first[inverse.ravel()] != np.arange(len(cells)))
        if len(again):
            row = int(again[0])
            raise InputError(f"{path}: {kind} {row} has the vertices of {kind} {first[inverse.ravel()[row]]}")


def boundary(path, solids, all_faces):
    """Those faces that belong to one cell, padded."""
    check_twice(path, solids)
    key = np.sort(all_faces, axis=1)
    _, inverse, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    count = count[inverse.ravel()]
    if (count > 2).any():
        raise InputError(f"{path}: the face {tuple(int(v) for v in all_faces[np.argmax(count > 2)] if v >= 0)} belongs to three cells or more")
    return all_faces[count == 1]


def surface_of_tetrahedra(path, cells, positions):
    """The same of tetrahedra alone, turned outward whatever their orientation."""
    try:
        surface = onset_ccd.surface_of_tetrahedra(cells, positions if np.isfinite(positions).all() else len(positions))
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None
    return padded(np.asarray(surface.full_vertices, np.int64)[surface.faces])


def without(rows, others):
    """Those of `rows` that are not among `others`, both with sorted rows of one width; as flags."""
    both = np.concatenate([others, rows])
    _, first = np.unique(both, axis=0, return_inverse=True)
    first = first.ravel()
    return ~np.isin(first[len(others):], first[:len(others)])


def edges_of(faces):
    """Edges of padded faces, the smaller id first."""
    after = np.where(faces[:, [1, 2, 3, 0]] < 0, faces[:, [0]], faces[:, [1, 2, 3, 0]])
    edges = np.sort(np.stack([faces, after], axis=2).reshape(-1, 2), axis=1)
    return edges[(edges[:, 0] >= 0) & (edges[:, 0] != edges[:, 1])]


def split_shells(mesh, all_faces):
    """Polygons, wires and points of the file that are not part of a cell: meshers list those of the boundary, too."""
    polygons = mesh.polygons()
    keys = [np.sort(np.pad(p, (0, 4 - len(p)), constant_values=-1)) if len(p) <= 4 else None for p in polygons]
    known = {tuple(key) for key in np.sort(all_faces, axis=1).tolist()} if polygons else set()
    shells = [p for p, key in zip(polygons, keys) if key is None or tuple(key.tolist()) not in known]
    wires = mesh.wires[without(np.sort(mesh.wires, axis=1), edges_of(all_faces))] if len(mesh.wires) else mesh.wires
    return shells, wires, mesh.points[~np.isin(mesh.points, all_faces)]


def take_surface(mesh, shape):
    """Puts the surface in place of the cells, before what else the file has, and returns the ids of the vertices that are left: all but
    those inside. None where no cell is there. `shape`: positions that tell the orientation."""
    if not mesh.solids:
        return None
    all_faces = faces_of_cells(mesh.solids)
    only_tetrahedra = all(kind == "tetra" for kind, _ in mesh.solids)
    if only_tetrahedra:
        surface = surface_of_tetrahedra(mesh.path, np.concatenate([cells for _, cells in mesh.solids]), shape)
    else:
        surface = boundary(mesh.path, mesh.solids, all_faces)
    shells, wires, points = split_shells(mesh, all_faces)
    mesh.set_polygons([[row[row >= 0] for row in surface], shells])
    mesh.wires, mesh.points = wires, points
    used = np.zeros(len(shape), bool)
    for ids in (mesh.corners, wires.ravel(), points):
        used[ids] = True
    inside = np.isin(np.arange(len(shape)), all_faces) & ~used
    cells = sum(len(cells) for _, cells in mesh.solids)
    mesh.notes.append(f"{cells} cells by their surface: {len(surface)} faces, and {inside.sum()} of {len(shape)} vertices inside are left "
                      "out; ids of vertices are those of the file")
    kept = np.flatnonzero(~inside)
    renumber(mesh, kept, len(shape))
    return kept


def renumber(mesh, kept, count):
    number = np.full(count, -1)
    number[kept] = np.arange(len(kept))
    mesh.corners, mesh.wires, mesh.points, mesh.solids = number[mesh.corners], number[mesh.wires], number[mesh.points], []
