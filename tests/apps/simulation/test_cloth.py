"""The cloth simulator: steps that go on, frames without intersections, the same frames for any number of threads and any
kernel, a restart that goes on to them, and other programs in the library's place."""

import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from kernels import kernels

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

    def run_app(self, *arguments, **environment):
        return subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, timeout=500,
                              env={**os.environ, **environment})

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
            self.assertEqual(s["stalls"], 0)
            self.assertLessEqual(s["seconds_assembly"] + s["seconds_solve"] + s["seconds_collision"], s["seconds"])
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

    def frames(self, folder):
        return {p.name: p.read_bytes() for p in (self.folder / folder).iterdir()}

    def test_frames_are_the_same_for_any_number_of_threads_and_any_kernel(self):
        ways = [(1, kernel) for kernel in kernels()] + [(2, kernels()[-1])]
        for scene in ("sphere", "pile"):
            seen = []
            for threads, kernel in ways:
                out = f"{scene}{threads}{kernel}"
                done = self.run_app("--scene", scene, "--triangles", 200, "--steps", 8, "--threads", threads, "--out", out,
                                    ONSET_KERNEL=kernel)
                self.assertEqual(done.returncode, 0, done.stderr)
                seen.append(self.frames(out))
            names = [f"frame_{i:04d}.{kind}" for i in range(9) for kind in ("ply", "vtu")]
            self.assertEqual(sorted(seen[0]), [*names, "series.pvd"])
            for other in seen[1:]:
                self.assertEqual(seen[0], other)
        header, size = header_and_size(self.folder / "sphere1scalar" / "frame_0008.ply")
        counts = {line.split()[1]: int(line.split()[2]) for line in header.splitlines() if line.startswith("element")}
        self.assertEqual(size, 24 * counts["vertex"] + 13 * counts["face"])

    def test_a_restart_goes_on_to_the_same_bytes(self):
        for scene in ("sphere", "twist", "pile"):
            same = ["--scene", scene, "--triangles", 200, "--steps", 14]
            self.assertEqual(self.run_app(*same, "--out", scene).returncode, 0)
            whole = self.frames(scene)
            for step in range(10, 15):
                for kind in ("ply", "vtu"):
                    (self.folder / scene / f"frame_{step:04d}.{kind}").unlink()
            done = self.run_app(*same, "--out", scene, "--restart", f"{scene}/frame_0009.vtu")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("steps            5, ", done.stdout)
            self.assertEqual(self.frames(scene), whole)

    def test_a_frame_of_another_scene_is_refused(self):
        self.assertEqual(self.run_app("--triangles", 200, "--steps", 1, "--out", "out").returncode, 0)
        (self.folder / "other.vtu").write_text("hello")
        for name, triangles in [("other.vtu", 200), ("out/frame_0001.vtu", 400)]:
            done = self.run_app("--triangles", triangles, "--steps", 2, "--restart", name)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(name, done.stderr)

    def test_every_setting_keeps_all_frames_free(self):
        for setting in (["--relative-tolerance", "1e-1"], ["--relative-tolerance", "1e-8"], ["--certainty", "exact"],
                        ["--certainty", "conservative"], ["--narrow-phase", "inclusion"], ["--gap-share", 0.8], ["--gap-share", 0],
                        ["--per-vertex"], ["--reach", 0.3]):
            text, steps = self.steps("pile", "--triangles", 200, "--steps", 18, *setting)
            self.check_steps(text, steps, 18)
            self.assertGreater(steps[-1]["contacts"], 0, setting)

    def server(self, answer):
        """A program that answers every question with the same step."""
        path = self.folder / "server.py"
        path.write_text("import struct, sys\n"
                        "stdin, stdout = sys.stdin.buffer, sys.stdout.buffer\n"
                        "v, e, f = struct.unpack('<3q', stdin.read(24))\n"
                        "stdin.read(24 * v + 8 * e + 12 * f)\n"
                        "while len(stdin.read(48 * v)) == 48 * v:\n"
                        f"    stdout.write({answer})\n"
                        "    stdout.flush()\n")
        return f"'{sys.executable}' '{path}'"

    def with_server(self, answer, *more, scene="pile", steps=20):
        return self.run_app("--scene", scene, "--triangles", 200, "--steps", steps, "--json", "steps.json", "--check",
                            "--collision-server", self.server(answer), *more)

    def test_what_a_collision_server_lets_through_is_found(self):
        done = self.with_server("struct.pack('<2di', 1, 0.25, 0)", "--reach", 0.01)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertRegex(done.stdout, r"intersections    in [1-9]\d* of 21 frames\n +first in step \d+: faces \d+ and \d+\n")
        steps = [json.loads(line) for line in (self.folder / "steps.json").read_text().splitlines()]
        for s in steps:  # its own seconds count
            self.assertGreaterEqual(s["seconds_collision"], 0.25 * s["iterations"])
            self.assertGreaterEqual(s["seconds"], s["seconds_collision"])

    def test_where_a_collision_server_stalls_is_named(self):
        done = self.with_server("struct.pack('<2di', 0, 0, 6) + b'ee 7 8'", steps=2)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("stalls           80, first in step 1: ee 7 8\n", done.stdout)

    def test_a_collision_server_that_fails_is_an_error(self):
        for answer, words in [("struct.pack('<2di', 1.5, 0, 0)", "no step"), ("struct.pack('<2di', float('nan'), 0, 0)", "no step"),
                              ("struct.pack('<2di', 1, 0, 1 << 30)", "no step"), ("struct.pack('<d', 1)); stdout.flush(); sys.exit(0", "ended")]:
            done = self.with_server(answer, steps=1)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(words, done.stderr)
        done = self.run_app("--triangles", 100, "--steps", 1, "--collision-server", "/nowhere/at-all")
        self.assertEqual((done.returncode, "ended" in done.stderr), (1, True), done.stderr)
        done = self.with_server("b''", scene="ground")
        self.assertEqual((done.returncode, "planes" in done.stderr), (1, True), done.stderr)

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
        self.assertEqual({p.name[:6] for p in frames}, {"frame_", "series"})
        self.assertEqual(len({p.stat().st_size for p in frames if p.suffix == ".ply"}), 1)
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
                               ("--threads", ["", "-1", "nan"]), ("--triangles", ["", "-1", "41x"]), ("--gap-share", ["1", "-0.1", "nan"]),
                               ("--relative-tolerance", ["0", "nan"]), ("--reach", ["0", "inf"]), ("--certainty", ["sure"])]:
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
