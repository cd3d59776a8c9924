"""OBJ as people write it: read, with what was done to it said; and what is not read named with its line."""

import unittest

from support import END, FACES, START, AppTest, obj

BAD = 1


class Obj(AppTest):
    def setUp(self):
        super().setUp()
        self.plain = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        self.expected = self.csv("active-set", *self.plain)

    def same(self, change):
        """Both frames, changed so, give what they gave before; returns what is noted about that."""
        changed = [self.write("changed_" + path.name, change(path.read_text())) for path in self.plain]
        result = self.json("active-set", *changed, "--csv", "rows.csv")
        self.assertEqual((self.folder / "rows.csv").read_text(), self.expected)
        return result.get("notes", [])

    def test_ways_to_write_lines(self):
        as_lines = lambda ending: lambda text: text.replace("\n", ending)
        for change in [as_lines("\r\n"), as_lines("\r"), as_lines(" \t\n"), as_lines(" # a comment\n"), as_lines("\n\n"),
                       lambda text: text.replace(" ", "\t"), lambda text: "  " + text.replace("\n", "\n \t"),
                       lambda text: "\ufeff" + text, lambda text: "# first\n" + text, lambda text: text.rstrip("\n"),
                       lambda text: text.replace("v 4 0 0", "v +4 0.0 0e5"), lambda text: text.replace("1.5", "15e-1")]:
            self.assertEqual(self.same(change), [])

    def test_a_vertex_that_has_lost_a_number(self):
        for lost in ("v 4 0 0", "v 0 0 0"):
            bad = self.write("lost.obj", self.plain[0].read_text().replace(lost, lost[:-2], 1))
            done = self.run_app("check", bad)
            self.assertEqual(done.returncode, BAD)
            self.assertIn("numbers", done.stderr)
            self.assertIn("expected", done.stderr)

    def test_continued_lines(self):
        self.assertEqual(self.same(lambda text: text.replace("f 4 5 6", "f 4 \\\n5\\\n  6")), [])
        self.assertEqual(self.same(lambda text: text.replace("f 4 5 6", "f 4 \\\r\n5 6").replace("v 4", "v \\\n4")), [])
        # A comment or a name that ends so does not take the next line with it.
        self.assertEqual(self.same(lambda text: "# C:\\\n" + text.replace("f 1", "usemtl C:\\\nf 1")), [])

    def test_corners_with_texture_and_normal(self):
        for form in ["{0}/{0}", "{0}//{0}", "{0}/{0}/{0}", "{0}/", "{0}//"]:
            corners = " ".join(form.format(i) for i in [4, 5, 6])
            self.same(lambda text: text.replace("f 4 5 6", "f " + corners))
        self.assertEqual(self.same(lambda text: text.replace("f 4 5 6", "f -3 -2 -1")), [])
        self.assertEqual(self.same(lambda text: text.replace("f 4 5 6", "f -3//1 5/2 -1/-1/3")), [])
        self.assertEqual(self.same(lambda text: text.replace("f 4 5 6", "fo 4 5 6")), [])

    def test_faces_before_their_vertices(self):
        lines = lambda text: text.splitlines(keepends=True)
        self.assertEqual(self.same(lambda text: "".join(lines(text)[6:] + lines(text)[:6])), [])
        relative = lambda text: "".join(lines(text)[:3] + ["f -3 -2 -1\n"] + lines(text)[3:6] + ["f -3 -2 -1\n"])
        self.assertEqual(self.same(relative), [])

    def test_colours_and_weights_of_vertices(self):
        for more in [" 1", " 0.5 0.5 0.5", " 0.5 0.5 0.5 1"]:
            self.assertEqual(self.same(lambda text: text.replace("\nf", more + "\nf", 1)), [])

    def test_other_keywords_are_skipped(self):
        looks = "mtllib a.mtl\no thing\ng a b\ns off\nusemtl red\nvn 0 0 1\nvt 0 0\nvp 0 0\n"
        self.assertEqual(self.same(lambda text: looks + text), [])
        notes = self.same(lambda text: "ms 0 0 0\nny 0 0 0\n" + text + "nl 0\ne 1 2\npe 0\ne 2 3\n")
        self.assertEqual(len(notes), 1)
        for words in ["6 lines", "'ms'", "'ny'", "'nl'", "'e'", "'pe'"]:
            self.assertIn(words, notes[0])

    def test_numbers_keep_all_bits(self):
        digits = "0.1000000000000000055511151231257827021181583404541015625"  # the double 0.1 in full
        steps = set()
        for number in ["0.1", "1e-1", digits, "0.10000000000000000555111512312578270211815834045410156250001"]:
            self.same(lambda text: text)
            frames = [self.write(p.name + ".obj", p.read_text().replace("v 4 0 0", f"v 4 {number} 0")) for p in self.plain]
            steps.add(self.csv("active-set", *frames))
        self.assertEqual(len(steps), 1)

    def test_two_coordinates_have_a_third_of_0(self):
        flat = "v 0 0\nv 4 0\nv 0 4\nf 1 2 3\n"
        self.succeed("check", self.write("flat.obj", flat))
        self.assertEqual(self.json("step", self.write("two.obj", flat), self.write("three.obj", flat.replace("\nf", " 0\nf").replace("v 0 0\nv 4 0\n", "v 0 0 0\nv 4 0 0\n")))["step"], 1)


class Refused(AppTest):
    """Each with the number of its line."""

    def refuse(self, line, replaced, by, *words):
        text = obj(START, FACES).splitlines()
        text[text.index(replaced)] = by
        self.must_fail(BAD, [f"bad.obj:{line}: ", *words], "step", self.write("bad.obj", "\n".join(text)), "bad.obj")

    def test_indices(self):
        for index, words in [("0", "vertex index 0"), ("7", "vertex index 7, not in [1, 6]"), ("6.5", "'6.5'"),
                             ("-7", "vertex index -7"), ("4294967297", "4294967297"), ("4294967302", "4294967302"),
                             ("18446744073709551620", "18446744073709551620"), ("x", "'x'"), ("5/x", "'5/x'"),
                             ("5/1.5", "'5/1.5'"), ("5/1/2/3", "'5/1/2/3'"), ("/5", "'/5'"), ("5e0", "'5e0'")]:
            self.refuse(8, "f 4 5 6", f"f 4 {index} 6", "face 1", words)
            self.refuse(8, "f 4 5 6", f"l 4 {index} 6", "wire 0", words)
            self.refuse(8, "f 4 5 6", f"p {index}", "point 0", words)

    def test_relative_indices_count_from_their_line(self):
        self.must_fail(BAD, ["bad.obj:2: ", "face 0", "-2", "1 "], "plan",
                       self.write("bad.obj", "v 0 0 0\nf -1 -2 -3\nv 1 0 0\nv 0 1 0\n"))

    def test_positions(self):
        for number in ["nan", "inf", "-inf", "1e400", "-1e309", "x", "1,5", "0x10", "1.5f", "1.#QNAN", "1e", "--1"]:
            self.refuse(5, "v 1.5 1 3", f"v 1.5 {number} 3", "vertex 4", "finite", number)
        self.refuse(5, "v 1.5 1 3", "v 1.5", "vertex 4", "1 numbers")
        self.refuse(5, "v 1.5 1 3", "v 1.5 1 3 4 5", "vertex 4", "5 numbers")
        self.refuse(5, "v 1.5 1 3", "v 1.5 1 3 red", "vertex 4", "red")

    def test_elements(self):
        self.refuse(8, "f 4 5 6", "f 4 5 5", "face 1", "vertex 4", "index 5", "repeated")
        self.refuse(8, "f 4 5 6", "f 4 5 6 1 5", "face 1", "vertex 4", "repeated")
        self.refuse(8, "f 4 5 6", "l 4 4", "wire 0", "vertex 3", "repeated")
        self.refuse(8, "f 4 5 6", "l 4", "wire 0", "1 vertices")
        self.refuse(8, "f 4 5 6", "f", "face 1", "no vertices")
        self.refuse(8, "f 4 5 6", "p", "point 0", "no vertices")

    def test_what_would_be_lost(self):
        for keyword in ["curv", "curv2", "surf", "bzp", "call"]:
            self.refuse(8, "f 4 5 6", f"{keyword} 1 2 3", f"'{keyword}'", "not read")
        self.refuse(8, "f 4 5 6", "4 5 6", "'4'", "keyword")
        self.must_fail(BAD, ["bad.obj", "UTF-16"], "plan", self.write("bad.obj", obj(START, FACES).encode("utf-16")))

    def test_line_numbers_count_all_lines(self):
        text = "\ufeff# one\r\n\r\nv 0 0 0\r\nv 1 \\\r\n0 0\r\nv 0 1 0\r\nf 1 2 9\r\n"
        self.must_fail(BAD, ["bad.obj:7: ", "face 0", "9"], "plan", self.write("bad.obj", text))


if __name__ == "__main__":
    unittest.main()
