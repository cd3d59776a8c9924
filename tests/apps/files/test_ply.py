"""PLY of every kind that people have, and headers that promise what the file does not hold."""

import itertools
import struct
import unittest

from support import END, FACES, START, AppTest, obj, ply

BAD = 1
ENCODINGS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
CODES = {"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H", "uint16": "H",
         "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f", "double": "d",
         "float64": "d"}


def typed_ply(encoding, elements):
    """elements: (name, properties, rows); properties: "double x" or "list uchar int vertex_indices"; lists in a row are
    tuples."""
    header = f"ply\nformat {encoding} 1.0\n"
    body = b""
    for name, properties, rows in elements:
        header += f"element {name} {len(rows)}\n" + "".join(f"property {p}\n" for p in properties)
        types = [p.split()[:-1] for p in properties]
        for row in rows:
            values = [pair for kinds, value in zip(types, row) for pair in (
                [(kinds[1], len(value))] + [(kinds[2], v) for v in value] if kinds[0] == "list" else [(kinds[0], value)])]
            if encoding == "ascii":
                body += (" ".join(repr(v) for _, v in values) + "\n").encode()
            else:
                body += struct.pack(ENCODINGS[encoding] + "".join(CODES[t] for t, _ in values), *(v for _, v in values))
    return (header + "end_header\n").encode() + body


XYZ = ["double x", "double y", "double z"]
CORNERS = ["list uchar int vertex_indices"]


class Kinds(AppTest):
    def setUp(self):
        super().setUp()
        self.expected = self.active_set(obj(START, FACES), obj(END, FACES), "obj")[0]

    def active_set(self, start, end, extension="ply"):
        frames = [self.write(f"{name}.{extension}", data) for name, data in [("a", start), ("b", end)]]
        notes = self.json("active-set", *frames, "--csv", "rows.csv").get("notes", [])
        return (self.folder / "rows.csv").read_text(), notes

    def same(self, make):
        result, notes = self.active_set(make(START), make(END))
        self.assertEqual(result, self.expected)
        return notes

    def test_every_type_of_index(self):
        for encoding, count, index in itertools.product(ENCODINGS, ["char", "uint8", "ushort", "int16", "int32", "uint"], CODES):
            if CODES[index] in "fd":
                continue
            with self.subTest(encoding=encoding, count=count, index=index):
                make = lambda points: typed_ply(encoding, [("vertex", XYZ, points), (
                    "face", [f"list {count} {index} vertex_index"], [(f,) for f in FACES])])
                self.assertEqual(self.same(make), [])

    def test_whole_coordinates(self):
        doubled = lambda points: [tuple(2 * x for x in p) for p in points]
        expected = self.active_set(obj(doubled(START), FACES), obj(doubled(END), FACES), "obj")[0]
        for encoding in ENCODINGS:
            for kind in ["char", "short", "int"]:
                make = lambda points: typed_ply(encoding, [
                    ("vertex", [f"{kind} x", f"{kind} y", f"{kind} z"], [tuple(map(int, p)) for p in doubled(points)]),
                    ("face", CORNERS, [(f,) for f in FACES])])
                self.assertEqual(self.active_set(make(START), make(END))[0], expected)

    def test_other_properties_and_elements_in_any_order(self):
        for encoding in ENCODINGS:
            make = lambda points: typed_ply(encoding, [
                ("camera", ["float fov", "list uint8 short name"], [(0.5, (1, 2, 3)), (0.25, ())]),
                ("face", ["uchar flags", "list uchar float texcoord"] + CORNERS + ["double area"],
                 [(7, (0.5, 0.5), f, 0.125) for f in FACES]),
                ("vertex", ["double z", "uchar red", "list int int neighbours", "double y", "double x"],
                 [(z, 255, (1, 2), y, x) for x, y, z in points])])
            notes = self.same(make)
            self.assertEqual(len(notes), 1)
            self.assertIn("skipped element camera, 2 rows", notes[0])

    def test_ways_to_write_lines(self):
        for encoding in ENCODINGS:
            def make(ending):
                def change(points):
                    whole = ply(points, FACES, encoding)
                    at = whole.index(b"end_header\n") + 11
                    body = whole[at:] if ENCODINGS[encoding] else whole[at:].replace(b"\n", ending)
                    return whole[:at].replace(b"\n", ending) + body
                return change
            for ending in [b"\r\n", b"\r", b"\n"]:
                self.assertEqual(self.same(make(ending)), [])
            self.assertEqual(self.same(lambda points: ply(points, FACES, encoding) + b"\r\n"), [])
        spaced = lambda points: ply(points, FACES).replace(b"\n3 ", b" \t\n\n3\t").replace(b"comment", b"obj_info")
        self.assertEqual(self.same(spaced), [])

    def test_wires(self):
        """A wire falls through a face: at 1/2, where its vertices alone pass beside it."""
        start, end = START[:3] + [(-1, 1, 1), (5, 1, 1)], START[:3] + [(-1, 1, -1), (5, 1, -1)]
        face = ("face", CORNERS, [((0, 1, 2),)])
        expected = None
        for encoding in ENCODINGS:
            for wires in [("edge", ["int vertex1", "int vertex2"], [(3, 4), (0, 1)]),
                          ("edge", ["ushort vertex2", "uchar red", "uchar vertex1"], [(4, 9, 3), (0, 9, 1)]),
                          ("edge", ["list uchar short vertex_indices"], [((3, 4),), ((1, 0),)])]:
                frames = [typed_ply(encoding, [("vertex", XYZ, points), face, wires]) for points in [start, end]]
                result, notes = self.active_set(*frames)
                self.assertEqual(notes, [])
                self.assertEqual({row.split(",")[0] for row in result.splitlines()[1:]}, {"ee"})
                self.assertEqual({row.split(",")[2] for row in result.splitlines()[1:]}, {"3"})
                expected = expected or result
                self.assertEqual(result, expected)
        two_corners = [typed_ply("ascii", [("vertex", XYZ, points), ("face", CORNERS, [((0, 1, 2),), ((3, 4),)])])
                       for points in [start, end]]
        self.assertEqual(self.active_set(*two_corners), (expected, []))

    def test_points(self):
        """Without any element every vertex is a point: kept a distance apart."""
        cloud = lambda points: typed_ply("binary_big_endian", [("vertex", XYZ, points)])
        empty = lambda points: typed_ply("ascii", [("vertex", XYZ, points), ("face", CORNERS, [])])
        for make in [cloud, empty]:
            a, b = [self.write(name, make(p)) for name, p in [("p.ply", [(0, 0, 0), (0, 0, 2)]), ("q.ply", [(0, 0, 0), (0, 0, 1)])]]
            result = self.json("step", a, b, "--min-separation", "1.5", "--tolerance", "1e-9")
            self.assertEqual(result["outcome"], "contact")
            self.assertAlmostEqual(result["step"], 0.5, delta=1e-8)
            self.assertIn("each vertex is a point", result["notes"][0])
            self.assertIn("2 points", self.succeed("step", a, b))

    def test_polygons(self):
        quad = [(0, 1, 2, 3), (4, 5, 6)]
        frames = [[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (.2, .2, z), (1.2, .2, z), (.2, 1.2, z)] for z in [1, -1]]
        for encoding in ENCODINGS:
            result, notes = self.active_set(*(ply(points, quad, encoding) for points in frames))
            self.assertGreater(result.count("\n"), 3)
            self.assertIn("triangulated 1 polygon of more than 3 corners", notes[0])


class Refused(AppTest):
    def refuse(self, data, *words):
        """At once, and without the memory that a count asks for."""
        self.must_refuse(["bad.ply", *words], "plan", self.write("bad.ply", data))

    def test_headers(self):
        whole = ply(START, FACES).decode()
        header = lambda a, b: whole.replace(a, b)
        vertex = "element vertex 6\n"
        for data, *words in [
                (header(vertex, "element vertex -1\n"), "ply:4", "'-1'"),
                (header(vertex, "element vertex 1e1\n"), "ply:4", "'1e1'"),
                (header(vertex, "element vertex 6.0\n"), "ply:4", "'6.0'"),
                (header(vertex, "element vertex 18446744073709551622\n"), "ply:4", "'18446744073709551622'"),
                (header(vertex, "element vertex 4000000000\n"), "ply:4", "4000000000", "bytes left"),
                (header("face 2", "face 1000000000"), "ply:8", "face", "1000000000", "bytes left"),
                (header(vertex, "element vertex 1000000000000\n" + vertex), "ply:5", "second element vertex"),
                (header("element face", "element face 2\nelement face"), "ply:9", "second element face"),
                (header(vertex, "element nothing 1000000000000\n" + vertex), "ply:4", "nothing", "no properties"),
                (header("double y", "double x"), "ply:6", "second property x"),
                (header(vertex, "property double x\n" + vertex), "ply:4", "before any element"),
                (header("element vertex 6", "element vertex"), "ply:4"),
                (header("double x", "x"), "ply:5"),
                (header("property double x", "property list uchar double x"), "ply:5", "x is a list"),
                (header("end_header", "mat 1\nend_header"), "ply:10", "'mat 1'"),
                (header("format ascii 1.0", "format ascii 2.0"), "ply:2", "2.0"),
                (header("format ascii 1.0", "format text 1.0"), "ply:2", "text"),
                (header("format ascii 1.0\n", ""), "format"),
                (header("end_header\n", ""), "0 0 0"),
                (header("vertex 6", "points 6"), "no element vertex"),
                (header("element face", "element tristrips"), "ply:8", "strips"),
                (header("property double z\n", ""), "ply:4", "property z", "two dimensions"),
                (header("element face 2\nproperty list uchar int vertex_indices",
                        "element edge 2\nproperty int from\nproperty int to"), "ply:8", "vertex1 and vertex2"),
                (header("element face 2\nproperty list uchar int vertex_indices",
                        "element edge 2\nproperty float vertex1\nproperty float vertex2"), "ply:9", "vertex1", "float")]:
            with self.subTest(words=words):
                self.refuse(data, *words)

    def test_rows_of_text(self):
        whole = ply(START, FACES).decode()
        rows = lambda a, b: whole.replace(a, b)
        for data, *words in [
                (rows("4 0 0\n", "4 0\n"), "ply:12", "vertex 1"),
                (rows("4 0 0\n", "4 0 0 0\n"), "ply:12", "vertex 1", "4 values, 3 expected"),
                (rows("4 0 0\n", "4 x 0\n"), "ply:12", "vertex 1", "'4 x 0'"),
                (rows("4 0 0\n", "4 1e400 0\n"), "ply:12", "vertex 1", "1e400"),
                (rows("3 3 4 5", "3 3 4"), "ply:18", "face 1", "'3'"),
                (rows("3 3 4 5", "-3 3 4 5"), "ply:18", "face 1", "'-3'"),
                (rows("3 3 4 5", "3 3 4 5 5"), "ply:18", "face 1", "5 values, 4 expected"),
                (rows("3 3 4 5", "3 3 4 6.5"), "ply:18", "face 1", "'6.5'"),
                (rows("3 3 4 5", "3 3 4 4294967297"), "ply:18", "face 1", "4294967297"),
                (rows("3 3 4 5", "3 3 4 99999999999999999999"), "ply:18", "face 1", "99999999999999999999"),
                (rows("3 3 4 5", "3 3 4 -1"), "ply:18", "face 1", "-1"),
                (rows("3 3 4 5", "4000000000 3 4 5"), "ply:18", "face 1", "4000000000"),
                (rows("3 3 4 5\n", ""), "face 1", "ends"),
                (whole + "3 0 1 2\n", "ply:19", "more than the header")]:
            with self.subTest(words=words):
                self.refuse(data, *words)

    def test_rows_of_bytes(self):
        for encoding in ["binary_little_endian", "binary_big_endian"]:
            whole = ply(START, FACES, encoding)
            start = whole.index(b"end_header\n") + 11
            for end in range(start, len(whole), 7):
                self.refuse(whole[:end], "vertex" if end < start + 144 else "face")
            self.refuse(whole + b"\x03", "1 bytes more")
            for count in [1_000_000_000, 2**32 - 1, 2**31]:
                lists = typed_ply(encoding, [("vertex", XYZ, START), ("face", ["list uint int vertex_indices"], [((0, 1, 2),)])])
                packed = struct.pack(ENCODINGS[encoding] + "I", count)
                self.refuse(lists[:-16] + packed + lists[-12:], "face 0", str(count), "bytes left")
                extra = typed_ply(encoding, [("vertex", XYZ + ["list uint double extra"], [(0, 0, 0, ())])])
                self.refuse(extra[:-4] + packed, "vertex 0", "extra", str(count))
            negative = typed_ply(encoding, [("vertex", XYZ, START), ("face", ["list char int vertex_indices"], [((0, 1, 2),)])])
            self.refuse(negative[:-13] + b"\xff" + negative[-12:], "face 0", "-1")

    def test_two_files_of_different_elements(self):
        face, wire = ("face", CORNERS, [((0, 1, 2),)]), lambda *rows: ("edge", ["int vertex1", "int vertex2"], rows)
        write = lambda name, *elements: self.write(name, typed_ply("ascii", [("vertex", XYZ, START), *elements]))
        a = write("a.ply", face, wire((3, 4)))
        self.must_fail(BAD, ["different topology", "1 against 0 wires"], "step", a, write("b.ply", face))
        self.must_fail(BAD, ["different topology", "wire 0", "(3 4)", "(3 5)"], "step", a, write("b.ply", face, wire((3, 5))))
        points = write("p.ply", face, ("face2", CORNERS, []))
        one = self.write("one.obj", obj(START, [FACES[0]]) + "p 4\n")
        self.must_fail(BAD, ["different topology", "0 against 1 points"], "step", points, one)


if __name__ == "__main__":
    unittest.main()
