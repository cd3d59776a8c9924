"""The cloth simulator: steps that go on, frames without intersections, the same frames for any number of threads."""

import json
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import time
import unittest

BINARY = os.environ["ONSET_CLOTH"]


def header_and_size(path):
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    return header.decode(), len(body)


class Cloth(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_app(self, *arguments):
        return subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder,
                              timeout=500)

    def steps(self, scene, *arguments):
        done = self.run_app("--scene", scene, "--json", "steps.json", "--check", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        return done.stdout, [json.loads(line) for line in (self.folder / "steps.json").read_text().splitlines()]

    def check_steps(self, text, steps, count):
        self.assertEqual([s["step"] for s in steps], list(range(1, count + 1)))
        self.assertIn(f"in 0 of {count + 1} frames", text)
        for s in steps:
            self.assertGreater(s["smallest_step"], 0)
            self.assertLessEqual(s["toi"], 1)
            self.assertGreater(s["closest"], 0)
            self.assertGreater(s["iterations"], 0)
            self.assertLessEqual(s["seconds_collision"], s["seconds"])
            self.assertLess(s["behind"], 1e-12)  # rounding

    def test_sphere(self):
        text, steps = self.steps("sphere", "--triangles", 200, "--steps", 12)
        self.check_steps(text, steps, 12)
        self.assertGreater(steps[-1]["contacts"], 0)

    def test_pile(self):
        text, steps = self.steps("pile", "--triangles", 200, "--steps", 20)
        self.check_steps(text, steps, 20)
        self.assertGreater(steps[-1]["contacts"], 0)
        self.assertLess(min(s["toi"] for s in steps), 1)  # the filter had something to do

    def test_ground(self):
        text, steps = self.steps("ground", "--triangles", 200, "--steps", 40)
        self.check_steps(text, steps, 40)
        self.assertGreater(steps[-1]["contacts"], 0)

    def test_twist(self):
        text, steps = self.steps("twist", "--triangles", 200, "--steps", 10)
        self.check_steps(text, steps, 10)

    def test_frames_are_the_same_for_any_number_of_threads(self):
        for threads in (1, 2):
            done = self.run_app("--scene", "sphere", "--triangles", 200, "--steps", 8, "--threads", threads, "--out",
                                f"out{threads}")
            self.assertEqual(done.returncode, 0, done.stderr)
        names = sorted(p.name for p in (self.folder / "out1").iterdir())
        self.assertEqual(names, [f"frame_{i:04d}.ply" for i in range(9)])
        for name in names:
            self.assertEqual((self.folder / "out1" / name).read_bytes(), (self.folder / "out2" / name).read_bytes())
        header, size = header_and_size(self.folder / "out1" / names[-1])
        counts = {line.split()[1]: int(line.split()[2]) for line in header.splitlines() if line.startswith("element")}
        self.assertEqual(size, 24 * counts["vertex"] + 13 * counts["face"])

    def test_what_was_there_is_kept_until_the_end(self):
        """A run that is interrupted, or meets a full disk, leaves the old lines, whole frames, and nothing beside them."""
        (self.folder / "steps.json").write_text("old")
        (self.folder / "out").mkdir()
        long = ["--steps", "100000", "--triangles", "200", "--json", "steps.json", "--out", "out"]
        run = subprocess.Popen([BINARY, *long], cwd=self.folder, stderr=subprocess.PIPE)
        deadline = time.monotonic() + 60
        while not (self.folder / "out" / "frame_0003.ply").exists():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        self.assertEqual((run.communicate(timeout=60)[1], run.returncode), (b"", -signal.SIGINT))
        self.assertEqual((self.folder / "steps.json").read_text(), "old")
        self.assertEqual(sorted(os.listdir(self.folder)), ["out", "steps.json"])
        frames = list((self.folder / "out").iterdir())
        self.assertEqual({p.name[:6] for p in frames}, {"frame_"})
        self.assertEqual(len({p.stat().st_size for p in frames}), 1)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        done = subprocess.run([BINARY, *long], cwd=self.folder, capture_output=True, text=True, timeout=60, preexec_fn=limit)
        self.assertEqual(done.returncode, 1)
        self.assertIn("frame_0000.ply: cannot be written: File too large", done.stderr)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()), sorted(p.name for p in frames))
        for path in ["gone/steps.json", "out"]:
            done = self.run_app("--steps", 1, "--triangles", 100, "--json", path)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(path, done.stderr)

    def test_numbers(self):
        for option, values in [("--friction", ["nan", "inf", "-1", "1x", ""]), ("--time-step", ["nan", "inf", "0", "-1", "1x", ""]),
                               ("--seed", ["", "-1", "1.5", "x"]), ("--steps", ["", "-1", "1e3", "99999999999999999999"]),
                               ("--threads", ["", "-1", "nan"]), ("--triangles", ["", "-1", "41x"])]:
            for value in values:
                done = self.run_app("--steps", 1, "--triangles", 100, option, value)
                self.assertGreater(done.returncode, 100, done.args)
                self.assertIn(option, done.stderr)

    def test_bad_usage(self):
        self.assertNotEqual(self.run_app("--scene", "none").returncode, 0)
        done = self.run_app("--steps", 1, "--triangles", 100, "--out", "/dev/null/frames")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
