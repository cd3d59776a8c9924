"""Bad input ends at once: one line on stderr that names the cause, nothing on stdout, status 1 (or 2 for usage)."""

import math
import unittest

from support import END, FACES, START, AppTest, obj, off, ply

BAD, USAGE = 1, 2


class Meshes(AppTest):
    def refuse(self, name, content, *words):
        """The mesh is refused in either place and by each subcommand."""
        good, bad = self.write("good.obj", obj(START, FACES)), self.write(name, content)
        for command in ["step", "active-set", "candidates"]:
            self.must_fail(BAD, [name, *words], command, bad, good)
            self.must_fail(BAD, [name, *words], command, good, bad)

    def test_missing_file(self):
        good = self.write("good.obj", obj(START, FACES))
        self.must_fail(BAD, ["gone.ply", "No such file"], "step", "gone.ply", good)
        self.must_fail(BAD, ["gone.ply", "No such file"], "step", good, "gone.ply")

    def test_folder_and_unknown_formats(self):
        (self.folder / "folder.ply").mkdir()
        good = self.write("good.obj", obj(START, FACES))
        self.must_fail(BAD, ["folder.ply", "directory"], "step", "folder.ply", good)
        self.refuse("mesh.xyz", obj(START, FACES), "extension")
        self.refuse("mesh", obj(START, FACES), "extension")

    def test_not_what_the_extension_says(self):
        self.refuse("text.ply", "hello\n", "not a PLY file")
        for extension in ["ply", "obj", "off", "stl"]:
            self.refuse("empty." + extension, "", "empty")
            self.refuse("blank." + extension, "\n \n\t\n")
            self.refuse("noise." + extension, "\x00\x01\x02 noise")
        self.refuse("other.obj", "l 1 2\n", "other.obj:1", "wire 0", "no vertices")

    def test_cut_off_files(self):
        for encoding in ["binary_little_endian", "binary_big_endian", "ascii"]:
            whole = ply(START, FACES, encoding)
            body = whole.index(b"end_header\n") + 11
            self.refuse("header.ply", whole[:body - 20])
            self.refuse("vertex.ply", whole[:body + 30], "vertex")
            self.refuse("face.ply", whole[:-5], "face")
        self.refuse("vertex.off", off(START, FACES)[:30])
        self.refuse("face.off", off(START, FACES)[:-4])

    def test_ply_headers_that_would_be_misread(self):
        whole = ply(START, FACES).decode()
        self.refuse("wide.ply", whole.replace("property double z", "property double z\nproperty int64 id"), "int64")
        self.refuse("no_z.ply", whole.replace("property double z", "property double w"), "property z")
        self.refuse("list.ply", whole.replace("uchar int", "uchar float"), "list.ply:9", "vertex_indices", "float")
        self.refuse("count.ply", whole.replace("uchar int", "float int"), "count.ply:9", "vertex_indices", "float")
        self.refuse("no_list.ply", whole.replace("vertex_indices", "corners"), "vertex_indices")

    def test_positions_that_are_not_finite(self):
        for value in [math.nan, math.inf, -math.inf]:
            points = list(START)
            points[4] = (0, value, 0)
            for real in ["float", "double"]:
                for encoding in ["binary_little_endian", "binary_big_endian", "ascii"]:
                    self.refuse("bad.ply", ply(points, FACES, encoding, real), "vertex 4")
            self.refuse("bad.obj", obj(points, FACES), "vertex 4")
            self.refuse("bad.off", off(points, FACES), "vertex 4")

    def test_index_out_of_range(self):
        for index in [6, -1, 2**31 - 1]:
            faces = [FACES[0], (3, 4, index)]
            for encoding in ["binary_little_endian", "ascii"]:
                self.refuse("bad.ply", ply(START, faces, encoding), "face 1", str(index), "6")
            self.refuse("bad.off", off(START, faces), "face 1", "6")
        self.refuse("bad.obj", obj(START, [FACES[0], (3, 4, 6)]), "face 1", "6")

    def test_repeated_vertex(self):
        faces = [FACES[0], (3, 5, 3)]
        for name, write in [("bad.ply", ply), ("bad.obj", obj), ("bad.off", off)]:
            self.refuse(name, write(START, faces), "face", "1", "vertex 3", "repeated")

    def test_faces_that_have_no_vertices(self):
        for name, write in [("bad.ply", ply), ("bad.obj", obj), ("bad.off", off)]:
            self.refuse(name, write(START, [FACES[0], ()]), "face 1", "no vertices")

    def test_different_topology(self):
        good = self.write("good.obj", obj(START, FACES))
        other = self.write("other.obj", obj(END, [(0, 1, 2), (3, 5, 4)]))
        self.must_fail(BAD, ["different topology", "face 1", "(3 4 5)", "(3 5 4)"], "step", good, other)
        more = self.write("more.obj", obj(END + [(9, 9, 9)], FACES))
        self.must_fail(BAD, ["different topology", "6", "7", "vertices"], "active-set", good, more)
        fewer = self.write("fewer.ply", ply(END, FACES[:1]))
        self.must_fail(BAD, ["different topology", "2", "1", "faces"], "candidates", good, fewer)


class Options(AppTest):
    def test_out_of_range(self):
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        query = self.write("vf.csv", "0,1,0,1,0,1,0\n" * 8)
        for command in [("step", a, b), ("active-set", a, b), ("candidates", a, b), ("queries", query), ("demo",)]:
            for name in ["--tolerance", "--relative-tolerance", "--min-separation"]:
                for value in ["-1", "nan", "inf", "-1e-300", "x", "1e-6x", ""]:
                    self.must_fail(USAGE, [name, f"'{value}'"], *command, name, value)
            for name in ["--tolerance", "--relative-tolerance", "--max-checks"]:
                self.must_fail(USAGE, [name, "'0'"], *command, name, "0")
            for name, value in [("--max-checks", "-5"), ("--max-checks", "1.5"), ("--threads", "-1"),
                                ("--threads", "nan"), ("--threads", "1000000000")]:
                self.must_fail(USAGE, [name, value], *command, name, value)
            for name in ["--norm", "--broad-phase", "--narrow-phase", "--kernel"]:
                self.must_fail(USAGE, [name, "sideways"], *command, name, "sideways")

    def test_of_single_commands(self):
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        for value in ["nan", "inf", "-1", "1e400", "1x", "", "x"]:
            for option in ["--seconds", "--target-time-us", "--target-earliness"]:
                self.must_fail(USAGE, [option, "finite number >= 0", f"'{value}'"], "trade", a, b, option, value)
            for option in ["--time-limit", "--window"]:
                self.must_fail(USAGE, [option, "finite number >= 0", f"'{value}'"], "active-set", a, b, option, value)
        for value in ["nan", "-1", "1.5", "1x", "", "0x1", "1e0", " 1", "99999999999999999999"]:
            for command, option in [(("trade", a, b), "--repeats"), (("trade", a, b), "--target-positives"),
                                    (("trade", a, b), "--target-budget"), (("bench", a, b), "--repeats"),
                                    (("bench", a, b), "--refine"), (("bench",), "--cloth"), (("step", a, b), "--static-body"),
                                    (("step", a, b), "--rigid-body"), (("step", a, b), "--check-limit"),
                                    (("step", a, b), "--memory-limit")]:
                self.must_fail(USAGE, [option, "whole number", f"'{value}'"], *command, option, value)
        for arguments in [("step", "", b), ("step", a, ""), ("check", ""), ("queries", ""), ("replay", ""), ("demo", "--output", ""),
                          ("trade", a, b, "--truth", ""), ("filters", a, "--json", ""), ("bench", "", b)]:
            self.must_fail(USAGE, ["a path expected"], *arguments)

    def test_that_the_library_refuses(self):
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        self.must_fail(BAD, ["min_separation"], "step", a, b, "--min-separation", "1e308")

    def test_the_time_limit_is_one_of_the_look_at_the_start_too(self):
        crossing = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, -1), (1, 1, 1), (1, 2, 1)]
        a = self.write("a.obj", obj(crossing, FACES))
        self.assertIn("intersects or touches itself", self.json("step", a, a, "--time-limit", "100")["notes"][0])
        self.assertIn("not found out within the time limit", self.json("step", a, a, "--time-limit", "0")["notes"][0])

    def test_that_do_not_go_together(self):
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        self.must_fail(USAGE, ["--tolerance", "--relative-tolerance"], "step", a, b, "--tolerance", "1",
                  "--relative-tolerance", "1")
        self.must_fail(USAGE, ["--json", "--csv"], "step", a, b, "--json", "-", "--csv", "-")

    def test_usage(self):
        self.must_fail(USAGE, ["subcommand"])
        self.must_fail(USAGE, ["wander"], "wander")
        self.must_fail(USAGE, ["B"], "step", "a.obj")
        self.must_fail(USAGE, ["FILE"], "queries")
        self.must_fail(USAGE, ["--sideways"], "demo", "--sideways")
        self.must_fail(USAGE, ["--kind"], "queries", "x.csv", "--kind", "fv")


class Outputs(AppTest):
    def test_that_cannot_be_written(self):
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        query = self.write("vf.csv", "0,1,0,1,0,1,0\n" * 8)
        for command in [("step", a, b), ("active-set", a, b), ("candidates", a, b), ("queries", query), ("demo",)]:
            for option in ["--json", "--csv"]:
                self.must_fail(BAD, ["gone/out", "No such file"], *command, option, "gone/out")
                self.must_fail(BAD, ["/dev/full", "No space left"], *command, option, "/dev/full")

    def test_are_not_touched_by_bad_input(self):
        good = self.write("good.obj", obj(START, FACES))
        kept = self.write("kept.json", "kept")
        self.must_fail(BAD, ["gone.obj"], "step", good, "gone.obj", "--json", kept)
        self.assertEqual(kept.read_text(), "kept")


class Queries(AppTest):
    ROWS = ["0,1,0,1,0,1,0"] * 8

    def refuse(self, row, text, *words):
        """A file of two queries whose line `row` (from 1) is `text`."""
        rows = self.ROWS * 2
        rows[row - 1] = text
        self.write("vf.csv", "\n".join(rows) + "\n")
        self.must_fail(BAD, [f"vf.csv:{row}:", *words], "queries", "vf.csv")

    def test_malformed_rows(self):
        self.refuse(3, "0,1,0,1,0,1", "6 fields")
        self.refuse(16, "0,1,0,1,0,1,0,0", "8 fields")
        self.refuse(1, "", "fields")
        self.refuse(5, "0,1,0,1,0,1,2", "truth '2'")
        self.refuse(6, "0,1,0,1,0,1,1", "truth")
        for number in ["x", "", "1.5", "0x10", "1e3", "--1", "-", "nan", "1 2"]:
            self.refuse(9, f"0,1,{number},1,0,1,0", f"'{number}' is not an integer")
            self.refuse(9, f"0,1,1,{number},0,1,0", f"'{number}' is not an integer")

    def test_quotients_that_are_no_doubles(self):
        self.refuse(2, "1,0,0,1,0,1,0", "zero denominator")
        self.refuse(2, "0,0,0,1,0,1,0", "zero denominator")
        self.refuse(2, "1,-000,0,1,0,1,0", "zero denominator")
        for n, d in [(1, 3), (2**53 + 1, 1), (1, 2**1075), (3, 2**1075), (2**1024, 1), (10**400, 1), (10**300 + 1, 10**300)]:
            self.refuse(4, f"0,1,0,1,{n},{d},0", "not exactly a double")

    def test_row_counts(self):
        self.write("vf.csv", "\n".join(self.ROWS + self.ROWS[:5]) + "\n")
        self.must_fail(BAD, ["vf.csv", "13 rows", "multiple of 8"], "queries", "vf.csv")
        self.write("vf.csv", "")
        self.must_fail(BAD, ["vf.csv", "no queries"], "queries", "vf.csv")

    def test_files_and_kinds(self):
        self.write("a-vf.csv", "\n".join(self.ROWS) + "\n")
        self.must_fail(BAD, ["gone-vf.csv", "No such file"], "queries", "a-vf.csv", "gone-vf.csv")
        self.write("what.csv", "\n".join(self.ROWS) + "\n")
        self.must_fail(BAD, ["what.csv", "--kind"], "queries", "a-vf.csv", "what.csv")
        self.write("vf-and-ee.csv", "\n".join(self.ROWS) + "\n")
        self.must_fail(BAD, ["vf-and-ee.csv", "--kind"], "queries", "vf-and-ee.csv")


if __name__ == "__main__":
    unittest.main()
