"""Every script of apps/ that plots runs on a small input and writes its files. Needs matplotlib (with_matplotlib.sh)."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from support import APPS, AppTest, obj, ply, random_soup
from test_queries import edge_edge, rows, vertex_face

BASELINES = os.environ["ONSET_BASELINES"]
SCRIPTS = APPS / "bench" / "scripts"
DOCUMENT = APPS.parent / "docs" / "accuracy-and-speed.md"
MARKED = re.compile(r"<!-- measured: (\S+) -->\n(.*?)<!-- end -->", re.S)
TRUTH = "0x1p-1,0x1p-1\ninf,inf\n0x1p-2,0x1p-2\n"  # of moving from 1 to -1, from 1 to 1/4, from 1/2 to -3/2


class Plots(AppTest):
    def script(self, path, *arguments):
        done = subprocess.run([sys.executable, "-B", path, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder,
                              timeout=100)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def queries(self, folder):
        """data.csv and toi.csv of both kinds."""
        for kind, make in (("vertex-face", vertex_face), ("edge-edge", edge_edge)):
            (folder / kind).mkdir(parents=True)
            ends = [(1, -1, 1), (1, 0.25, 0), (0.5, -1.5, 1)]
            (folder / kind / "data.csv").write_text("".join(rows(make(x, y), hit) for x, y, hit in ends))
            (folder / kind / "toi.csv").write_text(TRUTH)
            yield folder / kind / "data.csv"

    def baselines(self, name, *arguments):
        done = subprocess.run([BASELINES, *map(str, arguments)], capture_output=True, text=True, check=True)
        (self.out / f"{name}.json").write_text(done.stdout)
        return json.loads(done.stdout)

    def ask_all(self, name, files):
        """What onset_baselines says, and ipctk saying the same: its wheel is for another test."""
        report = self.baselines(f"baselines-{name}", *files)
        peer = {"ipctk": "none", "every": 1, "checks": 1, "limit": 1, "call_us": 1.0, "files": []}
        for file in report["files"]:
            peer["files"].append({**file, "finders": [{**file["finders"][0], "name": "AdditiveCCD"}]})
        (self.out / f"ipctk-{name}.json").write_text(json.dumps(peer))

    def trades(self, names, files):
        """Of a soup where the name is a scene's, of queries where it is not."""
        faces, t0, t1 = random_soup(3, 40)
        a, b = self.write("a.obj", obj(t0, faces)), self.write("b.obj", obj(t1, faces))
        truth = self.write("truth.csv", "kind,a,b,toi_lo,toi_hi\n")
        quick = ["--repeats", "1", "--seconds", "0", "--json", "-"]
        scene = self.succeed("trade", a, b, "--truth", truth, *quick)
        queries = self.succeed("trade", "--queries", *files, *quick)
        for name in names:
            (self.out / f"trade-{name}.json").write_text(queries if name in ("handmade", "scene-pairs") else scene)

    def test_speed_against_accuracy(self):
        """Every mark of the document is filled, every plot that it shows is drawn."""
        self.out, docs = self.folder / "measured", self.folder / "docs"
        self.out.mkdir(), docs.mkdir()
        shutil.copy(DOCUMENT, docs)
        marks = dict(MARKED.findall(DOCUMENT.read_text()))
        (self.out / "load").write_text("0.5\n")
        files = list(self.queries(self.out / "handmade" / "some"))
        self.trades([mark.removeprefix("trade-") for mark in marks if mark.startswith("trade-")], files)
        for name in ("handmade", "scenes"):
            self.ask_all(name, files)
            for d in ("1e-2", "1e-8", "1e-16", "1e-30", "1e-100"):
                self.baselines(f"separation-{name}-{d}", "--separation", d, *files)
            for i in range(1, 9):
                self.baselines(f"tolerance-{name}-1e-{i}", "--tolerance", f"1e-{i}", *files)
        self.ask_all("stability", [f for what in ("scale", "offset") for x in ("1e0", "1e3")
                                   for f in self.queries(self.out / "stability" / what / x)])
        text = self.script(SCRIPTS / "report_trade.py", self.out, docs)
        self.assertIn("times of impact later than the exact ones", text)
        filled = (docs / DOCUMENT.name).read_text()
        self.assertEqual([mark for mark, _ in MARKED.findall(filled)], list(marks))
        for mark, part in MARKED.findall(filled):
            self.assertTrue(part.strip(), mark)
            self.assertNotEqual(part, marks[mark], mark)
        for image in re.findall(r"\]\((images/\S+)\)", filled):
            self.assertIn("</svg>", (docs / image).read_text(), image)

    def test_trade_of_a_simulation(self):
        """Short runs are measured, and the parts of the document that they are about are filled."""
        docs, trade, document = self.folder / "docs", APPS / "simulation" / "trade", APPS.parent / "docs" / "simulation-trade.md"
        docs.mkdir()
        shutil.copy(document, docs)
        self.script(trade / "measure.py", "out", "--cloth", os.environ["ONSET_CLOTH"], "--quick")
        text = self.script(trade / "report.py", "out", docs)
        self.assertRegex(text, r"3 runs at settings of Onset's own, 15 frames: 0 with intersections, 0 stalls, 0 runs that did not end")
        before, after = (dict(MARKED.findall((folder / document.name).read_text())) for folder in (document.parent, docs))
        self.assertEqual(list(after), list(before))
        changed = {mark for mark, part in after.items() if part != before[mark]}
        self.assertEqual(changed, {"summary", "promise", "peers", "cloth-sphere"})
        self.assertIn("| step | per vertex |", after["cloth-sphere"])
        self.assertIn("</svg>", (docs / "images" / "simulation-trade.svg").read_text())

    def test_frames_of_the_cloth(self):
        faces, t0, _ = random_soup(1, 20)
        (self.folder / "frame.ply").write_bytes(ply(t0, faces, "binary_little_endian", "double"))
        self.script(APPS / "simulation" / "render.py", "out.png", "frame.ply", "frame.ply", "--cloth", "10")
        self.assertEqual((self.folder / "out.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.script(APPS / "simulation" / "render.py", "out.gif", "frame.ply", "frame.ply", "--cloth", "10")
        self.assertEqual((self.folder / "out.gif").read_bytes()[:6], b"GIF89a")

    def test_gears(self):
        self.script(APPS / "simulation" / "draw_gears.py", "gears.png")
        self.assertEqual((self.folder / "gears.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_no_script_is_left_out(self):
        """A script that plots is one of those above."""
        plotting = {path.name for path in APPS.rglob("*.py") if "import matplotlib" in path.read_text()}
        self.assertEqual(plotting, {"plot_trade.py", "render.py", "draw_gears.py"})


if __name__ == "__main__":
    unittest.main()
