"""What takes part in a step: faces, wires and points of the files, polygons as triangles, copies at seams."""

import re
import unittest

from support import AppTest, obj

BAD = 1


def frame(*lines):
    return "\n".join(lines) + "\n"


def vertices(points):
    return ["v %r %r %r" % p for p in points]


class Wires(AppTest):
    def test_a_wire_is_stopped_by_a_face(self):
        frames = [frame(*vertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (.25, .25, z), (.3, .3, z)]), "f 1 2 3", "l 4 5")
                  for z in [1, -1]]
        a, b = self.write("a.obj", frames[0]), self.write("b.obj", frames[1])
        result = self.json("step", a, b, "--tolerance", "1e-9")
        self.assertEqual(result["outcome"], "contact")
        self.assertAlmostEqual(result["step"], 0.5, delta=1e-8)
        self.assertIn("4 edges", self.succeed("step", a, b))

    def test_wires_alone(self):
        frames = [frame(*vertices([(0, -1, 0), (0, 1, 0), (-1, 0, z), (1, 0, z)]), "l 1 2", "l 3 4") for z in [1, -1]]
        result = self.json("step", self.write("a.obj", frames[0]), self.write("b.obj", frames[1]))
        self.assertEqual((result["outcome"], result["limiting"]["kind"]), ("contact", "ee"))
        self.assertEqual(result["limiting"]["vertices"], [0, 1, 2, 3])

    def test_a_polyline_of_n_points_has_n_minus_one_edges(self):
        path = self.write("a.obj", frame(*vertices([(i, 0, 0) for i in range(5)]), "l 1 2 3 4 5", "l 5/1 1/2"))
        self.assertIn("5 vertices, 5 edges, 0 faces", self.succeed("plan", path))

    def test_wires_come_after_the_edges_of_faces_each_once(self):
        points = vertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 5, 5), (6, 6, 6)])
        path = self.write("a.obj", frame(*points, "l 4 5", "l 3 1", "l 5 4", "f 1 2 3"))
        self.assertIn("5 vertices, 4 edges, 1 faces", self.succeed("plan", path))
        rows = self.csv("candidates", path, self.write("b.obj", re.sub("v [56].*", "v 0.2 0.2 -5", path.read_text())))
        self.assertEqual({row.split(",")[2] for row in rows.splitlines() if row.startswith("ee")} - {"3"}, set())


    def test_wires_are_not_lost_by_refining(self):
        path = self.write("a.obj", frame(*vertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 5, 5)]), "f 1 2 3", "l 1 4"))
        self.must_fail(2, ["--refine", "wires or points"], "bench", path, path, "--refine", "1", "--repeats", "0")
        self.assertEqual(self.json("bench", path, path, "--repeats", "0")["scenes"][0]["edges"], 4)


class PointsOfFiles(AppTest):
    def test_declared_points_meet_each_other(self):
        """p declares a point; two of them keep the separation, and a vertex of nothing does not."""
        def run(*declared):
            frames = [frame(*vertices([(0, 0, 0), (0, 0, z)]), *declared) for z in [2, 1]]
            return self.json("step", self.write("a.obj", frames[0]), self.write("b.obj", frames[1]),
                             "--min-separation", "1.5", "--tolerance", "1e-9")
        for declared in [["p 1 2"], ["p 1", "p 2", "p -1"], ["p 1/1 2/2"], []]:
            self.assertAlmostEqual(run(*declared)["step"], 0.5, delta=1e-8)
        self.assertEqual(run("p 1")["outcome"], "free")
        self.assertIn("each vertex is a point", run()["notes"][0])

    def test_vertices_of_nothing_are_stopped_by_faces(self):
        frames = [frame(*vertices([(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, z)]), "f 1 2 3") for z in [1, -1]]
        result = self.json("step", self.write("a.obj", frames[0]), self.write("b.obj", frames[1]))
        self.assertEqual((result["outcome"], result["limiting"]["vertices"]), ("contact", [3, 0, 1, 2]))

    def test_points_of_an_edge_or_a_face_take_part_with_it(self):
        points = vertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 5, 5), (6, 6, 6), (7, 7, 7)])
        path = self.write("a.obj", frame(*points, "f 1 2 3", "l 4 5", "p 1 4 6 6"))
        self.assertIn("6 vertices, 4 edges, 1 faces, 1 points", self.succeed("plan", path))


class Polygons(AppTest):
    def triangles(self, points, *faces):
        """The faces that onset makes of polygons, from what it exports."""
        path = self.write("p.obj", frame(*vertices(points), *("f " + " ".join(str(v + 1) for v in f) for f in faces)))
        self.succeed("active-set", path, path, "--export", "out")
        text = (self.folder / "out-swept.ply").read_text().splitlines()
        body = text[text.index("end_header") + 1 + len(points):]
        return [tuple(map(int, row.split()[1:])) for row in body]

    def area(self, points, face):
        (ax, ay, _), (bx, by, _), (cx, cy, _) = (points[v] for v in face)
        return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2

    def covers(self, points, face):
        """Triangles of one winding whose areas sum to the polygon's: nothing is outside, nothing twice."""
        made = self.triangles(points, face)
        self.assertEqual(len(made), len(face) - 2)
        areas = [self.area(points, f) for f in made]
        whole = sum(self.area(points, (face[0], face[i], face[i + 1])) for i in range(1, len(face) - 1))
        self.assertTrue(all(a * whole > 0 for a in areas), (made, areas))
        self.assertAlmostEqual(sum(areas), whole, delta=1e-12)

    def test_concave_polygons_are_covered(self):
        arrow = [(0, 0, 0), (2, -1, 0), (0, 2, 0), (-2, -1, 0)]
        for shift in range(4):
            face = tuple((i + shift) % 4 for i in range(4))
            self.covers(arrow, face)
            self.covers(arrow, face[::-1])
        comb = [(0, 0, 0), (6, 0, 0), (6, 5, 0), (5, 5, 0), (5, 1, 0), (3.5, 1, 0), (3, 5, 0), (2.5, 1, 0), (1, 1, 0), (1, 5, 0),
                (0, 5, 0)]
        self.covers(comb, tuple(range(11)))
        self.covers(comb, tuple(range(11))[::-1])
        tee = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)]  # corner 1 on a straight side
        for shift in range(5):
            self.covers(tee, tuple((i + shift) % 5 for i in range(5)))

    def test_triangles_and_polygons_keep_their_order(self):
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)]
        made = self.triangles(points, (0, 1, 4), (0, 1, 2, 3), (2, 3, 4))
        self.assertEqual((made[0], made[3], {v for f in made[1:3] for v in f}), ((0, 1, 4), (2, 3, 4), {0, 1, 2, 3}))

    def test_both_ends_are_cut_alike(self):
        """The quadrilateral is concave at another corner in each frame."""
        frames = [frame(*vertices(p), "f 1 2 3 4") for p in [
            [(0, 0, 0), (2, -1, 0), (0, 2, 0), (-2, -1, 0)], [(0, 3, 0), (2, -1, 0), (0, 0, 0), (-2, -1, 0)]]]
        result = self.json("step", self.write("a.obj", frames[0]), self.write("b.obj", frames[1]))
        self.assertEqual(len([n for n in result["notes"] if "triangulated 1 polygon" in n]), 1)

    def test_what_was_done_is_said(self):
        points = [(i, i * i, 0) for i in range(6)]
        path = self.write("p.obj", frame(*vertices(points), "f 1 2 3 4 5", "f 1 2 6", "f 3 4 5 6"))
        said = self.succeed("step", path, path)
        self.assertIn("triangulated 2 polygons of more than 3 corners: of 3 faces there are 6 triangles", said)
        done = self.run_app("step", path, path, "--csv", "-")
        self.assertIn("triangulated 2 polygons", done.stderr)
        self.assertNotIn("triangulated", done.stdout)

    def test_polygons_that_differ_are_named(self):
        points = vertices([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
        a, b = self.write("a.obj", frame(*points, "f 1 2 3 4")), self.write("b.obj", frame(*points, "f 1 2 3"))
        self.must_fail(BAD, ["different topology", "face 0 is (0 1 2 3) against (0 1 2)"], "step", a, b)


if __name__ == "__main__":
    unittest.main()
