"""Scenes, and where the recorded ones and the native command line are."""

import os
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

RECORDED = {"cloth-ball": (92, 93, "cloth_ball{}.ply"), "armadillo-rollers": (326, 327, "{}.ply"), "cloth-funnel": (227, 228, "{}.ply")}


class Scene:
    def __init__(self, x_t0, x_t1, faces):
        self.x_t0, self.x_t1, self.faces = x_t0, x_t1, faces


@pytest.fixture
def falling():
    """Two triangles over each other, 1 apart; the upper one falls by 2."""
    x_t0 = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0.5, 0.5, 1], [3, 0.5, 1.25], [0.5, 3, 1.5]])
    x_t1 = x_t0.copy()
    x_t1[3:, 2] -= 2
    return Scene(x_t0, x_t1, np.array([[0, 1, 2], [3, 4, 5]]))


def bits(records):
    """The bytes of all fields; what lies between the fields says nothing."""
    return b"".join(np.ascontiguousarray(records[name]).tobytes() for name in records.dtype.names)


def grid(n, z=0.0):
    """n x n vertices of a cloth."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    positions = np.column_stack([x.ravel(), y.ravel(), np.full(n * n, z)])
    a = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return positions, np.vstack([np.column_stack([a, a + n, a + 1]), np.column_stack([a + 1, a + n, a + n + 1])])


@pytest.fixture
def crumpled():
    """A cloth that crumples over another one: contacts of both kinds."""
    random = np.random.default_rng(11)
    (lower, f), (upper, g) = grid(9), grid(8, 0.2)
    x_t0 = np.vstack([lower, upper])
    x_t1 = x_t0 + random.uniform(-0.15, 0.15, x_t0.shape)
    x_t1[len(lower):, 2] -= 0.2
    return Scene(x_t0, x_t1, np.vstack([f, g + len(lower)]))


@pytest.fixture(params=RECORDED)
def recorded(request):
    """The files of one recorded step."""
    data = os.environ.get("ONSET_DATA")
    if not data:
        pytest.skip(f"ONSET_DATA is not set: {request.param}")
    first, second, name = RECORDED[request.param]
    frames = pathlib.Path(data) / "scenes" / request.param / "frames"
    return frames / name.format(first), frames / name.format(second)


@pytest.fixture
def command_line():
    """The native program."""
    program = os.environ.get("ONSET_CLI")
    if not program:
        pytest.skip("ONSET_CLI is not set")
    return program
