"""Reads a mesh with meshio, and looks at what it made of the file."""

import contextlib
import io
import os
import re
import warnings

import numpy as np

from .errors import InputError, missing, one_line
from .mesh_file import MeshFile, finish

# What meshio says when it leaves elements out.
LEFT_OUT = re.compile(r"cannot handle|doesn't know|could not parse|[Uu]nsupported")
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


def check_end(path):
    """meshio's readers of these formats wait for ever where a file ends too soon."""
    name = path.lower()
    if name.endswith((".tec", ".dat", ".plt")):
        raise InputError(f"{path}: Tecplot is not read: save .vtu or .ply")
    if name.endswith(".msh"):
        with open(path, "rb") as file:
            if not file.read(64).lstrip().startswith(b"$"):
                raise InputError(f"{path}: $MeshFormat expected at the start, as Gmsh writes it; the .msh of other programs is not read")


def check_off(path):
    """meshio would take colours of faces for the next face."""
    if not path.lower().endswith(".off"):
        return
    with open(path, encoding="utf-8", errors="replace") as file:
        words = " ".join(line.split("#", 1)[0] for line in file).split()
    if not words or words[0] != "OFF" or len(words) < 4 or not all(re.fullmatch("[0-9]+", word) for word in words[1:4]):
        raise InputError(f"{path}: OFF and three whole numbers expected at the start")
    expected = 4 + 3 * int(words[1]) + 4 * int(words[2])
    if len(words) != expected:
        raise InputError(f"{path}: {len(words)} words, {expected} expected of {words[1]} vertices and {words[2]} triangles: write .ply, "
                         "or triangles without colours")


def cause_of(error, said):
    """In words; meshio prints what it knows, and leaves by sys.exit."""
    if isinstance(error, ImportError):
        return f"this format needs the package {error.name}: pip install {error.name}"
    printed = [line for line in said.splitlines() if line.strip() and line.strip() != "None"]
    if isinstance(error, SystemExit):
        if any("not POLYDATA" in line for line in printed):
            return "POLYDATA, which meshio does not read: save an unstructured grid (.vtu), or .ply"
        told = [line for line in printed if not line.startswith("Error: ")]
        return one_line(told[0]) if told else "meshio cannot read it, the file is damaged or of another format"
    if isinstance(error, (AssertionError, IndexError, KeyError, ValueError, TypeError)) or not str(error):
        return f"meshio cannot read it, the file is damaged or of another format ({type(error).__name__}: {one_line(error)[:200]})"
    return one_line(error)[:300]


def call_meshio(path):
    """(mesh, what meshio said on the way)"""
    meshio = import_meshio(path)
    check_extension(meshio, path)
    check_off(path)
    check_end(path)
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            mesh = meshio.read(path)
    except KeyboardInterrupt:
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


def read_with_meshio(path):
    mesh, said = call_meshio(path)
    try:
        return converted(path, mesh, said)
    except (IndexError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: what meshio made of it is no mesh, the file is damaged ({type(error).__name__}: {one_line(error)[:200]})") from None


def converted(path, mesh, said):
    result = MeshFile(path, positions_of(path, mesh))
    if LEFT_OUT.search(said):
        raise InputError(f"{path}: {said} Elements would be missing: write linear cells and polygons")
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
    return finish(result)
