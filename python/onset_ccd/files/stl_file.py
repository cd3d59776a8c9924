"""STL, ascii and binary; each corner is a vertex of its own. meshio takes the lines of a text for what they should be, and merges corners of
one file without a look at the other."""

import struct

import numpy as np

from .errors import InputError
from .mesh_file import MeshFile, finish

HEADER, ROW = 84, 50


def is_text(path, data):
    """A binary file may start with "solid", too: its size tells."""
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= HEADER else 0
    if len(data) >= HEADER and len(data) == HEADER + ROW * count:
        return False
    if data.lstrip(b"\xef\xbb\xbf \t\r\n")[:5].lower() == b"solid":
        return True
    if len(data) < HEADER:
        raise InputError(f"{path}: not an STL file")
    raise InputError(f"{path}: not an STL file, or cut off: as a binary one it has {count} faces, of {ROW} bytes each, in "
                     f"{len(data) - HEADER} bytes")


def corners_of_binary(data):
    rows = np.frombuffer(data, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]), offset=HEADER)
    return rows["corners"].reshape(-1, 3).astype(float)


def corners_of_text(path, text):
    """"facet normal", three "vertex" in a loop, "endfacet"; what a solid is called, or how often there is one, is all the same."""
    corners, first, facets = [], None, 0

    def fail(number, cause):
        raise InputError(f"{path}:{number}: {cause}")

    for number, line in enumerate(text.splitlines(), 1):
        words = line.split()
        keyword = words[0].lower() if words else "solid"
        if keyword == "facet":
            if first is not None:
                fail(number, "a facet within a facet")
            first = len(corners)
        elif keyword == "vertex":
            if first is None:
                fail(number, f"vertex {len(corners)} is in no facet")
            try:
                x, y, z = map(float, words[1:])
            except ValueError:
                fail(number, f"vertex {len(corners)} is not three finite numbers: '{line.strip()}'")
            corners.append((x, y, z))
        elif keyword == "endfacet":
            count = len(corners) - (len(corners) if first is None else first)
            if count != 3:
                fail(number, f"face {facets} has {count} corners, 3 expected")
            first, facets = None, facets + 1
        elif keyword not in ("solid", "endsolid", "outer", "endloop"):
            fail(number, f"unknown line '{line.strip()}'")
    if first is not None:
        fail(text.count("\n") + 1, "the file ends within a facet")
    return np.array(corners, float).reshape(-1, 3)


def read_stl(path):
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    corners = corners_of_text(path, data.decode("utf-8-sig", "replace")) if is_text(path, data) else corners_of_binary(data)
    mesh = MeshFile(path, corners, shares_vertices=False)
    mesh.set_polygons([np.arange(len(corners)).reshape(-1, 3)])
    return finish(mesh)
