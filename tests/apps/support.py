"""Runs the command line, and writes meshes for it."""

import json
import os
import pathlib
import random
import resource
import struct
import subprocess
import tempfile
import unittest

BINARY = os.environ["ONSET_BINARY"]
APPS = pathlib.Path(__file__).resolve().parents[2] / "apps"


class AppTest(unittest.TestCase):
    """Each test in an empty folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_app(self, *arguments):
        command = [BINARY, *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, cwd=self.folder, timeout=500)

    def succeed(self, *arguments):
        """stdout of a run that must succeed, and say nothing on stderr, which is no terminal here, but notes about the
        files."""
        done = self.run_app(*arguments)
        others = [line for line in done.stderr.splitlines() if not line.startswith("note ")]
        self.assertEqual((done.returncode, others), (0, []), done.args)
        return done.stdout

    def json(self, *arguments):
        return json.loads(self.succeed(*arguments, "--json", "-"))

    def csv(self, *arguments):
        return self.succeed(*arguments, "--csv", "-")

    def must_fail(self, code, words, *arguments):
        """A run that must end with `code`, nothing on stdout and one line on stderr that has all of `words`."""
        done = self.run_app(*arguments)
        self.assertEqual((done.returncode, done.stdout), (code, ""), (done.args, done.stderr))
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.endswith("\n"), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def must_refuse(self, words, *arguments):
        """As must_fail, for bad input: with a second or two of computing, and 64 MiB of addresses, memory or not."""
        limits = [(resource.RLIMIT_AS, 64 << 20), (resource.RLIMIT_CPU, 2), (resource.RLIMIT_CORE, 0)]
        limit = lambda: [resource.setrlimit(which, (most, most)) for which, most in limits]
        done = subprocess.run([BINARY, *map(str, arguments)], capture_output=True, cwd=self.folder, timeout=60,
                              preexec_fn=limit)
        stderr = done.stderr.decode(errors="replace")
        self.assertEqual((done.returncode, done.stdout, stderr.count("\n")), (1, b"", 1), (done.args, stderr[-2000:]))
        self.assertLess(len(stderr), 2000)
        for word in words:
            self.assertIn(word, stderr)

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path


def as_float(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def obj(points, faces):
    rows = ["v %r %r %r" % tuple(p) for p in points]
    return "\n".join(rows + ["f " + " ".join(str(i + 1) for i in f) for f in faces]) + "\n"


def off(points, faces):
    rows = [f"OFF\n{len(points)} {len(faces)} 0"] + ["%r %r %r" % tuple(p) for p in points]
    return "\n".join(rows + [" ".join(map(str, [len(f), *f])) for f in faces]) + "\n"


def ply(points, faces, encoding="ascii", real="double"):
    """encoding: ascii, binary_little_endian or binary_big_endian; real: float or double."""
    header = (f"ply\nformat {encoding} 1.0\ncomment made for a test\nelement vertex {len(points)}\n"
              f"property {real} x\nproperty {real} y\nproperty {real} z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    if encoding == "ascii":
        rows = ["%r %r %r" % tuple(p) for p in points] + [" ".join(map(str, [len(f), *f])) for f in faces]
        return (header + "\n".join(rows) + "\n").encode()
    order = "<" if encoding == "binary_little_endian" else ">"
    body = b"".join(struct.pack(order + ("3f" if real == "float" else "3d"), *p) for p in points)
    body += b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in faces)
    return header.encode() + body


# A triangle in the plane z = 0 and one whose vertex 3 falls onto it from z = 1 at speed 2: it touches at t = 1/2, and
# nothing else does.
FACES = [(0, 1, 2), (3, 4, 5)]
START = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, 1), (1.5, 1, 3), (1, 1.5, 3)]
END = START[:3] + [(x, y, z - 2) for x, y, z in START[3:]]
APART = START[:3] + [(x, y, z + 2) for x, y, z in START[3:]]


def random_soup(seed, triangles, rounded=lambda x: x):
    """Faces and two frames of triangles that fly about in a cube: many contacts."""
    rng = random.Random(seed)
    near = lambda p, reach: [rounded(x + rng.uniform(-reach, reach)) for x in p]
    faces, t0, t1 = [], [], []
    for i in range(triangles):
        centre = near((0, 0, 0), 1)
        faces.append((3 * i, 3 * i + 1, 3 * i + 2))
        corners = [near(centre, 0.3) for _ in range(3)]
        t0 += corners
        t1 += [near(p, 0.2) for p in corners]
    return faces, t0, t1
