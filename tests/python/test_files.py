"""Meshes of every format and kind, good and broken, read by python -m onset_ccd."""

import struct
import subprocess
import sys

import meshio
import numpy as np
import pytest

from onset_ccd.files.mesh_file import read_mesh
from onset_ccd.files.scene import read_scene
from running import fails, native, result, run, sheet, tetrahedra, triangles, two_cubes, two_sheets, wedges, write_obj


def write(folder, extension, x, end, cells, **how):
    """The two frames' paths."""
    paths = [str(folder / f"{name}.{extension}") for name in "ab"]
    for path, positions in zip(paths, (x, end)):
        meshio.Mesh(positions, cells).write(path, **how)
    return paths


FORMATS = [("vtk", {}), ("vtu", {}), ("ply", {}), ("ply", {"binary": False}), ("off", {}), ("msh", {"file_format": "gmsh"}), ("msh", {"file_format": "gmsh22"}),
           ("xdmf", {"data_format": "XML"}), ("inp", {}), ("mesh", {})]


@pytest.mark.parametrize("extension, how", FORMATS, ids=[f"{extension} {' '.join(map(str, how.values()))}" for extension, how in FORMATS])
def test_the_format_does_not_matter(tmp_path, extension, how):
    x, end, quads = two_sheets()
    faces = triangles(quads)
    scene = read_scene(*write(tmp_path, extension, x, end, [("triangle", faces)], **how))
    assert (scene.mesh.faces == faces).all()
    assert (scene.x_t0 == x).all() and (scene.x_t1 == end).all()
    assert scene.vertices is None and scene.notes == []


@pytest.mark.parametrize("binary", [False, True])
def test_corners_of_stl_are_merged(tmp_path, binary):
    """In the order of their first appearance, as the native reader does."""
    x, end, quads = two_sheets()
    paths = write(tmp_path, "stl", x, end, [("triangle", triangles(quads))], binary=binary)
    scene = read_scene(*paths)
    assert scene.notes == [f"{paths[0]}: merged 150 corners into 41 vertices"]
    corners = x[triangles(quads)].reshape(-1, 3)
    stored = corners.astype(np.float32) if binary else corners
    assert (scene.x_t0[scene.mesh.faces].reshape(-1, 3) == stored).all()
    first = np.unique(scene.mesh.faces, return_index=True)[1]
    assert (np.diff(first) > 0).all()
    done = subprocess.run([native(), "active-set", *paths, "--csv", "-"], capture_output=True, text=True)
    assert done.stdout == run("active-set", *paths, "--csv", "-").stdout


def facet(*corners):
    loop = "".join(f"vertex {' '.join(map(str, corner))}\n" for corner in corners)
    return f"facet normal 0 0 0\nouter loop\n{loop}endloop\nendfacet\n"


def test_thin_faces_of_stl(tmp_path):
    """-0 and 0 are one place; a face of two places is a wire, of one a point; what parts in the second file is refused."""
    a, b, c, d = (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)
    (tmp_path / "a.stl").write_text("solid\n" + facet(a, b, (1, 0, "-0")) + facet(a, b, c) + facet(d, d, d) + "endsolid\n")
    (tmp_path / "b.stl").write_text("solid\n" + facet(a, b, (1, 0, 2)) + facet(a, b, c) + facet(d, d, d) + "endsolid\n")
    scene = read_scene(str(tmp_path / "a.stl"))
    assert (scene.mesh.num_vertices, scene.mesh.num_faces, scene.mesh.num_points) == (4, 1, 1)
    assert scene.notes[0].endswith("merged 9 corners into 4 vertices; wires or points for 2 faces without area")
    assert "corner 1 of face 0 and corner 2 of face 0 are at one place in the first and not in the second" in fails(
        "step", "a.stl", "b.stl", cwd=tmp_path)


def test_quads_and_polygons_are_cut_as_the_native_program_cuts(tmp_path):
    x, quads = sheet(4, 0.0)
    x[:, 2] = 0.3 * np.sin(7 * x[:, 0] + 3 * x[:, 1])
    x[5, :2] -= 0.25  # a quad that is not convex
    polygon = np.array([[2, 0, 0], [3, 0, 0], [3, 1, 0], [2.5, 0.2, 0], [2, 1, 0]])
    write_obj(tmp_path / "a.obj", np.vstack([x, polygon]), [*quads.tolist(), [16, 17, 18, 19, 20], [0, 1, 16]])
    scene = read_scene(str(tmp_path / "a.obj"))
    assert scene.mesh.num_faces == 2 * 9 + 3 + 1
    flat = scene.x_t0[scene.mesh.faces[18:21]]
    area = 0.5 * np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0])[:, 2]
    assert (area > 0).all() and area.sum() == pytest.approx(0.6)
    words = ["check", "a.obj", "--min-separation", "0.3", "--csv", "-"]
    done = subprocess.run([native(), *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout == run(*words, cwd=tmp_path).stdout and done.stdout.count("\n") > 20


SOLIDS = {"hexahedron": lambda h: h, "tetra": tetrahedra, "wedge": wedges}


@pytest.mark.parametrize("kind", SOLIDS)
def test_volumes_by_their_surface(tmp_path, kind):
    """Ids of vertices are the file's; what is inside takes no part."""
    x, end, hexahedra = two_cubes()
    paths = write(tmp_path, "vtu", x, end, [(kind, SOLIDS[kind](hexahedra))])
    scene = read_scene(*paths)
    assert (scene.mesh.num_vertices, scene.mesh.num_faces, scene.mesh.num_edges) == (112, 216, 324)
    assert scene.mesh.num_full_vertices == 128 and [scene.mesh.full_vertex(v) for v in range(112)] == scene.vertices.tolist()
    inside = sorted(set(range(128)) - set(scene.vertices.tolist()))
    assert ((x[inside] % 1 != 0).all(axis=1)).all() and len(inside) == 16
    # Every edge has two faces: the surface is closed.
    sides = np.sort(scene.mesh.faces[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    assert (np.unique(sides, axis=0, return_counts=True)[1] == 2).all()
    json = result("active-set", *paths)
    assert json["earliest"] == pytest.approx(0.5, abs=1e-9) and json["earliest"] <= 0.5
    rows = [row.split(",") for row in run("active-set", *paths, "--csv", "-").stdout.splitlines()[1:]]
    top_or_bottom = np.flatnonzero(((x[:, 2] == 1) & (np.arange(128) < 64)) | ((x[:, 2] == 1.5) & (np.arange(128) >= 64)))
    touching = {int(row[4]) for row in rows if row[0] == "vf" and float(row[3]) < 0.6}
    assert touching and touching <= set(top_or_bottom.tolist())
    assert all(row[1] == row[4] for row in rows if row[0] == "vf")
    assert run("check", paths[0]).returncode == 0


def test_boundary_elements_of_volumes_are_not_taken_twice(tmp_path):
    """Meshers list corners, curves and surfaces beside the cells; a shell that hangs on a cell stays."""
    x, end, hexahedra = two_cubes()
    x, end = (np.vstack([p, [[-1, 0, 0], [-1, 1, 0], [9, 9, 9]]]) for p in (x, end))
    cells = [("vertex", np.array([[3], [130]])), ("line", np.array([[0, 1], [21, 22], [128, 129]])),
             ("triangle", np.array([[0, 1, 5], [0, 16, 21], [0, 128, 129]])), ("tetra", tetrahedra(hexahedra))]
    scene = read_scene(write(tmp_path, "vtu", x, end, cells)[0])
    mesh = scene.mesh
    assert (mesh.num_vertices, mesh.num_faces, mesh.num_points) == (115, 217, 1)
    assert scene.ids(mesh.faces[216]) == [0, 128, 129]
    assert scene.vertex(mesh.edges[-1, 0]) == 130


def test_lines_and_points(tmp_path):
    """A wire that falls through a face, and a point that meets a point."""
    x = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 1], [1.5, 1, 1], [9, 9, 1], [9, 9, 0]], float)
    end = x.copy()
    end[3:6, 2] = -1
    paths = write(tmp_path, "vtk", x, end, [("triangle", np.array([[0, 1, 2]])), ("line", np.array([[3, 4]])), ("vertex", np.array([[5], [6]]))])
    json = result("active-set", *paths)
    assert json["contacts"] == {"vf": 2, "ee": 1}
    assert json["earliest"] <= 0.5


def test_files_that_are_not_taken(tmp_path):
    """One line that names the file and the cause, whatever meshio does with it."""
    x, quads = sheet(3, 0.0)
    faces = triangles(quads)

    def says(name, text, cause):
        data = text if isinstance(text, bytes) else text.encode()
        (tmp_path / name).write_bytes(data)
        message = fails("check", name, cwd=tmp_path)
        assert message.startswith(name) and cause in message, message

    says("empty.vtk", "", "the file is empty")
    says("noise.vtk", "noise\n", "Illegal VTK header")
    says("noise.vtu", "<VTKFile", "meshio cannot read it")
    says("noise.msh", "$MeshFormat\nhello\n", "meshio cannot read it")
    says("noise.ply", "noise\n", "noise.ply:1: not a PLY file")
    says("noise.stl", "solid\nfacet normal 0 0 0\nvertex 0 0\n", "noise.stl:3: vertex 0 is not three finite numbers: 'vertex 0 0'")
    says("quad.stl", "solid\n" + facet((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)), "quad.stl:9: face 0 has 4 corners, 3 expected")
    says("cut.stl", "solid\n" + facet((0, 0, 0), (1, 0, 0), (1, 1, 0))[:-10], "the file ends within a facet")
    says("short.stl", "stl", "not an STL file")
    says("cut2.stl", bytes(80) + struct.pack("<I", 2) + bytes(50), "not an STL file, or cut off: as a binary one it has 2 faces")
    says("colour.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 3 0 1 2\n3 1 3 2 3 0 1 2\n", "32 words, 24 expected")
    says("noise.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "10 words, 17 expected of 3 vertices and 1 triangles")
    says("noise2.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 a 0\n3 0 1 2\n", "meshio cannot read it")
    says("noise.xyz", "0 0 0", "unknown extension .xyz")
    says("noise", "0 0 0", "no extension")
    says("zero.obj", "v 0 0 0\nf 0 1 2\n", "zero.obj:2: face 0 has vertex index 0; the first vertex is 1")
    says("far.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "face 0 has vertex index 3, not in [1, 2]")
    says("twice.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n", "face 0 has vertex 1 repeated")
    says("two.obj", "v 0 0 0\nv 1 0\nf 1 2 2\n", "two.obj:2: vertex 1 has 2 numbers, 3 expected")
    says("word.obj", "v 0 0 x\n", "word.obj:1: vertex 0 is not three finite numbers: '0 0 x'")
    says("surface.obj", "v 0 0 0\nsurf 0 1 0 1\n", "surface.obj:2: 'surf' is not read: export polygons, in one file")
    says("none.obj", "# nothing\n", "no vertices")
    meshio.Mesh(x, [("triangle", faces)]).write(tmp_path / "good.vtu")
    whole = (tmp_path / "good.vtu").read_bytes()
    says("cut.vtu", whole[: len(whole) // 2], "meshio cannot read it")
    meshio.Mesh(x, [("triangle", faces + 6)]).write(tmp_path / "far.vtk")
    says("far.vtk", (tmp_path / "far.vtk").read_bytes(), "has vertex index 9, not in [0, 9)")
    meshio.Mesh(x[:6], [("triangle6", np.arange(6)[None])]).write(tmp_path / "curved.vtu")
    says("curved.vtu", (tmp_path / "curved.vtu").read_bytes(), "cells of the kind triangle6 are not taken")
    (tmp_path / "voxel.vtu").write_text(VOXEL)
    assert "cells that meshio cannot handle (type 11). Elements would be missing" in fails("check", "voxel.vtu", cwd=tmp_path)
    says("poly.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 0 float\n", "save an unstructured grid (.vtu), or .ply")
    assert "is a directory" in fails("check", ".", cwd=tmp_path)


VOXEL = """<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="8" NumberOfCells="1"><Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">8</DataArray><DataArray type="Int64" Name="types" format="ascii">11</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>
"""


def test_obj_is_read_whole(tmp_path):
    """Lines, points, indices from the end, continued lines, textures: what meshio skips or takes for something else."""
    (tmp_path / "a.obj").write_text("\ufeff# comment\nmtllib x\nv 0 0 0 1\nv 1 0 0\nv 0 1 0 0.5 0.5 0.5\nvn 0 0 1\nf -3/1/1 -2//1 \\\n -1\n"
                                    "v 5 5 5\nv 6 5 5\nv 7 5 5\nl 4 5 6\nv 8 8 8\np 7\nfoo bar\nfoo\n", encoding="utf-8")
    scene = read_scene(str(tmp_path / "a.obj"))
    assert scene.mesh.faces.tolist() == [[0, 1, 2]]
    assert scene.mesh.edges.tolist() == [[0, 1], [0, 2], [1, 2], [3, 4], [4, 5], [6, 6]]
    assert scene.notes == [f"{tmp_path / 'a.obj'}: skipped 2 lines with keywords that are not OBJ's: 'foo'"]


def test_ply_is_read_whole(tmp_path):
    """Edges, colours behind the corners, both names of their list, both byte orders; ascii numbers are doubles."""
    x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.1], [0.2, 0.2, 1], [0.2, 0.2, 2]])
    polygons, edges = [[0, 1, 2], [1, 3, 2], [0, 1, 3, 2]], [[4, 5]]
    for order, letter in (("ascii", ""), ("binary_little_endian", "<"), ("binary_big_endian", ">")):
        for count in (2, 3):  # triangles alone, and faces of different size
            name = f"{order}{count}.ply"
            header = (f"ply\nformat {order} 1.0\ncomment made up\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                      f"property uchar red\nelement face {count}\nproperty list uchar ushort vertex_index\nproperty uchar red\n"
                      "element edge 1\nproperty int vertex1\nproperty int vertex2\nelement material 1\nproperty int id\nend_header\n")
            if letter:
                body = b"".join(struct.pack(f"{letter}fffB", *row, 7) for row in x)
                body += b"".join(struct.pack(f"{letter}B{len(p)}HB", len(p), *p, 3) for p in polygons[:count])
                body += struct.pack(f"{letter}iii", *edges[0], 5)
            else:
                rows = [[*row, 7] for row in x.tolist()] + [[len(p), *p, 3] for p in polygons[:count]] + edges + [[5]]
                body = "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()
            (tmp_path / name).write_bytes(header.encode() + body)
            mesh = read_mesh(str(tmp_path / name))
            assert (mesh.positions == (x.astype(np.float32) if letter else x)).all()
            assert [p.tolist() for p in mesh.polygons()] == polygons[:count] and mesh.wires.tolist() == edges
            assert mesh.notes == ["skipped element material, 1 row"]
            for cut in (len(body) - 2, len(body) // 2):
                (tmp_path / "cut.ply").write_bytes(header.encode() + body[:cut])
                assert fails("check", "cut.ply", cwd=tmp_path).startswith("cut.ply")


@pytest.mark.parametrize("line, says", [
    ("f 1 2 99999999999999999999", "a.obj:4: face 0 has '99999999999999999999' where a vertex index is expected"),
    ("f 1 2 " + 5000 * "9", "a.obj:4: face 0 has '999"),
    ("f 1 2 1_0", "a.obj:4: face 0 has '1_0' where a vertex index is expected"),
    ("f 1 2 \u0663", "a.obj:4: face 0 has '\u0663' where a vertex index is expected"),
    ("v 1_0 0 0", "a.obj:4: vertex 3 is not three finite numbers: '1_0 0 0'"),
], ids=["large", "long", "underscore", "digits", "number"])
def test_what_python_takes_for_numbers(tmp_path, line, says):
    (tmp_path / "a.obj").write_text(f"v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\nf 1 2 3\n", encoding="utf-8")
    assert fails("check", "a.obj", cwd=tmp_path).startswith(says)


@pytest.mark.parametrize("name, text, says", [
    ("a.off", "OFF", "a.off: OFF and three whole numbers expected at the start"), ("a.off", "", "a.off: "),
    ("a.off", "OFF\n+3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off: OFF and three whole numbers"),
    ("a.msh", "(0 \"ansys\")\n(2 3)\n", "a.msh: $MeshFormat expected at the start"), ("a.tec", "TITLE\n", "a.tec: Tecplot is not read"),
])
def test_files_that_meshio_would_wait_for(tmp_path, name, text, says):
    (tmp_path / name).write_text(text, encoding="utf-8")
    assert fails("check", name, cwd=tmp_path).startswith(says)


PLY_FAULTS = [
    ("format ascii 1.0", "format ascii 2.0", "x.ply:2: unknown 'format ascii 2.0'"),
    ("element face 1", "element face -1", "x.ply:7: element face has count '-1'"),
    ("element face 1", "element face 99999", "x.ply: element face has count 99999, the file has"),
    ("element face 1", "element vertex 1", "x.ply:7: a second element vertex"),
    ("property double z\n", "", "x.ply: no vertex property z: for two dimensions"),
    ("vertex_indices", "corners", "x.ply: no face property vertex_indices"),
    ("list uchar int", "list float int", "x.ply:8: property vertex_indices has count type 'float'"),
    ("list uchar int", "list uchar float", "x.ply: property vertex_indices has float values, indices expected"),
    ("3 0 1 2", "3 0 1", "x.ply:13: face 0 says that list vertex_indices has '3' values: '3 0 1'"),
    ("3 0 1 2", "3 0 1 2 9", "x.ply:13: face 0 has 5 values, 4 expected: '3 0 1 2 9'"),
    ("3 0 1 2", "3 0 1 3", "x.ply: face 0 has vertex index 3, not in [0, 3)"),
    ("0 1 0\n", "0 one 0\n", "x.ply:12: vertex 2 has a word where a number is expected: '0 one 0'"),
    ("3 0 1 2\n", "3 0 1 2\n4\n", "x.ply:14: more than the header tells of: '4'"),
    ("end_header", "end", "x.ply:9: unknown line in the header: 'end'"),
    ("3 0 1 2", "0", "x.ply: face 0 has no vertices"),
]


@pytest.mark.parametrize("old, new, says", PLY_FAULTS, ids=[says for *_, says in PLY_FAULTS])
def test_broken_ply(tmp_path, old, new, says):
    good = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
            "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    assert old in good
    (tmp_path / "x.ply").write_text(good.replace(old, new))
    assert fails("check", "x.ply", cwd=tmp_path).startswith(says)


def test_differences_are_named(tmp_path):
    x, end, hexahedra = two_cubes()
    whole, turned = tetrahedra(hexahedra), tetrahedra(hexahedra)
    turned[5] = turned[5][[1, 0, 2, 3]]

    def differ(a, b):
        for name, cells in (("a", a), ("b", b)):
            meshio.Mesh(x, cells).write(tmp_path / f"{name}.vtu")
        return fails("step", "a.vtu", "b.vtu", cwd=tmp_path).replace("a.vtu and b.vtu: different topology: ", "")

    faces = triangles(np.array([[0, 1, 2, 3], [4, 5, 6, 7]]))
    assert differ([("tetra", whole)], [("tetra", whole[:-1])]) == "cells are 324 tetra against 323 tetra"
    row = " ".join(map(str, whole[5]))
    assert differ([("tetra", whole)], [("tetra", turned)]) == f"tetra 5 is ({row}) against ({' '.join(map(str, turned[5]))})"
    assert differ([("triangle", faces)], [("triangle", faces[[0, 1, 3, 2]])]) == "face 2 is (4 5 6) against (4 6 7)"
    assert differ([("triangle", faces)], [("triangle", faces[:2])]) == "4 against 2 faces"
    assert differ([("line", np.array([[0, 1]]))], [("line", np.array([[1, 0]]))]) == "wire 0 is (0 1) against (1 0)"
    assert differ([("vertex", np.array([[0]]))], [("vertex", np.array([[1]]))]) == "point 0 is (0) against (1)"


def test_cells_that_cannot_be(tmp_path):
    x = np.eye(4, 3)
    meshio.Mesh(np.vstack([x, x + 2, x + 4]), [("tetra", np.array([[0, 1, 2, 3], [1, 0, 2, 3]]))]).write(tmp_path / "twice.vtu")
    assert "twice.vtu" in fails("check", "twice.vtu", cwd=tmp_path)
    meshio.Mesh(np.vstack([x, x + 2, x + 4]), [("pyramid", np.array([[0, 1, 2, 3, 4], [1, 2, 3, 0, 4]]))]).write(tmp_path / "twice.vtu")
    assert fails("check", "twice.vtu", cwd=tmp_path) == "twice.vtu: pyramid 1 has the vertices of pyramid 0"


def test_a_missing_package_is_named(tmp_path):
    """With the command that installs it."""
    (tmp_path / "a.vtk").write_text("x")
    code = "import sys; sys.modules['meshio'] = None; from onset_ccd.__main__ import main; sys.exit(main(['check', 'a.vtk']))"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr == ("onset_ccd: reading a.vtk needs meshio, which is not installed: pip install meshio, or 'onset-ccd[files]'\n")


def test_obj_needs_no_meshio(tmp_path):
    x, quads = sheet(3, 0.0)
    write_obj(tmp_path / "a.obj", x, quads)
    code = "import sys; sys.modules['meshio'] = None; from onset_ccd.__main__ import main; sys.exit(main(['check', 'a.obj']))"
    assert subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True).returncode == 0
