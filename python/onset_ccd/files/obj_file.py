"""Wavefront OBJ: v, f, l, p. meshio reads its faces only, and takes indices from the end for others."""

import re

import numpy as np

from .errors import InputError
from .mesh_file import MeshFile, finish
from .numbers import plain_float

# What says how a mesh looks, or belongs to what is refused anyhow.
LOOKS = set("vt vn g s o mg usemtl mtllib usemap maplib bevel c_interp vp lod step deg bmat d_interp cstype shadow_obj trace_obj "
            "ctech parm trim hole scrv sp stech end con res".split())
# Shapes that are no polygons, and other files.
OTHER = set("curv curv2 surf bzp bsp cdc cdp call csh".split())
NAMED = 10


def statements(text):
    """(line number, words) of each statement; those of elements go on behind a line that ends in a backslash."""
    lines = enumerate(text.split("\n"), 1)
    for number, line in lines:
        words = line.split("#", 1)[0].split()
        while words and words[0] in ("v", "f", "fo", "l", "p") and words[-1].endswith("\\"):
            words[-1] = words[-1][:-1]
            words = [word for word in words if word] + next(lines, (0, ""))[1].split("#", 1)[0].split()
        if words:
            yield number, words


class ObjReader:
    def __init__(self, path):
        self.mesh = MeshFile(path, np.empty((0, 3)))
        self.vertices, self.faces, self.wires, self.points = [], [], [], []
        self.columns = None  # 2 or 3, as the first vertex has
        self.counts = {"face": 0, "wire": 0, "point": 0}
        self.skipped = {}

    def fail(self, number, cause):
        raise InputError(f"{self.mesh.path}:{number}: {cause}")

    def vertex(self, number, words):
        place = f"vertex {len(self.vertices)}"
        try:
            values = [plain_float(word) for word in words]
        except ValueError:
            self.fail(number, f"{place} is not three finite numbers: '{' '.join(words)}'")
        columns = 2 if len(values) == 2 else 3
        if (self.columns or columns) != columns or (columns == 3 and len(values) not in (3, 4, 6, 7)):
            self.fail(number, f"{place} has {len(values)} numbers, {self.columns or 3} expected: '{' '.join(words)}'")
        self.columns = columns
        self.vertices.append((values + [0.0])[:3])

    def ids(self, number, what, words):
        place = f"{what} {self.counts[what]}"
        for word in words:
            if not re.fullmatch(r"[+-]?[0-9]{1,18}(/[+-]?[0-9]*){0,2}", word):
                self.fail(number, f"{place} has '{word}' where a vertex index is expected")
        values = [int(word.split("/")[0]) for word in words]
        for value in values:
            if value == 0:
                self.fail(number, f"{place} has vertex index 0; the first vertex is 1")
            if value < -len(self.vertices):
                self.fail(number, f"{place} has vertex index {value}, but only {len(self.vertices)} vertices come before it")
        if not values:
            self.fail(number, f"{place} has no vertices")
        return [value - 1 if value > 0 else len(self.vertices) + value for value in values]

    def polyline(self, number, what, ids):
        if len(ids) < 2:
            self.fail(number, f"{what} {self.counts[what]} has {len(ids)} vertices, two or more expected")
        self.wires += zip(ids[:-1], ids[1:])

    def face(self, number, words):
        ids = self.ids(number, "face", words)
        if len(ids) == 1:
            self.points += ids
        elif len(ids) == 2:
            self.polyline(number, "face", ids)
        else:
            self.faces.append(ids)
        self.counts["face"] += 1

    def statement(self, number, words):
        keyword, rest = words[0], words[1:]
        if keyword == "v":
            self.vertex(number, rest)
        elif keyword in ("f", "fo"):
            self.face(number, rest)
        elif keyword == "l":
            self.polyline(number, "wire", self.ids(number, "wire", rest))
            self.counts["wire"] += 1
        elif keyword == "p":
            self.points += self.ids(number, "point", rest)
            self.counts["point"] = len(self.points)
        elif keyword in OTHER:
            self.fail(number, f"'{keyword}' is not read: export polygons, in one file")
        elif keyword[0] in "0123456789+-.":
            self.fail(number, f"a line starts with '{keyword}', a keyword expected")
        elif keyword not in LOOKS:
            self.skipped[keyword] = self.skipped.get(keyword, 0) + 1

    def read(self, text):
        for number, words in statements(text):
            self.statement(number, words)
        if self.skipped:
            count = sum(self.skipped.values())
            names = " ".join(f"'{name}'" for name in list(self.skipped)[:NAMED]) + (" ..." if len(self.skipped) >= NAMED else "")
            self.mesh.notes.append(f"skipped {count} line{'s' * (count != 1)} with keywords that are not OBJ's: {names}")
        mesh = self.mesh
        mesh.positions = np.array(self.vertices, float).reshape(-1, 3)
        mesh.set_polygons([self.faces])
        mesh.wires = np.array(self.wires, np.int64).reshape(-1, 2)
        mesh.points = np.array(self.points, np.int64)
        return finish(mesh, base=1)


def read_obj(path):
    try:
        with open(path, encoding="utf-8-sig", errors="surrogateescape") as file:
            text = file.read()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if "\0" in text:
        raise InputError(f"{path}: a byte 0 in a text: the file is damaged, or no text")
    return ObjReader(path).read(text)
