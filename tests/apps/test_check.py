"""onset check: what is in the way of a step, by ids, with what cures it; and where step and active-set point to it."""

import csv
import io
import json
import subprocess
import unittest

from support import BINARY, END, FACES, START, AppTest, obj

CLEAN, BAD, NOT_CLEAN = 0, 1, 3
BASE = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]


def needle(tip):
    """A tetrahedron with its tip, vertex 3, at height `tip` above a triangle."""
    return BASE + [(0, 0, tip), (0.2, 0, tip + 1), (-0.2, 0.2, tip + 1), (-0.2, -0.2, tip + 1)]


NEEDLE = [(0, 1, 2), (3, 4, 5), (3, 5, 6), (3, 6, 4), (4, 6, 5)]
SEAM = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
LISTS = ["intersecting", "touching", "within_separation", "copied_vertices", "faces_without_area", "unused_vertices"]


class Check(AppTest):
    def check(self, status, *arguments):
        """Its JSON, by a run that ends with `status`; the lists that are empty are no findings."""
        done = self.run_app("check", *arguments, "--json", "-")
        self.assertEqual((done.returncode, done.stderr), (status, ""))
        result = json.loads(done.stdout)
        self.assertEqual(result["clean"], status == CLEAN)
        self.assertEqual([f["fault"] for f in result["findings"]], [name for name in LISTS if result[name]])
        for finding in result["findings"]:
            self.assertEqual(finding["count"], len(result[finding["fault"]]))
            self.assertIn(str(finding["count"]), finding["text"])
        return result

    def say(self, *arguments):
        done = self.run_app("check", *arguments)
        self.assertEqual((done.returncode, done.stderr), (NOT_CLEAN, ""))
        for of_the_library in ["rules.", "Options::", "Mesh("]:
            self.assertNotIn(of_the_library, done.stdout)
        return done.stdout

    def faults(self, result):
        return {name: len(result[name]) for name in LISTS if result[name]}

    def test_a_clean_start(self):
        path = self.write("a.obj", obj(START, FACES))
        result = self.check(CLEAN, path)
        self.assertEqual((result["acceptable"], result["outcome"], self.faults(result)), (True, "free", {}))
        self.assertIn("start       clean", self.succeed("check", path))
        self.assertEqual(self.succeed("check", path, "--csv", "-").count("\n"), 1)

    def test_a_pierced_face(self):
        path = self.write("a.obj", obj(needle(-0.5), NEEDLE))
        result = self.check(NOT_CLEAN, path)
        self.assertFalse(result["acceptable"])
        self.assertEqual(self.faults(result), {"intersecting": 3})
        self.assertEqual({(p["kind"], p["face"], p["vertices"][0]) for p in result["intersecting"]}, {("crossing", 0, 3)})
        self.assertEqual({tuple(p["vertices"][2:]) for p in result["intersecting"]}, {(0, 1, 2)})
        said = self.say(path)
        self.assertIn("a step cannot start here", said)
        self.assertIn("3 edge-face pairs intersect (3 crossing), first edge", said)
        self.assertIn("on the command line: no option leaves them out: move them apart\n", said)
        for end in [4, 5, 6]:
            self.assertRegex(said, rf"edge \d+ \(vertices 3 {end}\) goes through face 0 \(vertices 0 1 2\)")

    def test_a_touching_tip(self):
        path = self.write("a.obj", obj(needle(0), NEEDLE))
        result = self.check(NOT_CLEAN, path)
        self.assertEqual(self.faults(result), {"intersecting": 3, "touching": 1})
        self.assertEqual(result["touching"][0]["vertices"], [3, 0, 1, 2])
        self.assertEqual({p["kind"] for p in result["intersecting"]}, {"touching"})
        self.assertIn("--touching-may-pass-through", self.say(path))

    def test_pairs_within_the_separation(self):
        path = self.write("a.obj", obj(needle(0.125), NEEDLE))
        self.check(CLEAN, path)
        self.check(CLEAN, path, "--min-separation", "0.12")
        result = self.check(NOT_CLEAN, path, "--min-separation", "0.13")
        self.assertEqual(self.faults(result), {"within_separation": 1})
        pair = result["within_separation"][0]
        self.assertEqual((pair["vertices"], pair["distance"], pair["separation"]), ([3, 0, 1, 2], 0.125, 0.13))
        self.assertIn("0.125 apart, 0.13 to be kept", self.say(path, "--min-separation", "0.13"))

    def test_copied_vertices_and_what_becomes_of_them(self):
        faces = [(0, 1, 2), (3, 4, 5)]
        a = self.write("a.obj", obj(SEAM, faces))
        b = self.write("b.obj", obj(SEAM[:4] + [(1, 1, 0.25)] + SEAM[5:], faces))
        torn = self.write("torn.obj", obj(SEAM[:5] + [(0, 1, 1)], faces))
        result = self.check(NOT_CLEAN, a)
        self.assertEqual(result["copied_vertices"], [[1, 3], [2, 5]])
        self.assertNotIn("copies_that_part", result)
        said = self.say(a)
        for words in ["vertices 1 and 3 are at one place", "vertices 2 and 5 are at one place", "--weld, where they are the copies of a seam"]:
            self.assertIn(words, said)
        for end, together, parting in [(b, [[1, 3], [2, 5]], []), (torn, [[1, 3]], [[2, 5]])]:
            result = self.check(NOT_CLEAN, a, end)
            self.assertEqual((result["copies_that_stay_together"], result["copies_that_part"]), (together, parting))
        self.assertIn("vertices 2 and 5 are at one place, not at the end of the step", self.say(a, torn))
        self.check(CLEAN, a, "--weld")
        self.check(CLEAN, a, b, "--weld")
        self.assertEqual(self.check(NOT_CLEAN, a, torn, "--weld")["copied_vertices"], [[2, 5]])

    def test_a_seam_is_named_by_step_and_active_set(self):
        faces = [(0, 1, 2), (3, 4, 5)]
        a = self.write("a.obj", obj(SEAM, faces))
        b = self.write("b.obj", obj(SEAM[:4] + [(1, 1, 0.25)] + SEAM[5:], faces))
        for command in ["step", "active-set"]:
            notes = self.json(command, a, b)["notes"]
            self.assertEqual(len(notes), 1)
            for words in ["onset check", "a.obj", "vertices 1 and 3, 2 and 5", "--weld"]:
                self.assertIn(words, notes[0])
            result = self.json(command, a, b, "--weld")
            self.assertEqual((result["outcome"], result.get("notes")), ("free", None))
        self.assertEqual(self.json("step", a, b, "--weld")["step"], 1)
        # Left are the two corners of the square, each beside the other triangle.
        self.assertEqual(self.json("candidates", a, b)["candidates"], {"vf": 6, "ee": 7})
        self.assertEqual(self.json("candidates", a, b, "--weld")["candidates"], {"vf": 2, "ee": 0})
        self.assertEqual(self.json("bench", a, b, "--weld", "--repeats", "0")["scenes"][0]["step_size"], 1)

    def test_step_and_active_set_point_to_it(self):
        for tip, words in [(-0.5, "intersects or touches"), (0, "intersects or touches")]:
            frames = [self.write(f"{i}.obj", obj(points, NEEDLE))
                      for i, points in enumerate([needle(tip), [(x + 0.01 * (i > 2), y, z) for i, (x, y, z) in enumerate(needle(tip))]])]
            for command in ["step", "active-set"]:
                said = self.succeed(command, *frames)
                self.assertEqual(said.count("onset check"), 1)
                self.assertIn(words, said.splitlines()[0])
                self.assertIn("0.obj", said.splitlines()[0])
        apart = [self.write(f"{i}.obj", obj(needle(tip), NEEDLE)) for i, tip in enumerate([0.5, 0.25])]
        self.assertNotIn("onset check", self.succeed("step", *apart))
        closing = self.json("step", *apart, "--min-separation", "0.75")
        self.assertEqual(closing["outcome"], "initial_contact")
        self.assertIn("closer than the separation", closing["notes"][0])

    def test_faces_without_area_and_vertices_of_nothing(self):
        points = START + [(9, 9, 9), (10, 10, 10), (11, 11, 11), (20, 0, 0), (30, 0, 0)]
        path = self.write("a.obj", obj(points, FACES + [(6, 7, 8)]))
        result = self.check(NOT_CLEAN, path)
        self.assertTrue(result["acceptable"])
        self.assertEqual(self.faults(result), {"faces_without_area": 1, "unused_vertices": 2})
        self.assertEqual((result["faces_without_area"], result["unused_vertices"]), ([2], [9, 10]))
        said = self.say(path)
        for words in ["a step may start here", "face 2 (vertices 6 7 8)", "vertex 9", "vertex 10", "lines 'p'"]:
            self.assertIn(words, said)
        declared = self.write("p.obj", obj(points, FACES) + "p 7 8 9 10 11\n")
        self.check(CLEAN, declared)

    def test_text_shows_ten_and_the_others_all(self):
        """Fifteen triangles stuck through one."""
        points, faces = [(-100, -100, 0), (100, -100, 0), (0, 100, 0)], [(0, 1, 2)]
        for i in range(15):
            points += [(i, 0, -1), (i + 0.3, 0, 1), (i, 0.3, 1)]
            faces.append((3 * i + 3, 3 * i + 4, 3 * i + 5))
        path = self.write("a.obj", obj(points, faces))
        self.assertEqual(len(self.check(NOT_CLEAN, path)["intersecting"]), 30)
        said = self.say(path)
        self.assertEqual((said.count("goes through"), said.count("... 20 more")), (10, 1))
        rows = list(csv.DictReader(io.StringIO(self.run_app("check", path, "--csv", "-").stdout)))
        self.assertEqual([row["fault"] for row in rows], ["intersecting"] * 30)

    def test_csv(self):
        path = self.write("a.obj", obj(needle(0) + [(5, 5, 5)], NEEDLE))
        rows = list(csv.DictReader(io.StringIO(self.run_app("check", path, "--csv", "-").stdout)))
        self.assertEqual([row["fault"] for row in rows], ["intersecting"] * 3 + ["touching", "unused_vertices"])
        self.assertEqual([rows[3][key] for key in ["kind", "a", "b", "v0", "v1", "v2", "v3", "v4"]],
                         ["vf", "3", "0", "3", "0", "1", "2", ""])
        self.assertEqual([rows[0][key] for key in ["kind", "b", "v0", "v2", "v3", "v4"]], ["touching", "0", "3", "0", "1", "2"])
        self.assertEqual(rows[4]["v0"], "7")

    def test_export(self):
        """What meets, and nothing else, is a file that onset reads again."""
        path = self.write("a.obj", obj(needle(-0.5) + [(9, 9, 9), (10, 9, 9), (9, 10, 9)], NEEDLE + [(7, 8, 9)]))
        self.assertEqual(self.run_app("check", path, "--export", "out.ply").returncode, NOT_CLEAN)
        text = (self.folder / "out.ply").read_text().splitlines()
        rows = [row.split() for row in text[text.index("end_header") + 1:]]
        self.assertEqual({row[6] for row in rows if len(row) == 7}, {"0", "1", "2", "3", "4", "5", "6"})
        self.assertEqual({tuple(row[3:6]) for row in rows if len(row) == 7}, {("255", "0", "0"), ("255", "255", "0")})
        self.assertIn("9 vertices, 6 edges, 1 faces", self.succeed("plan", "out.ply"))
        self.must_fail(BAD, ["gone/out.ply"], "check", path, "--export", "gone/out.ply")

    def test_bodies_are_left_out(self):
        path = self.write("a.obj", obj(needle(-0.5), NEEDLE))
        self.check(CLEAN, path, "--rigid")
        both = ["--bodies", "components", "--static-body", "0"]
        self.check(NOT_CLEAN, path, *both)
        self.check(CLEAN, path, *both, "--static-body", "1")

    def test_a_budget_that_ends_the_search(self):
        path = self.write("a.obj", obj(needle(0.5), NEEDLE))
        result = self.check(NOT_CLEAN, path, "--time-limit", "0")
        self.assertEqual((result["outcome"], result["acceptable"]), ("out_of_time", False))
        self.assertIn("not known: out_of_time", self.say(path, "--time-limit", "0"))

    def test_stdin_is_not_read(self):
        words = ["stdin is not read", "file"]
        for path in ["-", "/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"]:
            self.must_fail(BAD, [path + ": ", *words], "check", path)
            self.must_fail(BAD, [path + ": ", *words], "queries", path, "--kind", "vf")
        with open(self.write("a.obj", obj(START, FACES))) as given:
            done = subprocess.run([BINARY, "check", "/dev/stdin"], stdin=given, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (BAD, ""))
        self.assertIn(words[0], done.stderr)

    def test_usage(self):
        path = self.write("a.obj", obj(START, FACES))
        self.must_fail(BAD, ["gone.obj"], "check", "gone.obj")
        self.must_fail(BAD, ["different topology"], "check", path, self.write("b.obj", obj(END, FACES[:1])))
        self.must_fail(2, ["FILE"], "check")
        self.assertIn("3 something was", self.succeed("check", "--help"))


if __name__ == "__main__":
    unittest.main()
