"""PLY, ascii and of either byte order: vertex, face, edge. meshio has no edges, takes one name of the list of corners only, and takes
colours of binary faces for the next face."""

import re
import struct
from dataclasses import dataclass, field

import numpy as np

from .errors import InputError
from .mesh_file import MeshFile, finish
from .numbers import plain_float, plain_int

TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4", "double": "f8", "int8": "i1",
         "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"}
LETTERS = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "f4": "f", "f8": "d"}
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass
class Property:
    name: str
    type: str
    count_type: str = ""  # of a list


@dataclass
class Element:
    name: str
    count: int
    properties: list = field(default_factory=list)

    def find(self, *names):
        return next((p for p in self.properties if p.name in names), None)


class Header:
    def __init__(self, path, data):
        self.path, self.number, self.elements, self.order = path, 0, [], None
        data = data[3:] if data.startswith(b"\xef\xbb\xbf") else data
        end = re.search(rb"\r\n|\n|\r", data)
        self.line_end = end.group() if end else b"\n"
        position = 0
        while True:
            stop = data.find(self.line_end, position)
            line = data[position:stop if stop >= 0 else len(data)]
            self.number += 1
            words = line.decode("latin-1").split()
            if self.number == 1 and words != ["ply"]:
                self.fail("not a PLY file")
            if stop < 0 and words != ["end_header"]:
                self.fail("the header has no end")
            position = stop + len(self.line_end) if stop >= 0 else len(data)
            if words == ["end_header"]:
                break
            if self.number > 1 and words and words[0] not in ("comment", "obj_info"):
                self.statement(words)
        if self.order is None:
            self.fail("no format in the header")
        self.body = data[position:]

    def fail(self, cause):
        raise InputError(f"{self.path}:{self.number}: {cause}")

    def statement(self, words):
        quoted = f"'{' '.join(words)}'"
        if words[0] == "format":
            if len(words) != 3 or words[2] != "1.0" or words[1] not in ORDERS:
                self.fail(f"unknown {quoted}")
            self.order = ORDERS[words[1]]
        elif words[0] == "element":
            self.element(words, quoted)
        elif words[0] == "property":
            self.property(words, quoted)
        else:
            self.fail(f"unknown line in the header: {quoted}")

    def element(self, words, quoted):
        if len(words) != 3:
            self.fail(f"an element has a name and a count, here is {quoted}")
        if not re.fullmatch(r"\d{1,18}", words[2]):
            self.fail(f"element {words[1]} has count '{words[2]}'")
        if any(e.name == words[1] for e in self.elements):
            self.fail(f"a second element {words[1]}")
        self.elements.append(Element(words[1], int(words[2])))

    def property(self, words, quoted):
        if not self.elements:
            self.fail("a property before any element")
        is_list = len(words) > 1 and words[1] == "list"
        if len(words) != (5 if is_list else 3):
            self.fail(f"a property has a type and a name, here is {quoted}")
        name = words[-1]
        for kind in words[2:4] if is_list else words[1:2]:
            if kind not in TYPES:
                self.fail(f"property {name} has unknown type '{kind}'")
        if is_list and TYPES[words[2]][0] == "f":
            self.fail(f"property {name} has count type '{words[2]}'")
        if self.elements[-1].find(name):
            self.fail(f"a second property {name} of element {self.elements[-1].name}")
        self.elements[-1].properties.append(Property(name, TYPES[words[-2]], TYPES[words[2]] if is_list else ""))


class TextBody:
    """Numbers are doubles, whatever type the header says."""

    def __init__(self, header):
        self.path, self.number = header.path, header.number
        self.lines = iter(header.body.decode("latin-1").splitlines())
        self.left = len(header.body) + 1

    def least(self, element):
        return 2 * len(element.properties)

    def read(self, element):
        columns = {p.name: [] for p in element.properties}
        for row in range(element.count):
            self.row(element, row, columns)
        return columns

    def row(self, element, row, columns):
        words = []
        while not words:
            line = next(self.lines, None)
            if line is None:
                raise InputError(f"{self.path}: {element.name} {row} is not there: the file ends before it")
            self.number += 1
            words = line.split()
        place, at = f"{self.path}:{self.number}: {element.name} {row}", 0
        try:
            for p in element.properties:
                if p.count_type:
                    length = int(words[at])
                    if not 0 <= length <= len(words) - at - 1:
                        raise InputError(f"{place} says that list {p.name} has '{words[at]}' values: '{line.strip()}'")
                    columns[p.name].append([self.value(p, word) for word in words[at + 1 : at + 1 + length]])
                    at += 1 + length
                else:
                    columns[p.name].append(self.value(p, words[at]))
                    at += 1
        except IndexError:
            raise InputError(f"{place} has too few values: '{line.strip()}'") from None
        except ValueError:
            raise InputError(f"{place} has a word where a number is expected: '{line.strip()}'") from None
        if at < len(words):
            raise InputError(f"{place} has {len(words)} values, {at} expected: '{line.strip()}'")

    @staticmethod
    def value(p, word):
        return plain_float(word) if p.type[0] == "f" else plain_int(word)

    def end(self):
        for line in self.lines:
            self.number += 1
            if line.strip():
                raise InputError(f"{self.path}:{self.number}: more than the header tells of: '{line.strip()[:60]}'")


class BinaryBody:
    def __init__(self, header):
        self.path, self.order, self.rest = header.path, header.order, memoryview(header.body)

    @property
    def left(self):
        return len(self.rest)

    def least(self, element):
        return sum(np.dtype(p.count_type or p.type).itemsize for p in element.properties)

    def read(self, element):
        lists = [p for p in element.properties if p.count_type]
        if element.count == 0:
            return {p.name: [] for p in element.properties}
        if len(lists) <= 1:
            columns = self.read_rows_of_one_size(element)
            if columns is not None:
                return columns
        return self.read_row_by_row(element)

    def read_rows_of_one_size(self, element):
        """None where the rows differ in size: the first count that does is in the place where it is looked for."""
        fields = []
        for p in element.properties:
            if p.count_type:
                fields.append((f"count of {p.name}", self.order + p.count_type))
                before = np.dtype(fields).itemsize
                length = int(np.frombuffer(self.rest, self.order + p.count_type, 1, before - np.dtype(p.count_type).itemsize)[0])
                if not 0 <= length <= self.left:
                    return None
                fields.append((p.name, self.order + p.type, (length,)))
            else:
                fields.append((p.name, self.order + p.type))
        size = np.dtype(fields).itemsize * element.count
        if size > self.left:
            return None
        rows = np.frombuffer(self.rest, np.dtype(fields), element.count)
        for p in element.properties:
            if p.count_type and (rows[f"count of {p.name}"] != rows[p.name].shape[1]).any():
                return None
        self.rest = self.rest[size:]
        return {p.name: rows[p.name] for p in element.properties}

    def read_row_by_row(self, element):
        columns = {p.name: [] for p in element.properties}
        at = 0
        for row in range(element.count):
            for p in element.properties:
                try:
                    length = 1
                    if p.count_type:
                        (length,) = struct.unpack_from(self.order + LETTERS[p.count_type], self.rest, at)
                        at += np.dtype(p.count_type).itemsize
                    if not 0 <= length <= self.left:
                        raise struct.error
                    values = struct.unpack_from(f"{self.order}{length}{LETTERS[p.type]}", self.rest, at)
                except struct.error:
                    raise InputError(f"{self.path}: {element.name} {row} is cut off: the file ends within it") from None
                at += length * np.dtype(p.type).itemsize
                columns[p.name].append(values if p.count_type else values[0])
        self.rest = self.rest[at:]
        return columns

    def end(self):
        if bytes(self.rest).strip(b" \t\r\n"):
            raise InputError(f"{self.path}: {self.left} bytes more than the header tells of")


class PlyReader:
    def __init__(self, path, data):
        self.header = Header(path, data)
        self.body = BinaryBody(self.header) if self.header.order else TextBody(self.header)
        self.mesh = MeshFile(path, np.empty((0, 3)))

    def fail(self, cause):
        raise InputError(f"{self.mesh.path}: {cause}")

    def read(self):
        if not any(e.name == "vertex" for e in self.header.elements):
            self.fail("no element vertex")
        for element in self.header.elements:
            self.check_size(element)
            if element.name == "vertex":
                self.check_vertex(element)
            columns = self.body.read(element)
            getattr(self, element.name if element.name in ("vertex", "face", "edge") else "other")(element, columns)
        self.body.end()
        return finish(self.mesh)

    def check_size(self, e):
        """Before anything is made as large as a count says."""
        if e.count and not e.properties:
            self.fail(f"element {e.name} has no properties")
        if e.count * self.body.least(e) > self.body.left:
            self.fail(f"element {e.name} has count {e.count}, the file has {self.body.left} bytes left")

    def check_vertex(self, element):
        for axis in "xyz":
            p = element.find(axis)
            if p is None:
                self.fail(f"no vertex property {axis}" + (": for two dimensions add a third coordinate of 0, and give --dim 2" * (axis == "z")))
            if p.count_type:
                self.fail(f"vertex property {axis} is a list")

    def vertex(self, element, columns):
        self.mesh.positions = np.column_stack([np.asarray(columns[axis], float) for axis in "xyz"]).reshape(-1, 3)

    def index_list(self, element):
        p = next((p for p in element.properties if p.count_type and p.name in ("vertex_indices", "vertex_index")), None)
        if p and p.type[0] == "f":
            self.fail(f"property {p.name} has float values, indices expected")
        return p

    def face(self, element, columns):
        p = self.index_list(element)
        if p is None:
            if element.count:
                self.fail("no face property vertex_indices")
            return
        rows = columns[p.name]
        if isinstance(rows, np.ndarray) and rows.shape[1] >= 3:
            self.mesh.set_polygons([rows.astype(np.int64)])
            return
        rows = [[int(v) for v in row] for row in rows]
        for i, row in enumerate(rows):
            if not row:
                self.fail(f"face {i} has no vertices")
        self.mesh.set_polygons([[row for row in rows if len(row) > 2]])
        self.add_wires([row for row in rows if len(row) == 2])
        self.mesh.points = np.array([row[0] for row in rows if len(row) == 1], np.int64)

    def edge(self, element, columns):
        first, second, chain = element.find("vertex1"), element.find("vertex2"), self.index_list(element)
        if first and second:
            for p in (first, second):
                if p.count_type:
                    self.fail(f"property {p.name} is a list, one index expected")
                if p.type[0] == "f":
                    self.fail(f"property {p.name} has float values, indices expected")
            self.add_wires(np.column_stack([np.asarray(columns[p.name], np.int64) for p in (first, second)]).reshape(-1, 2))
        elif chain:
            for i, row in enumerate(columns[chain.name]):
                if len(row) < 2:
                    self.fail(f"edge {i} has {len(row)} vertices, two or more expected")
                self.add_wires([(int(a), int(b)) for a, b in zip(row[:-1], row[1:])])
        elif element.count:
            self.fail("no edge properties vertex1 and vertex2")

    def add_wires(self, rows):
        self.mesh.wires = np.concatenate([self.mesh.wires, np.asarray(rows, np.int64).reshape(-1, 2)])

    def other(self, element, columns):
        if element.name == "tristrips" and element.count:
            self.fail("triangle strips are not read: write triangles, with MeshLab say")
        if element.count:
            self.mesh.notes.append(f"skipped element {element.name}, {element.count} row{'s' * (element.count != 1)}")


def read_ply(path):
    try:
        with open(path, "rb") as file:
            data = file.read()
        return PlyReader(path, data).read()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except OverflowError:
        raise InputError(f"{path}: an index of more than 63 bits") from None
