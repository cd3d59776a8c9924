"""One frame or two of one mesh: the input of the commands."""

from dataclasses import dataclass

import numpy as np

import onset_ccd

from .errors import InputError
from .mesh_file import read_mesh
from .places import merge_corners
from .triangulate import triangulate
from .volumes import take_surface


@dataclass
class Scene:
    mesh: onset_ccd.Mesh  # edges: those of the faces, then the wires that are not among them; points are set
    x_t0: np.ndarray
    x_t1: np.ndarray
    notes: list
    path: str  # of the first
    vertices: "np.ndarray | None" = None  # of a volume mesh: the file's id of each vertex of the surface
    welded: bool = False

    def start(self):
        return self.x_t0[:, : self.mesh.dimension]

    def end(self):
        return self.x_t1[:, : self.mesh.dimension]

    def vertex(self, v):
        """The id of a vertex in the file."""
        return int(v if self.vertices is None or v < 0 else self.vertices[v])

    def ids(self, vertices):
        return [self.vertex(v) for v in vertices]


def listed(ids, shown=10):
    return "(" + " ".join(str(i) for i in ids[:shown]) + (" ...)" if len(ids) > shown else ")")


def differing_rows(what, a, b):
    if len(a) != len(b):
        return f"{len(a)} against {len(b)} {what}s"
    different = (a.reshape(len(a), -1) != b.reshape(len(b), -1)).any(axis=1) if len(a) else np.zeros(0, bool)
    if not different.any():
        return ""
    row = int(np.argmax(different))
    return f"{what} {row} is {listed(np.atleast_1d(a[row]))} against {listed(np.atleast_1d(b[row]))}"


def differing_polygons(a, b):
    if len(a.ends) != len(b.ends):
        return f"{len(a.ends)} against {len(b.ends)} faces"
    if np.array_equal(a.ends, b.ends) and np.array_equal(a.corners, b.corners):
        return ""
    for row, (p, q) in enumerate(zip(a.polygons(), b.polygons())):
        if not np.array_equal(p, q):
            return f"face {row} is {listed(p)} against {listed(q)}"
    return ""


def differing_solids(a, b):
    kinds = [", ".join(f"{len(cells)} {kind}" for kind, cells in mesh.solids) or "none" for mesh in (a, b)]
    if kinds[0] != kinds[1]:
        return f"cells are {kinds[0]} against {kinds[1]}"
    for (kind, p), (_, q) in zip(a.solids, b.solids):
        different = differing_rows(kind, p, q)
        if different:
            return different
    return ""


def difference(a, b):
    """The first difference in words; empty when there is none."""
    if len(a.positions) != len(b.positions):
        return f"{len(a.positions)} against {len(b.positions)} vertices"
    return (differing_polygons(a, b) or differing_rows("wire", a.wires, b.wires) or differing_rows("point", a.points, b.points) or
            differing_solids(a, b))


def all_edges(faces, wires):
    """Those of the faces, then the wires, each once."""
    of_faces = onset_ccd.edges(faces) if len(faces) else np.empty((0, 2), np.int32)
    known = {tuple(sorted(edge)) for edge in of_faces.tolist()} if len(wires) else set()
    more = []
    for wire in wires.tolist():
        key = tuple(sorted(wire))
        if key not in known:
            known.add(key)
            more.append(wire)
    return np.concatenate([of_faces, np.array(more, np.int32).reshape(-1, 2)])


def lone_points(count, edges, faces, declared):
    """Those that are no vertex of an edge or a face, which take part as it is, each once, in the order declared."""
    taken = np.zeros(count, bool)
    taken[edges.ravel()] = True
    taken[faces.ravel()] = True
    alone = declared[~taken[declared]]
    return alone[np.sort(np.unique(alone, return_index=True)[1])]


def make_mesh(file, x):
    """`file` has no cells any more; x: of its vertices."""
    try:
        faces = triangulate(file, x)
        edges = all_edges(faces, file.wires)
        mesh = onset_ccd.Mesh(len(x), faces, edges)
        if len(file.points):
            rules = mesh.rules
            rules.points = lone_points(len(x), edges, faces, file.points).astype(np.int32)
            mesh.rules = rules
        return mesh
    except ValueError as error:
        raise InputError(f"{file.path}: {error}") from None


def note_triangles(file):
    sizes = np.diff(file.ends, prepend=0)
    larger = int((sizes > 3).sum())
    if larger:
        file.notes.append(f"triangulated {larger} polygon{'s' * (larger != 1)} of more than 3 corners: of {counted(len(sizes), 'face')} there "
                          f"are {counted(int(sizes.sum() - 2 * len(sizes)), 'triangle')}, numbered in that order")


def counted(n, what):
    return f"{n} {what}{'s' * (n != 1)}"


def notes(a, b):
    """What is said about both files is said once."""
    return [f"{a.path}: {note}" for note in a.notes] + [f"{b.path}: {note}" for note in b.notes if note not in a.notes]


def read_scene(path_t0, path_t1=None):
    """Raises InputError: what read_mesh raises, and elements that differ, naming the first one. Polygons are cut into triangles by their
    shape in the first file. Of a volume mesh it is the surface, and Scene.vertices says which vertices of the file are its own."""
    t0 = read_mesh(path_t0)
    t1 = t0 if path_t1 in (None, path_t0) else read_mesh(path_t1)
    merge_corners(t0, t1)
    different = "" if t1 is t0 else difference(t0, t1)
    if different:
        raise InputError(f"{path_t0} and {path_t1}: different topology: {different}")
    x_t0, x_t1 = t0.positions, t1.positions
    kept = take_surface(t0, x_t0)
    if kept is not None:
        full_vertices, x_t0, x_t1 = len(x_t0), x_t0[kept], x_t1[kept]
    note_triangles(t0)
    mesh = make_mesh(t0, x_t0)
    if kept is not None:
        mesh.set_full_vertices(kept.astype(np.int32), full_vertices)
    return Scene(mesh, x_t0, x_t1, notes(t0, t1), path_t0, kept)
