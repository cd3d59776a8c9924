"""The root finders that the library is measured against: right on plain queries, counted right where the truth is wrong."""

import json
import os
import subprocess
import unittest

from support import AppTest
from test_queries import edge_edge, rows, vertex_face

BASELINES = os.environ["ONSET_BASELINES"]


class Baselines(AppTest):
    def measure(self, *arguments):
        done = subprocess.run([BASELINES, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, timeout=100)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def queries(self, make, truth=(1, 0, 1)):
        """A hit at t = 1/2, a miss, and a hit at t = 1/4, all oblique."""
        folder = self.folder / {vertex_face: "vf", edge_edge: "ee"}[make]
        folder.mkdir(exist_ok=True)
        tilt = lambda points: [(x + 0.25 * z, y - 0.5 * z, z + 0.125 * x) for x, y, z in points]
        pairs = zip([(1, -1), (1, 0.25), (0.5, -1.5)], truth)
        (folder / "data.csv").write_text("".join(rows(tilt(make(*ends)), hit) for ends, hit in pairs))
        return folder / "data.csv"

    def finders(self, *arguments):
        [file] = self.measure(*arguments)["files"]
        return {finder["name"]: finder for finder in file["finders"]}

    def test_plain_queries(self):
        for make in (vertex_face, edge_edge):
            path = self.queries(make)
            (path.parent / "toi.csv").write_text("0x1p-1,0x1p-1\ninf,inf\n0x1p-2,0x1p-2\n")
            found = self.finders(path)
            self.assertEqual(list(found), ["onset", "onset, 1e-12", "onset, exact", "onset, inclusion alone", "IRF", "UIRF", "cubic"])
            for name, f in found.items():
                counts = [f[key] for key in ["queries", "positives", "false_positives", "false_negatives", "zero", "cut"]]
                self.assertEqual(counts, [3, 2, 0, 0, 0, 0], (make.__name__, name))
                self.assertLess(f["early_sum"], 1e-4, name)
                self.assertLess(f["latest"], 1e-12 if name == "cubic" else 5e-324, name)

    def test_wrong_truth_is_counted(self):
        for f in self.finders(self.queries(vertex_face, truth=(0, 1, 1))).values():
            self.assertEqual((f["false_positives"], f["false_negatives"]), (1, 1), f["name"])

    def test_every_and_separation(self):
        path = self.queries(edge_edge)
        self.assertEqual(self.finders(path, "--every", "2")["onset"]["queries"], 2)
        found = self.finders(path, "--separation", "0.5")
        self.assertEqual(len(found), 4)
        for f in found.values():
            self.assertEqual(f["positives"], 3, f["name"])

    def test_tolerance(self):
        """The finders that have one, and wider boxes are accepted earlier."""
        path = self.queries(vertex_face)
        (path.parent / "toi.csv").write_text("0x1p-1,0x1p-1\ninf,inf\n0x1p-2,0x1p-2\n")
        coarse, fine = self.finders(path, "--tolerance", "1e-2"), self.finders(path, "--tolerance", "1e-7")
        self.assertEqual(list(fine), ["onset", "onset, inclusion alone", "IRF", "UIRF"])
        for name in fine:
            self.assertEqual((coarse[name]["false_negatives"], fine[name]["false_negatives"]), (0, 0), name)
            self.assertLess(fine[name]["early_sum"], 1e-5, name)
        for name in ["onset, inclusion alone", "IRF", "UIRF"]:
            self.assertGreater(coarse[name]["early_sum"], 10 * fine[name]["early_sum"], name)

    def test_few_boxes(self):
        """A search that is cut short says so, and says contact."""
        found = self.finders(self.queries(vertex_face), "--boxes", "2")
        for name in ["IRF", "UIRF"]:
            self.assertGreater(found[name]["cut"], 0)
            self.assertEqual(found[name]["false_negatives"], 0)


if __name__ == "__main__":
    unittest.main()
