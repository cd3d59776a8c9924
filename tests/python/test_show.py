"""Pictures: what must be seen on them is looked for among their colours."""

import io
import os
import subprocess
import sys

import matplotlib.image
import numpy as np
import pytest

import onset_ccd
from onset_ccd import show
from onset_ccd.files.errors import InputError
from running import fails, run, two_sheets, triangles, write_obj

try:
    show.choose_window(True)
    NOT_HERE = ""
except InputError as error:
    NOT_HERE = str(error)
needs_gl = pytest.mark.skipif(bool(NOT_HERE), reason=NOT_HERE or "drawing works")


def pixels(image):
    """width x height x 3, 0 to 255."""
    return np.rint(255 * matplotlib.image.imread(io.BytesIO(image))[:, :, :3]).astype(int)


def reddish(p):
    return int(((p[:, :, 0] > 170) & (p[:, :, 1] < 90) & (p[:, :, 2] < 90)).sum())


def yellowish(p):
    return int(((p[:, :, 0] > 150) & (p[:, :, 1] > 100) & (p[:, :, 2] < 70)).sum())


def coloured(p):
    return int((p.max(axis=2) - p.min(axis=2) > 60).sum())


@pytest.fixture
def scene():
    x, end, quads = two_sheets()
    return onset_ccd.Mesh(x, triangles(quads)), x, end


@needs_gl
def test_a_picture_of_a_step(tmp_path, scene):
    _, x, end = scene
    write_obj(tmp_path / "a.obj", x, two_sheets()[2])
    write_obj(tmp_path / "b.obj", end, two_sheets()[2])
    done = run("step", "a.obj", "b.obj", "--screenshot", "s.png", cwd=tmp_path, env={"DISPLAY": ""})
    assert (done.returncode, done.stderr) == (0, "")
    p = pixels((tmp_path / "s.png").read_bytes())
    assert p.shape == (960, 1280, 3)
    assert reddish(p) > 1000, "the limiting pair and its label"
    away = run("step", "a.obj", "a.obj", "--screenshot", "s.png", cwd=tmp_path)
    assert away.returncode == 0 and reddish(pixels((tmp_path / "s.png").read_bytes())) == 0, "nothing limits this step"


@needs_gl
def test_contacts_have_colours(scene):
    mesh, x, end = scene
    found = onset_ccd.construct_active_set(mesh, x, end)
    p = pixels(show.png(lambda plotter: show.draw_active_set(plotter, mesh, x, end, found)))
    none = onset_ccd.construct_active_set(mesh, x, x)
    empty = pixels(show.png(lambda plotter: show.draw_active_set(plotter, mesh, x, x, none)))
    assert coloured(p) > 50000 and coloured(empty) < 5000


@needs_gl
def test_intersections_have_colours(scene):
    mesh, x, end = scene
    x = x.copy()
    x[25:, 2] = x[25:, 0] - 0.6
    report = onset_ccd.check(mesh, x)
    assert len(report.intersections)
    p = pixels(show.png(lambda plotter: show.draw_start(plotter, mesh, x, report)))
    assert reddish(p) > 500 and yellowish(p) > 5000


@needs_gl
@pytest.mark.parametrize("kind", ["plane", "points", "2D", "NaN", "large"])
def test_other_scenes_are_drawn(kind):
    x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, 1], [0.3, 0.2, 1], [0.2, 0.25, 2.0]])
    end = x.copy()
    end[3:, 2] = -1
    mesh = onset_ccd.Mesh(x, [[0, 1, 2]], [[0, 1], [0, 2], [1, 2], [3, 4]])
    rules = mesh.rules
    rules.points = [5]
    if kind == "plane":
        rules.planes = [onset_ccd.Plane([0, 0, 1], -0.5)]
    mesh.rules = rules
    if kind == "2D":
        mesh, x, end = onset_ccd.Mesh(6, None, [[0, 1], [3, 4]], None, 2), x[:, :2], end[:, :2]
    if kind == "NaN":
        end[3, 0] = np.nan
    if kind == "large":
        x, end = x * 1e12, end * 1e12
    step = onset_ccd.compute_collision_free_stepsize(mesh, x, end)
    found = onset_ccd.construct_active_set(mesh, x, end)
    for draw in (lambda plotter: show.draw_step(plotter, mesh, x, end, step),
                 lambda plotter: show.draw_active_set(plotter, mesh, x, end, found),
                 lambda plotter: show.draw_start(plotter, mesh, x, onset_ccd.check(mesh, x))):
        p = pixels(show.png(draw))
        assert (p < 250).any(axis=2).sum() > 500


def test_faces_have_the_earliest_time_of_their_parts(scene):
    mesh, x, end = scene
    contacts = onset_ccd.construct_active_set(mesh, x, end).contacts
    faces, times = show.touched_faces(mesh, contacts)
    edge_ids = {tuple(sorted(edge)): i for i, edge in enumerate(mesh.edges.tolist())}
    expected = {}
    for face, corners in enumerate(mesh.faces.tolist()):
        edges = {edge_ids[tuple(sorted((corners[i], corners[i - 1])))] for i in range(3)}
        mine = [c["toi"] for c in contacts if (c["kind"] == 0 and (c["b"] == face or c["a"] in corners)) or
                (c["kind"] == 1 and (c["a"] in edges or c["b"] in edges))]
        if mine:
            expected[face] = min(mine)
    assert dict(zip(faces.tolist(), times.tolist())) == expected


def test_what_is_missing_is_named(tmp_path):
    write_obj(tmp_path / "a.obj", *two_sheets()[::2])
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        assert "--show needs a display (DISPLAY is not set): --screenshot FILE.png draws without one" in fails(
            "step", "a.obj", "a.obj", "--show", cwd=tmp_path)
    code = "import sys; sys.modules['pyvista'] = None; from onset_ccd.__main__ import main; sys.exit(main(sys.argv[1:]))"
    done = subprocess.run([sys.executable, "-c", code, "step", "a.obj", "a.obj", "--screenshot", "x.png"], cwd=tmp_path, capture_output=True,
                          text=True)
    assert done.returncode == 1
    assert done.stderr in ("onset_ccd: a picture needs pyvista, which is not installed: pip install pyvista, or 'onset-ccd[show]'\n",
                           f"onset_ccd: {NOT_HERE}\n")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="of Linux's graphics libraries")
def test_without_a_driver_the_packages_are_named(tmp_path):
    """VTK would end the process."""
    write_obj(tmp_path / "a.obj", *two_sheets()[::2])
    done = run("step", "a.obj", "a.obj", "--screenshot", "x.png", cwd=tmp_path,
               env={"LIBGL_DRIVERS_PATH": "/nonexistent", "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"})
    if done.returncode != 0:
        assert done.returncode == 1 and "apt-get install libegl1 libgl1-mesa-dri" in done.stderr
        assert not (tmp_path / "x.png").exists()
