"""Reads a mesh with meshio, and looks at what it made of the file."""

import contextlib
import io
import os
import re
import warnings

import numpy as np

from .errors import InputError, missing, one_line
from .mesh_file import MeshFile, finish

SOLIDS = ("tetra", "hexahedron", "wedge", "pyramid")


def import_meshio(path):
    try:
        import meshio
    except ImportError:
        raise missing("meshio", "files", f"reading {path}") from None
    return meshio


def check_extension(meshio, path):
    known = meshio._helpers.extension_to_filetypes
    name = os.path.basename(path).lower()
    if not any(name.endswith(extension) for extension in known):
        extension = os.path.splitext(name)[1]
        raise InputError(f"{path}: {'unknown extension ' + extension if extension else 'no extension'}, "
                         f"one of {', '.join(sorted(known))} expected")


def ply_source(path):
    """The bytes of a PLY file as meshio understands them. It knows one name of the list of corners, and would take a binary face with
    more than that list for the next face."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.find(b"end_header")
    header = data[:end].decode("latin-1")
    of_faces = re.search(r"element face .*?(?=element |\Z)", header, re.DOTALL)
    if end >= 0 and of_faces and "format binary" in header and len(re.findall(r"(?m)^property", of_faces.group())) > 1:
        raise InputError(f"{path}: meshio does not read binary PLY with colours or other data of faces: write ascii, or .vtk")
    header = re.sub(r"(?m)^(property list \S+ \S+ )vertex_index(\s*)$", r"\1vertex_indices\2", header)
    return io.BytesIO(header.encode("latin-1") + data[end:]) if end >= 0 else io.BytesIO(data)


def cause_of(error, said):
    """In words; meshio prints what it knows, and leaves by sys.exit."""
    if isinstance(error, ImportError):
        return f"this format needs the package {error.name}: pip install {error.name}"
    printed = [line for line in said.splitlines() if line.strip() and line.strip() != "None"]
    if isinstance(error, SystemExit):
        told = [line for line in printed if not line.startswith("Error: ")]
        return one_line(told[0]) if told else "meshio cannot read it, the file is damaged or of another format"
    if isinstance(error, (AssertionError, IndexError, KeyError, ValueError, TypeError)) or not str(error):
        return f"meshio cannot read it, the file is damaged or of another format ({type(error).__name__}: {one_line(error)[:200]})"
    return one_line(error)[:300]


def call_meshio(path):
    """(mesh, what meshio said on the way)"""
    meshio = import_meshio(path)
    check_extension(meshio, path)
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            if path.lower().endswith(".ply"):
                mesh = meshio.read(ply_source(path), file_format="ply")
            else:
                mesh = meshio.read(path)
    except (InputError, KeyboardInterrupt):
        raise
    except MemoryError:
        raise InputError(f"{path}: not enough memory for its {os.path.getsize(path)} bytes") from None
    except (Exception, SystemExit) as error:
        raise InputError(f"{path}: {cause_of(error, said.getvalue())}") from None
    return mesh, one_line(said.getvalue())


def positions_of(path, mesh):
    points = np.asarray(mesh.points, float)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InputError(f"{path}: no vertices" if points.size == 0 else f"{path}: positions of {points.shape[-1]} numbers, 3 expected")
    return np.ascontiguousarray(np.pad(points, ((0, 0), (0, 3 - points.shape[1]))))


def check_count(path, result):
    """PLY says how many faces there are; what meshio does not know it skips without a word."""
    if not path.lower().endswith(".ply"):
        return
    with open(path, "rb") as file:
        stated = re.search(rb"element face (\d+)", file.read(1 << 16).split(b"end_header")[0])
    found = len(result.ends) + len(result.wires) + len(result.points)
    if stated and int(stated.group(1)) != found:
        raise InputError(f"{path}: {int(stated.group(1))} faces are stated, and meshio finds {found}")


def read_with_meshio(path):
    mesh, said = call_meshio(path)
    result = MeshFile(path, positions_of(path, mesh))
    if said:
        result.notes.append(f"meshio says: {said}")
    polygons, wires, points = [], [result.wires], [result.points]
    for block in mesh.cells:
        cells = block.data if isinstance(block.data, np.ndarray) and block.data.ndim == 2 else list(block.data)
        cells = cells.astype(np.int64) if isinstance(cells, np.ndarray) else cells
        if block.type == "vertex":
            points.append(np.asarray(cells).ravel())
        elif block.type == "line":
            wires.append(cells)
        elif block.type in ("triangle", "quad") or re.fullmatch(r"polygon\d*", block.type):
            polygons.append(cells)
        elif block.type in SOLIDS:
            result.solids.append((block.type, cells))
        elif len(cells):
            raise InputError(f"{path}: cells of the kind {block.type} are not taken: write linear ones ({', '.join(SOLIDS)}, polygons, lines)")
    result.set_polygons(polygons)
    result.wires, result.points = np.concatenate(wires), np.concatenate(points)
    check_count(path, result)
    if path.lower().endswith(".stl"):
        part_corners(result)
    return finish(result)


def part_corners(mesh):
    """As STL has them, each with a vertex of its own: meshio has merged those at one place, each file on its own."""
    mesh.positions = mesh.positions[mesh.corners]
    mesh.corners = np.arange(len(mesh.corners))
    mesh.shares_vertices = False
