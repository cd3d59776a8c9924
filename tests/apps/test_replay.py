"""--dump, replay and --export: the queries of a step asked again, and geometry that other programs read."""

import json
import unittest

from support import END, FACES, START, AppTest, obj, random_soup


class Replay(AppTest):
    def setUp(self):
        super().setUp()
        self.a, self.b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))

    def soup(self):
        faces, vertices, moved = random_soup(7, 40)
        return self.write("s0.obj", obj(vertices, faces)), self.write("s1.obj", obj(moved, faces))

    def test_step_dump_replays_to_the_same_bits(self):
        step = self.json("step", self.a, self.b, "--tolerance", "1e-6", "--dump", "slow")
        rows = (self.folder / "slow-vf.csv").read_text().splitlines()
        self.assertEqual(len(rows) % 8, 0)
        self.assertTrue(all(len(row.split(",")) == 7 and row.endswith(",1") for row in rows))
        replayed = self.json("replay", "slow-vf.csv")
        self.assertEqual(replayed["differing"], 0)
        first = replayed["queries"][0]
        self.assertEqual((first["kind"], first["outcome"], first["verdict"]), ("vf", "contact", "same"))
        self.assertEqual(first["toi"], step["toi"])
        # The format that `queries` reads, too: no false answers to what the dump says.
        total = self.json("queries", "slow-vf.csv", "--tolerance", "1e-6")["total"]
        self.assertEqual((total["queries"], total["false_negatives"], total["false_positives"]), (len(rows) // 8, 0, 0))

    def test_a_changed_answer_is_told(self):
        self.succeed("step", self.a, self.b, "--dump", "slow.csv")
        path = self.folder / "slow-vf.json"
        expected = json.loads(path.read_text())
        expected["queries"][0]["toi"] = 0.25
        path.write_text(json.dumps(expected))
        replayed = self.json("replay", "slow-vf.csv")
        self.assertEqual(replayed["differing"], 1)
        self.assertIn("0.25", replayed["queries"][0]["verdict"])
        self.assertIn("1 differ", self.succeed("replay", "slow-vf.csv"))
        path.write_text("{")
        self.must_fail(1, ["slow-vf.json"], "replay", "slow-vf.csv")
        path.unlink()
        self.assertIsNone(self.json("replay", "slow-vf.csv")["queries"][0]["verdict"])

    def test_active_set_dump_has_exactly_the_doubles(self):
        a, b = self.soup()
        contacts = self.json("active-set", a, b, "--dump", "d")["contacts"]
        self.assertGreater(contacts["vf"] + contacts["ee"], 0)
        files = sorted(path.name for path in self.folder.glob("d-*.csv"))
        replayed = self.json("replay", *files)
        self.assertEqual(replayed["differing"], 0)
        coordinates = {float(x) for path in (a, b) for line in path.read_text().splitlines() if line.startswith("v ")
                       for x in line.split()[1:]}
        for name in files:
            for line in (self.folder / name).read_text().splitlines():
                fields = [int(x) for x in line.split(",")]
                for numerator, denominator in zip(fields[0:6:2], fields[1:6:2]):
                    self.assertIn(numerator / denominator, coordinates)

    def ply(self, name):
        header, body = (self.folder / name).read_text().split("end_header\n")
        counts = {line.split()[1]: int(line.split()[2]) for line in header.splitlines() if line.startswith("element")}
        rows = body.splitlines()
        self.assertEqual(len(rows), sum(counts.values()))
        return counts, [[float(x) for x in row.split()] for row in rows]

    def test_export(self):
        for command in ["step", "active-set"]:
            self.succeed(command, self.a, self.b, "--tolerance", "1e-6", "--export", command + ".ply")
            counts, rows = self.ply(command + "-contacts.ply")
            self.assertEqual(counts, {"vertex": 1})
            x, y, z, nx, ny, nz, toi, red, green, blue = rows[0]
            self.assertAlmostEqual(z, 0, delta=1e-6)
            self.assertEqual((nx, ny, nz, red, blue), (0, 0, 1, 255, 0))
            self.assertAlmostEqual(toi, 0.5, delta=1e-6)
            counts, rows = self.ply(command + "-swept.ply")
            self.assertEqual((counts["face"], counts["edge"]), (len(FACES) + 3, 1))
            counts, rows = self.ply(command + "-candidates.ply")
            self.assertEqual(counts["vertex"], 2 * counts["edge"])
            self.assertEqual(sum(row[6] >= 0 for row in rows[: counts["vertex"]]), 2)

    def test_window_and_limits(self):
        a, b = self.soup()
        full = self.json("active-set", a, b)
        rows = self.csv("active-set", a, b).splitlines()[1:]
        toi = [float(row.split(",")[3]) for row in rows]
        window = self.csv("active-set", a, b, "--window", "0.1").splitlines()[1:]
        self.assertEqual(window, [row for row, t in zip(rows, toi) if t <= min(toi) + 0.1])
        self.assertLess(len(window), len(rows))
        self.assertIsNone(full["complete_until"])
        few = self.json("active-set", a, b, "--memory-limit", "512")
        self.assertEqual((few["outcome"], sum(few["contacts"].values())), ("out_of_memory", 2))
        self.assertEqual(self.json("step", a, b, "--time-limit", "0")["outcome"], "out_of_time")
        none = self.json("step", a, b, "--check-limit", "0")
        self.assertEqual((none["outcome"], none["step"], none["limiting"]), ("out_of_checks", 0, None))
        self.must_fail(2, ["--time-limit"], "step", a, b, "--time-limit", "-1")
        self.must_fail(2, ["--window"], "active-set", a, b, "--window", "soon")


if __name__ == "__main__":
    unittest.main()
