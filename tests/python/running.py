"""What the tests of the command line share: runs of it, and made-up meshes."""

import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

# Of times alone two runs may differ, and of the program's name in a note.
TIMES = {"seconds", "seconds_contacts", "broad", "narrow", "total"}


def run(*words, cwd=None, env=None):
    return subprocess.run([sys.executable, "-m", "onset_ccd", *map(str, words)], capture_output=True, text=True, cwd=cwd,
                          env={**os.environ, **(env or {})}, timeout=300)


def result(*words, code=0, cwd=None):
    """The JSON of a command that ends with `code`."""
    done = run(*words, "--json", "-", cwd=cwd)
    assert done.returncode == code, done.stderr
    return json.loads(done.stdout)


def fails(*words, code=1, cwd=None):
    """The one line that a command that ends with `code` says."""
    done = run(*words, cwd=cwd)
    assert (done.returncode, done.stdout) == (code, ""), done.stdout + done.stderr
    assert done.stderr.startswith("onset_ccd: ") and done.stderr.count("\n") == 1, done.stderr
    return done.stderr[11:-1]


def native():
    """The native program; skips by name without it."""
    program = os.environ.get("ONSET_CLI")
    if not program:
        pytest.skip("ONSET_CLI, the native program onset, is not set")
    return program


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(entry) for key, entry in value.items() if key not in TIMES}
    if isinstance(value, list):
        return [without_times(entry) for entry in value]
    return value.replace("python -m onset_ccd check", "onset check") if isinstance(value, str) else value


def sheet(n, z, offset=0.0):
    """n x n vertices and quads."""
    side = np.linspace(0, 1, n)
    x, y = np.meshgrid(side, side, indexing="ij")
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    quads = np.column_stack([corner, corner + n, corner + n + 1, corner + 1])
    return np.column_stack([x.ravel() + offset, y.ravel() + offset / 2, np.full(n * n, z)]), quads


def two_sheets():
    """(x at the start, x at the end, quads): the upper one of 4 x 4 vertices falls through the lower one of 5 x 5."""
    low, quads_low = sheet(5, 0.0)
    high, quads_high = sheet(4, 0.5, 0.125)
    x = np.vstack([low, high])
    end = x.copy()
    end[25:, 2] -= 1
    return x, end, np.vstack([quads_low, quads_high + 25])


def triangles(quads):
    return np.stack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)


def write_obj(path, x, faces, more=""):
    lines = ["v " + " ".join(repr(float(c)) for c in row) for row in x] + ["f " + " ".join(str(v + 1) for v in face) for face in faces]
    pathlib.Path(path).write_text("\n".join(lines) + "\n" + more)


def bricks(n, offset):
    """Vertices and hexahedra of a cube of n^3."""
    ids = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    x = np.stack(np.meshgrid(*[np.linspace(0, 1, n + 1)] * 3, indexing="ij"), -1).reshape(-1, 3) + offset
    low = [ids[:-1, :-1, :-1], ids[1:, :-1, :-1], ids[1:, 1:, :-1], ids[:-1, 1:, :-1]]
    high = [ids[:-1, :-1, 1:], ids[1:, :-1, 1:], ids[1:, 1:, 1:], ids[:-1, 1:, 1:]]
    return x, np.stack([part.ravel() for part in low + high], axis=1)


def two_cubes():
    """(x at the start, x at the end, hexahedra): the upper cube falls into the lower one; in each 8 of 64 vertices are inside."""
    x0, h0 = bricks(3, np.zeros(3))
    x1, h1 = bricks(3, np.array([0.21, 0.17, 1.5]))
    x = np.vstack([x0, x1])
    end = x.copy()
    end[len(x0):, 2] -= 1
    return x, end, np.vstack([h0, h1 + len(x0)])


def tetrahedra(hexahedra):
    return np.concatenate([hexahedra[:, [0, a, b, 6]] for a, b in ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))])


def wedges(hexahedra):
    return np.concatenate([hexahedra[:, [0, 1, 2, 4, 5, 6]], hexahedra[:, [0, 2, 3, 4, 6, 7]]])
