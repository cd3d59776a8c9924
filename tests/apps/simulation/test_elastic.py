"""The simulator of elastic bodies: every scene with both contact methods, frames without intersections, the same
frames for any number of threads and any kernel, and a restart that goes on to them."""

import json
import os
import pathlib
import signal
import struct
import subprocess
import tempfile
import time
import unittest

from kernels import kernels

BINARY = os.environ["ONSET_ELASTIC"]
METHODS = ["barrier", "active-set"]

BOX_2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 0.2 0 0
3 0 0.2 0
4 0 0 0.2
9 7 7 7
$EndNodes
$Elements
3
1 15 2 0 1 1
2 2 2 0 1 1 2 3
3 4 2 0 1 1 3 2 4
$EndElements
"""

BOX_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Nodes
2 5 1 9
0 1 0 1
9
7 7 7
3 1 0 4
1
2
3
4
0 0 0
0.2 0 0
0 0.2 0
0 0 0.2
$EndNodes
$Elements
2 2 1 3
2 1 2 1
2 1 2 3
3 1 4 1
3 1 3 2 4
$EndElements
"""


def frame_points(path):
    """Of a .vtu as onset_elastic writes it."""
    head, body = path.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
    count, = struct.unpack("<Q", body[:8])
    return head, list(struct.iter_unpack("<3d", body[8:8 + count]))


class Elastic(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_app(self, *arguments, **environment):
        return subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, timeout=500,
                              env={**os.environ, **environment})

    def steps(self, scene, method, count, *arguments):
        done = self.run_app("--scene", scene, "--contact", method, "--steps", count, "--json", "steps.json", "--check", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        steps = [json.loads(line) for line in (self.folder / "steps.json").read_text().splitlines()]
        self.assertEqual([s["step"] for s in steps], list(range(1, count + 1)))
        self.assertIn(f"in 0 of {count + 1} frames", done.stdout)
        for s in steps:
            self.assertGreater(s["smallest_step"], 0)
            self.assertLessEqual(s["toi"], 1)
            self.assertGreater(s["closest"], 0)
            self.assertGreater(s["iterations"], 0)
            self.assertLess(s["behind"], 1e-12)  # rounding
            self.assertLessEqual(s["seconds_assembly"] + s["seconds_solve"] + s["seconds_collision"], s["seconds"])
        return steps

    def test_torus(self):
        for method in METHODS:
            steps = self.steps("torus", method, 25, "--tetrahedra", 400)
            self.assertTrue(all(s["converged"] for s in steps), method)
            self.assertGreater(steps[-1]["contacts"], 0)
            self.assertEqual(steps[-1]["constraints"] > 0, method == "active-set")
            self.assertLess(steps[-1]["height"], 0.45)  # it fell ...
            self.assertGreater(steps[-1]["height"], 0.2)  # ... and the cone holds it
            self.assertGreater(min(s["least_volume"] for s in steps), 0)

    def test_both_methods_come_to_the_same_height(self):
        """Both see the same bodies, to about the separation that they keep."""
        heights = [self.steps("torus", method, 60, "--tetrahedra", 200, "--friction", 0)[-1]["height"] for method in METHODS]
        self.assertLess(max(heights) - min(heights), 0.01 * min(heights))

    def test_bars(self):
        for method in METHODS:
            steps = self.steps("bars", method, 18, "--tetrahedra", 300, "--time-step", 0.02)
            self.assertGreater(steps[-1]["contacts"], 0, method)
            self.assertGreater(steps[-1]["energy"], steps[0]["energy"])

    def test_pile(self):
        for method in METHODS:
            steps = self.steps("pile", method, 16, "--tetrahedra", 400)
            self.assertGreater(steps[-1]["contacts"], 0, method)

    def test_a_mesh_of_gmsh(self):
        drops = {}
        for name, text in [("box2.msh", BOX_2), ("box4.msh", BOX_4)]:
            (self.folder / name).write_text(text)
            for method in METHODS:
                self.steps("drop", method, 30, "--mesh", name, "--out", "out")
                head, points = frame_points(self.folder / "out" / "frame_0030.vtu")
                self.assertIn(b'NumberOfPoints="4" NumberOfCells="1"', head)
                self.assertGreater(min(p[2] for p in points), 0)
                self.assertLess(min(p[2] for p in points), 0.003)  # on the ground
                drops.setdefault(method, []).append(points)
        for two, four in drops.values():
            self.assertEqual(two, four)

    def test_what_is_wrong_with_a_mesh_is_named(self):
        for text, line, words in [("", None, "no tetrahedra"), (BOX_2.replace("2.2 0 8", "3.0 0 8"), 2, "3.0"),
                                  (BOX_2.replace("2.2 0 8", "2.2 1 8"), 2, "ascii"), (BOX_2.replace("1 3 2 4", "1 3 2 5"), 16, "node 5"),
                                  (BOX_2.replace("1 3 2 4", "1 3 2 2"), 16, "volume"), (BOX_2.replace("1 0 0 0", "1 0 nan 0"), 6, "nan"),
                                  (BOX_2[:BOX_2.index("9 7 7")], None, "too early"), (BOX_2.replace("9 7 7 7", "4 7 7 7"), 10, "twice"),
                                  (BOX_4.replace("3 1 4 1", "3 1 4 2"), 25, "5 numbers"), (BOX_2[BOX_2.index("$Nodes"):], 1, "MeshFormat")]:
            (self.folder / "bad.msh").write_text(text)
            done = self.run_app("--scene", "drop", "--mesh", "bad.msh", "--steps", 1)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn("bad.msh", done.stderr)
            self.assertIn(words, done.stderr)
            if line is not None:
                self.assertIn(f":{line}", done.stderr)
        done = self.run_app("--scene", "drop", "--steps", 1)
        self.assertEqual((done.returncode, "--mesh" in done.stderr), (1, True))

    def frames(self, folder):
        return {p.name: p.read_bytes() for p in (self.folder / folder).iterdir()}

    def test_frames_are_the_same_for_any_number_of_threads_and_any_kernel(self):
        ways = [(1, kernel) for kernel in kernels()] + [(2, kernels()[-1])]
        for scene, steps in [("torus", 20), ("pile", 14)]:
            for method in METHODS:
                seen = []
                for threads, kernel in ways:
                    out = f"{scene}{method}{threads}{kernel}"
                    done = self.run_app("--scene", scene, "--contact", method, "--tetrahedra", 300, "--steps", steps,
                                        "--threads", threads, "--out", out, ONSET_KERNEL=kernel)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    seen.append(self.frames(out))
                self.assertEqual(len(seen[0]), 2 * (steps + 1) + 1)
                for other in seen[1:]:
                    self.assertEqual(seen[0], other)

    def test_a_restart_goes_on_to_the_same_bytes(self):
        for scene in ("torus", "bars"):
            for method in METHODS:
                same = ["--scene", scene, "--contact", method, "--tetrahedra", 300, "--steps", 22]
                self.assertEqual(self.run_app(*same, "--out", "whole").returncode, 0)
                whole = self.frames("whole")
                for step in range(12, 23):
                    for kind in ("ply", "vtu"):
                        (self.folder / "whole" / f"frame_{step:04d}.{kind}").unlink()
                done = self.run_app(*same, "--out", "whole", "--restart", "whole/frame_0011.vtu")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("11, ", done.stdout)
                self.assertEqual(self.frames("whole"), whole)

    def test_a_frame_of_another_scene_is_refused(self):
        self.assertEqual(self.run_app("--scene", "bars", "--tetrahedra", 300, "--steps", 1, "--out", "out").returncode, 0)
        frame = (self.folder / "out" / "frame_0001.vtu").read_bytes()
        (self.folder / "cut.vtu").write_bytes(frame[:-100])
        (self.folder / "other.vtu").write_text("hello")
        for name, scene in [("cut.vtu", "bars"), ("other.vtu", "bars"), ("out/frame_0001.vtu", "torus")]:
            done = self.run_app("--scene", scene, "--tetrahedra", 300, "--steps", 2, "--restart", name)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(name, done.stderr)

    def test_an_interrupted_run_leaves_whole_frames(self):
        (self.folder / "steps.json").write_text("old")
        run = subprocess.Popen([BINARY, "--steps", "100000", "--tetrahedra", "200", "--json", "steps.json", "--out", "out"],
                               cwd=self.folder, stderr=subprocess.PIPE)
        deadline = time.monotonic() + 60
        while not (self.folder / "out" / "frame_0003.vtu").exists():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        self.assertEqual((run.communicate(timeout=60)[1], run.returncode), (b"", -signal.SIGINT))
        self.assertEqual((self.folder / "steps.json").read_text(), "old")
        frames = list((self.folder / "out").glob("frame_*.vtu"))
        self.assertEqual(len({p.stat().st_size for p in frames}), 1)
        self.assertEqual({p.name[:6] for p in (self.folder / "out").iterdir()}, {"frame_", "series"})

    def test_numbers(self):
        for option, values in [("--friction", ["nan", "-1", "1x", ""]), ("--time-step", ["nan", "inf", "0", "-1"]),
                               ("--separation", ["0", "nan"]), ("--young", ["0", "-1", "inf"]), ("--steps", ["", "-1", "1e3"]),
                               ("--threads", ["", "-1"]), ("--tetrahedra", ["", "-1", "41x"]), ("--contact", ["springs"])]:
            for value in values:
                done = self.run_app("--steps", 1, "--tetrahedra", 100, option, value)
                self.assertGreater(done.returncode, 100, done.args)
                self.assertIn(option, done.stderr)


if __name__ == "__main__":
    unittest.main()
