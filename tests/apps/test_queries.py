"""Queries with known answers: counts, kinds, exact rationals."""

import unittest

from support import AppTest

SLAB = [(-1, -1, 0), (2, -1, 0), (-1, 2, 0)]


def vertex_face(z0, z1):
    """A point over the middle of a resting face, moving from z0 to z1."""
    return [(0, 0, z0), *SLAB, (0, 0, z1), *SLAB]


def edge_edge(z0, z1):
    """An edge along y over a resting edge along x, moving from z0 to z1."""
    rest = [(-1, 0, 0), (1, 0, 0)]
    return [(0, -1, z0), (0, 1, z0), *rest, (0, -1, z1), (0, 1, z1), *rest]


def simple(x):
    n, d = x.as_integer_ratio() if isinstance(x, float) else (x, 1)
    return f"{n},{d}"


def rows(points, truth, rational=simple):
    return "".join(",".join(map(rational, p)) + f",{truth}\n" for p in points)


class Queries(AppTest):
    def file(self, name, *queries):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        return self.write(name, "".join(queries))

    def answers(self, *arguments):
        header, *lines = self.csv("queries", *arguments).splitlines()
        self.assertEqual(header, "file,index,kind,outcome,toi")
        return [line.rsplit(",", 4) for line in lines]

    def check_half(self, toi):
        self.assertLessEqual(float(toi), 0.5)
        self.assertGreater(float(toi), 0.499)

    def test_counts_against_the_truth(self):
        """Two hits and a miss told right, one hit and two misses with a false truth."""
        for kind, make in [("vertex-face", vertex_face), ("edge-edge", edge_edge)]:
            name = f"{kind}/data.csv"
            self.file(name, rows(make(1, -1), 1), rows(make(1, 0.25), 0), rows(make(0.5, -0.5), 1),
                      rows(make(1, -1), 0), rows(make(1, 0.25), 1), rows(make(-2, -0.25), 1))
            result = self.json("queries", name)
            self.assertEqual(list(result), ["files", "total"])
            [entry] = result["files"]
            self.assertEqual(list(entry)[:8], ["file", "kind", "queries", "positives", "false_negatives",
                                               "false_positives", "mean_us", "max_us"])
            self.assertEqual((entry["file"], entry["kind"]), (name, "vf" if make is vertex_face else "ee"))
            numbers = [entry[key] for key in ["queries", "positives", "false_negatives", "false_positives"]]
            self.assertEqual(numbers, [6, 3, 2, 1])
            self.assertGreater(entry["mean_us"], 0)
            self.assertGreaterEqual(entry["max_us"], entry["mean_us"])
            self.assertEqual({key: entry[key] for key in result["total"]}, result["total"])

    def test_rows_of_answers(self):
        name = self.file("a, b/1vf.csv", rows(vertex_face(1, -1), 1), rows(vertex_face(1, 0.25), 0))
        hit, miss = self.answers(name)
        self.assertEqual(hit[:4], [f'"{name}"', "0", "vf", "contact"])
        self.check_half(hit[4])
        self.assertEqual(miss[1:], ["1", "vf", "free", "inf"])

    def test_total_of_several_files(self):
        self.file("1-vf.csv", rows(vertex_face(1, -1), 1))
        self.file("2_ee.csv", rows(edge_edge(1, -1), 0), rows(edge_edge(1, 2), 0))
        result = self.json("queries", "1-vf.csv", "2_ee.csv")
        self.assertEqual([entry["kind"] for entry in result["files"]], ["vf", "ee"])
        total = result["total"]
        self.assertEqual([total[k] for k in ["queries", "positives", "false_negatives", "false_positives"]], [3, 2, 0, 1])
        self.assertEqual(total["max_us"], max(entry["max_us"] for entry in result["files"]))

    def test_kind_from_the_path(self):
        """The file's name before its folders; whole words only."""
        query = rows(vertex_face(1, -1), 1)
        for path, kind in [("vertex-face/x.csv", "vf"), ("Edge_Edge/x.csv", "ee"), ("326vf.csv", "vf"),
                           ("ee/7vf.csv", "vf"), ("vf/three-trees.csv", "vf"), ("vertex-face/227ee.csv", "ee")]:
            self.file(path, query)
            self.assertEqual(self.answers(path)[0][2], kind, path)

    def test_kind_given(self):
        """The same eight points: as a point and a face they meet, as two edges they do not."""
        self.file("vf.csv", rows(vertex_face(1, -1), 1))
        self.assertEqual(self.answers("vf.csv")[0][2:4], ["vf", "contact"])
        self.assertEqual(self.answers("vf.csv", "--kind", "ee")[0][2:], ["ee", "free", "inf"])
        self.file("what.csv", rows(edge_edge(1, -1), 1))
        self.assertEqual(self.answers("what.csv", "--kind", "ee")[0][2:4], ["ee", "contact"])

    def test_rationals_of_any_length(self):
        """Numerators and denominators of 300 digits and more, reduced or not, give the bits of the plain doubles."""
        values = [0.1, -1 / 3, 2.0 ** -40, 12345.678]
        points = [(0.1, 2.0 ** -40, 0.7), *[(x - 1 / 3, y + 0.1, z * 1.0) for x, y, z in SLAB],
                  (0.2, -1 / 3, -0.9), *[(x * 1.1, y * 1.3, z - 0.01) for x, y, z in SLAB]]
        factor = 7 ** 360
        self.assertGreater(len(str(factor)), 300)

        def long(x):
            n, d = float(x).as_integer_ratio()
            return f"{n * factor},{d * factor}"

        def signed(x):
            n, d = float(x).as_integer_ratio()
            return f"{-n * 10 ** 299},{-d * 10 ** 299}"

        def padded(x):
            n, d = float(x).as_integer_ratio()
            return f" {'-' if n < 0 else '+'}000{abs(n)}, 00{d}"

        def spread(points):
            return [tuple(v * s for v, s in zip(p, (1, 1, 1))) for p in points]

        plain = self.file("plain-vf.csv", rows(points, 1))
        [[*_, outcome, toi]] = self.answers(plain)
        self.assertEqual(outcome, "contact")
        for rational in [long, signed, padded]:
            other = self.file("other-vf.csv", rows(points, 1, rational))
            self.assertEqual(self.answers(other)[0][3:], [outcome, toi], rational.__name__)

    def test_the_whole_range_of_doubles(self):
        """Denominators of 324 digits, numerators of 309: read, asked, answered."""
        tiny, huge = 5e-324, 1.7976931348623157e308
        self.file("tiny-vf.csv", rows([tuple(tiny * v for v in p) for p in vertex_face(1, -1)], 1))
        self.assertNotEqual(self.answers("tiny-vf.csv")[0][3], "free")
        self.file("huge-vf.csv", rows([(huge, huge, huge)] * 8, 0))
        self.assertEqual(self.answers("huge-vf.csv")[0][3], "out_of_range")

    def test_line_ends(self):
        text = rows(vertex_face(1, -1), 1)
        expected = self.answers(self.file("vf.csv", text))
        for changed in [text.replace("\n", "\r\n"), text[:-1], text + "\n"]:
            self.assertEqual(self.answers(self.file("vf.csv", changed)), expected)

    def test_same_bytes(self):
        self.file("vf.csv", *[rows(vertex_face(1 + 0.01 * i, -0.7), 1) for i in range(50)])
        first = self.csv("queries", "vf.csv", "--threads", "1")
        self.assertEqual(first, self.csv("queries", "vf.csv", "--threads", "2"))
        self.assertEqual(first.count("\n"), 51)

    def test_options_arrive(self):
        self.file("vf.csv", rows(vertex_face(1, 0.25), 0))
        self.assertEqual(self.json("queries", "vf.csv")["total"]["positives"], 0)
        self.assertEqual(self.json("queries", "vf.csv", "--tolerance", "1e-7")["total"]["tolerance"], 1e-7)
        self.assertEqual(self.json("queries", "vf.csv", "--min-separation", "0.3")["total"]["positives"], 1)


if __name__ == "__main__":
    unittest.main()
