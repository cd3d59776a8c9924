"""The examples run, and say what they should."""

import pathlib
import re
import subprocess
import sys

import matplotlib.image
import pytest

from onset_ccd import show
from onset_ccd.files.errors import InputError

EXAMPLES = pathlib.Path(__file__).parents[2] / "python" / "examples"


def example(name, *words, cwd):
    done = subprocess.run([sys.executable, EXAMPLES / name, *map(str, words)], cwd=cwd, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_cloth(tmp_path):
    text = example("cloth.py", "--vertices", 20, "--steps", 30, "--picture", "c.png", cwd=tmp_path)
    frames = re.findall(r"^frame (\d+): (\d+) Newton steps, 0 intersections, smallest gap (\S+)$", text, re.MULTILINE)
    assert len(frames) == 30 and text.splitlines()[-1].startswith("30 frames without an intersection in ")
    gaps = [float(gap) for _, _, gap in frames]
    assert gaps[0] > gaps[-1] > 0.001, "it has fallen on the ball, and lies on the barrier"
    picture = matplotlib.image.imread(tmp_path / "c.png")
    cloth = (picture[:, :, 0] > picture[:, :, 2] + 0.15).mean()
    assert 0.03 < cloth < 0.6


def test_cloth_is_short():
    assert len((EXAMPLES / "cloth.py").read_text().splitlines()) <= 150


@pytest.mark.parametrize("name", ["", "sheet.obj", "sheet.off"])
def test_igl_meshes(tmp_path, name):
    if name.endswith(".obj"):
        (tmp_path / name).write_text("v 0 0 0\nv 1 0 0.25\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n")
    if name.endswith(".off"):
        (tmp_path / name).write_text("OFF\n4 2 0\n0 0 0\n1 0 0.25\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3\n")
    text = example("igl_meshes.py", *[name] * bool(name), cwd=tmp_path)
    assert "equal: True" in text and re.search(r"^step 0\.\d+: contact, limited by Pair", text, re.MULTILINE)
    assert re.search(r"^\d+ contacts on the whole way, with [1-9]\d* faces of area", text, re.MULTILINE)


def test_picture(tmp_path):
    try:
        show.choose_window(True)
    except InputError as error:
        pytest.skip(str(error))
    assert re.fullmatch(r"p.png: [1-9]\d+ contacts, the first at t = 0.5\d+\n", example("picture.py", "p.png", cwd=tmp_path))
    assert matplotlib.image.imread(tmp_path / "p.png").shape[:2] == (960, 1280)


def test_from_ipctk(tmp_path):
    text = example("from_ipctk.py", 12, cwd=tmp_path)
    steps = re.search(r"steps: ipctk (\S+), onset_ccd (\S+);", text)
    assert float(steps.group(1)) == pytest.approx(float(steps.group(2)), abs=1e-2)
    theirs, ours, certain, both = map(int, re.search(r"contacts: ipctk (\d+), onset_ccd (\d+) \((\d+) of them certain\), (\d+) in both", text).groups())
    assert certain <= both <= ours and both <= theirs and ours > 50
