"""Files that are made to hurt: each ends in one line that names the file and the place, within a second and 64 MiB."""

import json
import math
import os
import socket
import struct
import unittest

from support import FACES, START, END, AppTest, obj, off, ply
from test_queries import rows, vertex_face


class Meshes(AppTest):
    def refuse(self, name, data, *words):
        self.must_refuse([name, *words], "filters", self.write(name, data))

    def test_headers_as_long_as_files(self):
        head = "ply\nformat ascii 1.0\n"
        many = lambda line: "".join(line % i for i in range(60000))
        self.refuse("bad.ply", head + many("element e%05d 0\n") + "end_header\n", "no element vertex")
        self.refuse("bad.ply", head + "element vertex 0\n" + many("property char p%05d\n") + "end_header\n", "property x")
        self.refuse("bad.ply", head + "element " + "e" * 10**6 + " x\nend_header\n", "ply:3", "element eee")
        self.refuse("bad.ply", head + "x" * 10**6, "ply:3", "unknown line")

    def test_counts_that_the_bytes_cannot_hold(self):
        """The counts of every format, larger than the file, than 32 bits, than 63 bits, negative, and no numbers."""
        text = {"ply": (ply(START, FACES).decode(), ["element vertex 6", "element face 2"]),
                "off": (off(START, FACES), ["6 2 0"])}
        for count in ["-1", "1000000", "4294967302", "9223372036854775807", "9223372036854775808",
                      "18446744073709551622", "99999999999999999999", "6e0", "0x6", "6.0", "nan", "+-6"]:
            for extension, (whole, places) in text.items():
                for place in places:
                    bad = whole.replace(place, place.replace("6", count, 1) if "6" in place else place[:-1] + count)
                    self.refuse("bad." + extension, bad, count)
            face = off(START, FACES).replace("3 3 4 5", count + " 3 4 5")
            self.refuse("bad.off", face, "off:10", count)
            self.refuse("bad.ply", text["ply"][0].replace("3 3 4 5", count + " 3 4 5"), "ply:18", "face 1", count)
        for count in [2**31 - 1, 2**31, 2**32 - 1]:
            whole = struct.pack("<I", count).join([b"x" * 80, b"\0" * 100])
            self.refuse("bad.stl", whole, str(count))

    def test_indices_that_would_wrap(self):
        for index in [-1, 6, 2**31, 2**32, 2**32 + 1, 2**63 - 1, 2**63, 2**64 - 1, 2**64, 10**30]:
            self.refuse("bad.off", off(START, FACES).replace("3 3 4 5", f"3 3 4 {index}"), "off:10", "face 1", str(index))
            self.refuse("bad.ply", ply(START, FACES).decode().replace("3 3 4 5", f"3 3 4 {index}"), "ply:18", str(index))
            if index != -1:  # in OBJ, the last one
                for keyword, what in [("f 4 5 ", "face"), ("l 4 ", "wire"), ("p ", "point")]:
                    self.refuse("bad.obj", obj(START, [FACES[0]]) + f"{keyword}{index + 1}\n", "obj:8", what, str(index + 1))
        for index in [-7, -2**31, -2**63, -2**64, 0]:
            self.refuse("bad.obj", obj(START, [FACES[0]]) + f"f 4 5 {index}\n", "obj:8", "face 1", str(index))

    def test_elements_that_come_before_their_vertices(self):
        """Two bytes a row, of which each is out of range until the vertices are read."""
        vertices = "element vertex 1\nproperty char x\nproperty char y\nproperty char z\n"
        faces = "element face 500000\nproperty list uchar uchar vertex_indices\n"
        head = "ply\nformat binary_little_endian 1.0\n" + faces + vertices + "end_header\n"
        body = b"\1\0" * 499999 + b"\1\7" + b"\0\0\0"
        self.refuse("bad.ply", head.encode() + body, "face 499999", "7")

    def test_bytes_that_are_no_text(self):
        for name, whole in [("bad.obj", obj(START, FACES)), ("bad.off", off(START, FACES)), ("bad.ply", ply(START, FACES).decode())]:
            lines = whole.count("\n")
            self.refuse(name, whole + "\0" * 10**6, f"{name}:{lines + 1}: a byte 0")
            self.refuse(name, whole.replace("\n", "\r\n\r\n").replace("4", "4\0", 1), "a byte 0")
            sparse = self.write(name, whole)
            os.truncate(sparse, 1 << 40)  # no larger on the disk
            self.must_refuse([name, "a byte 0"], "filters", sparse)
        os.truncate(self.write("bad.stl", b"x" * 84), 1 << 40)
        self.must_refuse(["bad.stl", "not an STL file"], "filters", "bad.stl")
        os.truncate(self.write("bad.off", b"OFF BINARY\n" + struct.pack(">3i", 1, 1, 0)), 1 << 40)
        self.must_refuse(["bad.off", "not enough memory for its 1099511627776 bytes"], "filters", "bad.off")

    def test_long_lines(self):
        million = "1" * 10**6
        for data, *words in [(f"v {million} 0 0\n", "obj:1", "vertex 0"), (f"v 0 0 0.{million}x\n", "obj:1", "vertex 0"),
                             ("v " + "0 " * 500000 + "\n", "obj:1", "500000 numbers"),
                             ("v 0 0 0\nf " + "1 " * 500000 + "\n", "obj:2", "repeated"),
                             ("v 0 0 0\nf " + "2 " * 500000 + "\n", "obj:2", "repeated"),
                             ("v \\\n" * 200000, "obj:1", "vertex 0"), ("f " + "/" * 10**6 + "\n", "obj:1", "face 0"),
                             (million + "\n", "obj:1", "keyword")]:
            self.refuse("bad.obj", data, *words)

    def test_polygons_that_take_long_to_cut(self):
        n = 40000
        for radius in [lambda i: 1, lambda i: 1 if i % 2 else 0.5]:
            circle = [(radius(i) * math.cos(2 * math.pi * i / n), radius(i) * math.sin(2 * math.pi * i / n), 0) for i in range(n)]
            self.refuse("bad.off", off([tuple(round(x, 6) for x in p) for p in circle], [range(n)]), "face 0", "40000 corners")

    def test_what_is_no_file(self):
        os.mkfifo(self.folder / "pipe.obj")
        (self.folder / "device.obj").symlink_to("/dev/zero")
        (self.folder / "folder.obj").mkdir()
        (self.folder / "loop.obj").symlink_to("loop.obj")
        with socket.socket(socket.AF_UNIX) as listening:
            listening.bind(str(self.folder / "socket.obj"))
            for name, word in [("pipe", "pipe"), ("device", "device"), ("folder", "directory"), ("loop", "symbolic links"),
                               ("socket", "socket.obj")]:
                self.must_refuse([name + ".obj", word], "filters", name + ".obj")
                self.must_refuse([name + ".obj", word], "queries", "--kind", "vf", name + ".obj")
                self.must_refuse([name + ".obj", word], "replay", "--kind", "vf", name + ".obj")
                good = self.write("good.obj", obj(START, FACES))
                self.must_refuse([name + ".obj", word], "step", good, name + ".obj")
                self.must_refuse([name + ".obj", word], "trade", good, good, "--truth", name + ".obj")
                self.must_refuse([name + ".obj", word], "trade", good, good, "--truth", f"{name}.obj,{name}.obj")


class Queries(AppTest):
    GOOD = rows(vertex_face(1, -1), 1)

    def refuse(self, data, *words):
        self.must_refuse(["vf.csv", *words], "queries", self.write("vf.csv", data))

    def test_long_numbers(self):
        """What is more than the digits that a double and its common factors need is refused; so many are read."""
        digits = lambda n: "1" + "0" * (n - 1)
        self.succeed("queries", self.write("vf.csv", f"{digits(10000)},{digits(10000)},0,1,0,1,0\n" * 8))
        for n in [10001, 150000]:
            self.refuse(f"{digits(n)},{digits(n)},0,1,0,1,0\n" * 8, "csv:1", f"{n} digits")
            self.refuse(f"0,1,0,-{digits(n)},0,1,0\n" * 8, "csv:1", f"{n} digits")
        threes = "3" * 9999
        self.refuse(f"{threes}1,{threes}7,{threes}1,{threes}7,{threes}1,{threes}7,0\n" * 16, "csv:1", "not exactly a double")

    def test_lines(self):
        self.refuse(self.GOOD + "0," * 10**6, "csv:9", "1048576 bytes")
        self.refuse(self.GOOD + "\0" * 100, "csv:9", "byte 0")
        self.refuse("," * 10**6, "csv:1", "1000001 fields")
        self.refuse("x" * 10**6 + ",1,0,1,0,1,0", "csv:1", "not an integer")
        os.truncate(self.write("vf.csv", self.GOOD), 1 << 40)
        self.must_refuse(["vf.csv:9"], "queries", "vf.csv")


class Truth(AppTest):
    def setUp(self):
        super().setUp()
        self.frames = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))

    def refuse(self, *words):
        self.must_refuse(words, "trade", *self.frames, "--truth", "p.json,c.json")

    def test_lists(self):
        """Of pairs and flags: whatever is no list of them, deep, long, wide, or no whole number."""
        self.write("c.json", "[true]")
        pair = lambda a: f"[[{a}, 12]]"
        for data, word in [("[" * 10**6, "a list"), ("[[" * 500000, "a list"), ("[[1,2],3]", "3 behind 1 entry"), ("{" * 10**6, "object"),
                           ('{"a":1}', "object"), ("[[1,2,3]]", "3"), ("[[1]]", "a list of 1 number"), ("[[]]", "a list of 0"),
                           (pair("1.5"), "1.5"), (pair("1e300"), "1e300"), (pair("18446744073709551615"), "18446744073709551615"),
                           (pair("99999999999999999999"), "99999999999999999999"), (pair("-1"), "entry 0"), (pair("null"), "null"),
                           (pair('"' + "x" * 10**6 + '"'), "the text"), (pair("true"), "truth value"), ("", "p.json"), ("[[1, 12]", "p.json"),
                           ("[[1, 12]] x", "p.json"), ("\0", "byte 0"), ("[[5, 7]]", "entry 0"), ("nan", "p.json")]:
            with self.subTest(data=data[:30]):
                self.write("p.json", data)
                self.refuse("p.json", word)
        self.write("p.json", pair(3))
        for data in ["[1]", "[[true]]", "[" * 10**6, "[true, false]", "[null]", '["true"]', "{}", "[true"]:
            self.write("c.json", data)
            self.refuse("c.json")

    def test_rows(self):
        head = "kind,a,b,toi_lo,toi_hi\n"
        for data, *words in [("", "empty"), ("vf,3,0,0.5,0.5\n", "t.csv:1", "kind,a,b"), (head + "vf,3.5,0,,\n", "t.csv:2", "'3.5'"),
                             (head + "vf,-1,0,,\n", "t.csv:2", "'-1'"), (head + "vf,4294967299,0,,\n", "t.csv:2", "4294967299"),
                             (head + "vf,nan,0,,\n", "t.csv:2", "'nan'"), (head + "vf,3,0,nan,1\n", "t.csv:2", "'nan'"),
                             (head + "vf,3,0,0.5,0.25\n", "t.csv:2", "'0.5'"), (head + "vf,3,0,0.5x,1\n", "t.csv:2", "'0.5x'"),
                             (head + "vf,3,0,0.5,1,1\n", "t.csv:2"), (head + "xy,3,0\n", "t.csv:2"), (head + "\0", "t.csv:2", "byte 0"),
                             (head + "vf" * 10**6, "t.csv:2", "bytes")]:
            with self.subTest(words=words):
                self.must_refuse(["t.csv", *words], "trade", *self.frames, "--truth", self.write("t.csv", data))

    def test_times_beside_queries(self):
        path = self.write("vf.csv", rows(vertex_face(1, -1), 1) + rows(vertex_face(1, 0.5), 0))
        for data, *words in [("", "0 rows"), ("0.5,0.5\n", "1 rows"), ("0.5,0.5\nnan,nan\n", "toi.csv:2"), ("0.5,0.25\n", "toi.csv:1"),
                             ("0.5\n", "toi.csv:1", "lo,hi"), ("inf,inf\n", "toi.csv:1", "contradicts"),
                             ("0.5,0.5\n0.5,0.5\n", "toi.csv:2", "contradicts"), ("0" * 2 * 10**6, "toi.csv:1", "bytes")]:
            with self.subTest(words=words):
                self.write("toi.csv", data)
                self.must_refuse(["toi.csv", *words], "trade", "--queries", path)


class Expectations(AppTest):
    def test_of_a_dump(self):
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        self.succeed("step", a, b, "--dump", "d")
        whole = (self.folder / "d-vf.json").read_text()
        good = json.loads(whole)

        def changed(part, key, value):
            data = json.loads(whole)
            (data["options"] if part == "options" else data["queries"][0])[key] = value
            return json.dumps(data)

        for data, *words in [("", "d-vf.json"), ("{}", "options"), ("[]", "d-vf.json"), ("[" * 10**6, "levels"), ('{"a":' * 10**6, "levels"),
                             (json.dumps({"options": good["options"], "queries": 7}), "d-vf.json"),
                             (json.dumps({"options": good["options"], "queries": []}), "answers beside it to 0"),
                             (changed("options", "tolerance", -1), "tolerance"), (changed("options", "tolerance", "x"), "d-vf.json"),
                             (changed("options", "max_checks", 1e300), "1e+300"), (changed("options", "max_checks", 2**64 - 1), "18446744073709551615"),
                             (changed("options", "max_checks", 0), "max_checks"), (changed("options", "norm", "manhattan"), "manhattan"),
                             (changed("options", "certainty", "sure"), "sure"), (changed("options", "narrow_phase", 3), "3"),
                             (changed("options", "min_separation", -1), "min_separation"), (changed("queries", "toi", "soon"), "d-vf.json"),
                             (changed("queries", "checks", 1.5), "1.5"), (changed("queries", "outcome", None), "d-vf.json"),
                             (whole[:-20], "d-vf.json"), (whole + "\0", "byte 0")]:
            with self.subTest(words=words):
                self.write("d-vf.json", data)
                self.must_refuse(["d-vf.", *words], "replay", "d-vf.csv")


if __name__ == "__main__":
    unittest.main()
