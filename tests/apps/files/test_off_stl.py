"""OFF and STL, text and binary; and formats that are not read, with what reads them."""

import struct
import unittest

from support import END, FACES, START, AppTest, as_float, obj, off

BAD = 1


def binary_off(points, faces, prefix=b"", more=()):
    body = b"".join(struct.pack(f">{3 + len(more)}f", *p, *more) for p in points)
    body += b"".join(struct.pack(f">{len(f) + 2}i", len(f), *f, 0) for f in faces)
    return prefix + b"OFF BINARY\n" + struct.pack(">3i", len(points), len(faces), 0) + body


def text_stl(points, faces, name="thing"):
    rows = ["facet normal 0 0 0\nouter loop\n" + "".join("vertex %r %r %r\n" % tuple(points[v]) for v in f) +
            "endloop\nendfacet\n" for f in faces]
    return f"solid {name}\n" + "".join(rows) + f"endsolid {name}\n"


def binary_stl(points, faces, header=b"solid binary"):
    rows = [struct.pack("<12fH", 0, 0, 0, *(x for v in f for x in points[v]), 0) for f in faces]
    return header.ljust(80, b" ") + struct.pack("<I", len(faces)) + b"".join(rows)


class Frames(AppTest):
    def active_set(self, extension, start, end):
        frames = [self.write(f"{name}.{extension}", data) for name, data in [("a", start), ("b", end)]]
        notes = self.json("active-set", *frames, "--csv", "rows.csv").get("notes", [])
        return (self.folder / "rows.csv").read_text(), notes

    def plain(self, faces=FACES, start=START, end=END):
        return self.active_set("obj", obj(start, faces), obj(end, faces))[0]

    def refuse(self, name, data, *words):
        self.must_fail(BAD, [name, *words], "plan", self.write(name, data))


class Off(Frames):
    def same(self, make):
        self.assertEqual(self.active_set("off", make(START), make(END)), (self.plain(), []))

    def test_text(self):
        self.same(lambda p: off(p, FACES).replace("\n", "\r\n"))
        self.same(lambda p: "# one\n" + off(p, FACES).replace("\n", " # more\n").replace(" ", "\t"))
        self.same(lambda p: off(p, FACES).replace("OFF\n", "OFF"))
        self.same(lambda p: off(p, FACES).replace("OFF\n6 2 0", "OFF 6 2"))
        self.same(lambda p: off(p, FACES).replace("3 3 4 5", "3 3 4 5 255 0 0 1"))
        self.same(lambda p: "COFF\n6 2 0\n" + "".join("%r %r %r 255 0 0 255\n" % tuple(q) for q in p) + "3 0 1 2\n3 3 4 5\n")
        self.same(lambda p: "STCNOFF\n6 2 0\n" + "".join("%r %r %r 0 0 1 1 1 1 1 0 0\n" % tuple(q) for q in p) +
                  "3 0 1 2\n3 3 4 5\n")

    def test_binary(self):
        self.same(lambda p: binary_off(p, FACES))
        self.same(lambda p: binary_off(p, FACES, b"C", (1, 0, 0, 1)))
        self.same(lambda p: binary_off(p, FACES, b"N", (0, 0, 1)))
        floats = [[tuple(as_float(x + 0.1) for x in q) for q in p] for p in [START, END]]
        self.assertEqual(self.active_set("off", *(binary_off(p, FACES) for p in floats))[0],
                         self.plain(FACES, *floats))

    def test_polygons_and_wires(self):
        faces = [(0, 1, 2), (3, 4)]
        for write in [off, binary_off]:
            both = write(START, faces), write(END, faces)
            self.assertEqual(self.active_set("off", *both)[0],
                             self.active_set("obj", *(obj(p, faces[:1]) + "l 4 5\n" for p in [START, END]))[0])
            notes = self.active_set("off", *(write(p, [(0, 1, 2), (3, 4, 5, 0)]) for p in [START, START]))[1]
            self.assertIn("triangulated 1 polygon", notes[0])

    def test_refused(self):
        whole = off(START, FACES)
        for data, *words in [
                (whole.replace("OFF", "FOO"), "off:1", "not an OFF file"),
                (whole.replace("OFF", "4OFF"), "off:1", "4OFF"),
                (whole.replace("6 2 0", "6"), "off:2", "'6'"),
                (whole.replace("6 2 0", "6 -2 0"), "off:2", "'-2'"),
                (whole.replace("6 2 0", "4000000000 2 0"), "off:2", "4000000000 vertices", "bytes left"),
                (whole.replace("6 2 0", "6 4000000000 0"), "off:2", "4000000000 faces", "bytes left"),
                (whole.replace("6 2 0", "99999999999999999999 2 0"), "off:2", "99999999999999999999"),
                (whole.replace("6 2 0", "7 2 0"), "face 1", "ends"),
                (whole.replace("6 2 0", "6 3 0"), "face 2", "ends"),
                (whole.replace("6 2 0", "6 1 0"), "off:10", "more"),
                (whole.replace("4 0 0", "4 0"), "off:4", "vertex 1", "two dimensions"),
                (whole.replace("4 0 0", "4 0 nan"), "off:4", "vertex 1", "finite"),
                (whole.replace("3 3 4 5", "3 3 4"), "off:10", "face 1", "3 corners"),
                (whole.replace("3 3 4 5", "3 3 4 18446744073709551615"), "off:10", "face 1", "18446744073709551615"),
                (whole.replace("3 3 4 5", "3 3 4 6"), "off:10", "face 1", "6"),
                (whole.replace("3 3 4 5", "3 3 4 5 red"), "off:10", "face 1", "red"),
                (whole.replace("3 3 4 5", "-3 3 4 5"), "off:10", "'-3'")]:
            with self.subTest(words=words):
                self.refuse("bad.off", data, *words)

    def test_refused_bytes(self):
        whole = binary_off(START, FACES)
        for end in range(8, len(whole)):
            self.refuse("bad.off", whole[:end])
        counts = lambda *values: whole[:11] + struct.pack(">3i", *values) + whole[23:]
        self.refuse("bad.off", counts(2**31 - 1, 2, 0), "2147483647 vertices")
        self.refuse("bad.off", counts(6, 2**31 - 1, 0), "2147483647 faces")
        self.refuse("bad.off", counts(-1, 2, 0), "-1 vertices")
        self.refuse("bad.off", whole + b"\0", "1 bytes more")
        self.refuse("bad.off", whole[:-20] + struct.pack(">i", 2**30) + whole[-16:], "face 1", "1073741824")
        self.refuse("bad.off", whole[:-4] + struct.pack(">i", -1), "face 1", "-1")


class Stl(Frames):
    # A sheet of four triangles around vertex 4, and a triangle that falls on it.
    FACES = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (5, 6, 7)]
    START = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (2, 2, 0), (1, 1, 1), (1.5, 1, 3), (1, 1.5, 3)]
    END = START[:5] + [(x, y, z - 2) for x, y, z in START[5:]]

    def order(self, faces):
        """Vertices as STL numbers them: at their first corner."""
        seen = list(dict.fromkeys(v for f in faces for v in f))
        return seen, [tuple(seen.index(v) for v in f) for f in faces]

    def test_corners_at_one_place_are_one_vertex(self):
        seen, faces = self.order(self.FACES)
        frames = [[p[v] for v in seen] for p in [self.START, self.END]]
        expected = self.plain(faces, *frames)
        self.assertGreater(expected.count("\n"), 1)
        for write in [text_stl, binary_stl, lambda p, f: binary_stl(p, f, b"header"),
                      lambda p, f: text_stl(p, f).upper().replace("\n", "\r\n"),
                      lambda p, f: text_stl(p, f[:2]) + text_stl(p, f[2:])]:
            result, notes = self.active_set("stl", write(self.START, self.FACES), write(self.END, self.FACES))
            self.assertEqual(result, expected)
            self.assertEqual(len(notes), 1)
            self.assertIn("merged 15 corners into 8 vertices", notes[0])

    def test_zeros_of_either_sign_are_one_place(self):
        text = text_stl(self.START, self.FACES).replace("vertex 0 0 0", "vertex -0.0 0 -0.0", 1)
        notes = self.json("plan", self.write("a.stl", text))["notes"]
        self.assertIn("merged 15 corners into 8 vertices", notes[0])

    def test_corners_that_part_are_named(self):
        rows = text_stl(self.END, self.FACES).replace("vertex 2 2 0", "vertex 2 2 1", 1)
        a, b = self.write("a.stl", text_stl(self.START, self.FACES)), self.write("b.stl", rows)
        self.must_fail(BAD, ["a.stl", "b.stl", "corner 2 of face 0", "corner 2 of face 1", ".obj"], "step", a, b)

    def test_other_number_of_faces(self):
        a, b = self.write("a.stl", text_stl(self.START, self.FACES)), self.write("b.stl", text_stl(self.END, self.FACES[:4]))
        self.must_fail(BAD, ["different topology", "8 against 5 vertices"], "step", a, b)

    def test_faces_without_area(self):
        notes = self.json("plan", self.write("a.stl", text_stl(self.START, self.FACES + [(0, 1, 1), (2, 2, 2)])))["notes"]
        self.assertIn("wires or points for 2 faces without area", notes[0])

    def test_refused(self):
        whole, binary = text_stl(self.START, self.FACES), binary_stl(self.START, self.FACES)
        for data, *words in [
                (whole.replace("vertex 2 2 0", "vertex 2 2", 1), "stl:6", "vertex 2", "'vertex 2 2'"),
                (whole.replace("vertex 2 2 0", "vertex 2 2 nan", 1), "stl:6", "vertex 2", "finite"),
                (whole.replace("vertex 2 2 0\n", "", 1), "stl:7", "face 0", "2 corners"),
                (whole.replace("vertex 2 2 0\n", "vertex 2 2 0\n" * 2, 1), "stl:9", "face 0", "4 corners"),
                (whole.replace("endfacet\n", "", 1), "stl:8", "facet within"),
                (whole[:whole.rindex("endloop")], "within a facet"),
                (whole.replace("facet normal 0 0 0\n", "", 1), "stl:3", "no facet"),
                (whole.replace("outer loop", "inner loop", 1), "stl:3", "inner loop"),
                ("solid nothing\nendsolid nothing\n", "no vertices"),
                (binary[:-1], "cut off", "5 faces"),
                (binary[:80] + struct.pack("<I", 2**32 - 1) + binary[84:], "4294967295"),
                (binary + b"\0", "5 faces"),
                (binary[:84], "cut off", "5 faces"),
                (binary[:40], "stl")]:
            with self.subTest(words=words):
                if isinstance(data, bytes):
                    data = b"x" + data[1:]  # else "solid" makes it a text
                self.refuse("bad.stl", data, *words)


class Others(Frames):
    def test_are_named_with_what_converts_them(self):
        for extension in ["msh", "vtk", "vtu"]:
            self.refuse("bad." + extension, "x", "meshio convert", f"bad.{extension}", "bad.ply")
        self.refuse("bad.glb", "x", ".glb", ".obj or .ply")
        self.refuse("bad.STEP", "x", "gmsh -2", "bad.stl")
        self.refuse("bad.xyz", "x", "unknown extension .xyz", ".obj, .ply, .off or .stl")


if __name__ == "__main__":
    unittest.main()
