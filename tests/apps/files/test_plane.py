"""--dim 2: lines in the plane, by every subcommand that takes it."""

import csv
import io
import json
import unittest

from support import AppTest


def frame(y, z=""):
    """A triangle of lines with its top at (1, 1), and an edge at height y above it."""
    flat = "" if z == "" else " 0"
    return f"v 0 0{flat}\nv 2 0{flat}\nv 1 1{flat}\nv 0 {y} {z}\nv 2 {y} {z}\nl 1 2 3 1\nl 4 5\n"


class Plane(AppTest):
    def setUp(self):
        super().setUp()
        self.files = self.write("a.obj", frame(2)), self.write("b.obj", frame(0.25))

    def test_a_step_ends_where_the_edge_comes_to_the_vertex(self):
        result = self.json("step", *self.files, "--dim", 2)
        self.assertEqual(result["outcome"], "contact")
        self.assertTrue(0.571 < result["step"] < 4 / 7)
        limiting = {key: result["limiting"][key] for key in ("kind", "a", "b", "vertices")}
        self.assertEqual(limiting, {"kind": "ve", "a": 2, "b": 3, "vertices": [2, 3, 4, 4]})
        self.assertIn("vertex 2 and edge 3 (vertices 3 4)", self.succeed("step", *self.files, "--dim", 2))

    def test_active_set_candidates_and_filters(self):
        rows = list(csv.DictReader(io.StringIO(self.csv("active-set", *self.files, "--dim", 2))))
        self.assertEqual([(r["kind"], r["a"], r["b"], r["certain"]) for r in rows], [("ve", "2", "3", "certain")])
        self.assertEqual([float(rows[0][n]) for n in ("nx", "ny", "nz", "w3")], [0, -1, 0, 0])
        self.assertEqual(self.json("active-set", *self.files, "--dim", 2)["contacts"], {"vf": 0, "ee": 0, "ve": 1})
        pairs = self.csv("candidates", *self.files, "--dim", 2).splitlines()
        self.assertIn("ve,2,3", pairs)
        self.assertTrue(all(row.startswith("ve,") for row in pairs[1:]))
        plan = self.json("filters", *self.files, "--dim", 2)["plan"]
        self.assertEqual((plan["ve"]["pairs"], plan["ve"]["may_meet"], plan["vf"]["pairs"]), (20, 12, 0))
        self.assertIn("vertex-edge 12 pairs may meet of 20; left out: 8 adjacent", self.succeed("filters", *self.files, "--dim", 2))

    def test_check_finds_edges_that_cross(self):
        crossing = self.write("c.obj", frame(0.5))
        done = self.run_app("check", crossing, "--dim", 2, "--json", "-", "--export", "c.ply")
        self.assertEqual(done.returncode, 3)
        found = json.loads(done.stdout)["intersecting"]
        self.assertEqual([(p["edge"], p["face"], p["kind"]) for p in found], [(1, 3, "crossing"), (2, 3, "crossing")])
        self.assertIn("edge 1 (vertices 1 2) goes through edge 3", self.run_app("check", crossing, "--dim", 2).stdout)
        self.assertEqual(self.run_app("check", self.files[0], "--dim", 2).returncode, 0)

    def test_what_leaves_the_plane_is_refused_by_name(self):
        high = self.write("high.obj", frame(0.25, "0.5"))
        self.must_fail(1, ["vertex 3 has z = 0.5", "at the end"], "step", self.files[0], high, "--dim", 2)
        faces = self.write("f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.must_fail(1, ["1 faces", "lines alone"], "step", faces, faces, "--dim", 2)
        self.must_fail(2, ["--dim"], "step", *self.files, "--dim", 4)

    def test_a_dump_is_replayed(self):
        self.succeed("active-set", *self.files, "--dim", 2, "--dump", "pair", "--export", "pair")
        self.assertIn("same", self.succeed("replay", "pair-vf.csv"))
        self.assertTrue((self.folder / "pair-swept.ply").exists())


if __name__ == "__main__":
    unittest.main()
