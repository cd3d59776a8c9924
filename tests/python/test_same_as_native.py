"""Steps and contacts are those of the native program, bit for bit."""

import csv
import io
import json
import math
import subprocess

import numpy as np
import plyfile
import pytest

import onset_ccd

KINDS = {"vf": onset_ccd.PairKind.vertex_face, "ee": onset_ccd.PairKind.edge_edge}
NUMBERS = {"toi": "toi", "toi_hi": "toi_hi", "step_limit": "step_limit", "gap": "gap", "speed": "speed"}


def read(path):
    file = plyfile.PlyData.read(path)
    x = np.column_stack([np.asarray(file["vertex"][axis], float) for axis in "xyz"])
    name = "vertex_indices" if "vertex_indices" in file["face"].data.dtype.names else "vertex_index"
    return x, np.vstack(file["face"][name])


def asked(command_line, *arguments):
    return subprocess.run([command_line, *map(str, arguments)], capture_output=True, text=True, check=True).stdout


def bits(x):
    return np.asarray(x, float).view(np.uint64)


def compare(command_line, first, second, *arguments, **options):
    (x_t0, faces), (x_t1, _) = read(first), read(second)
    mesh = onset_ccd.Mesh(x_t0, faces)
    # The program ends with 1 where there is a contact.
    done = subprocess.run([command_line, "step", first, second, "--json", "-", *arguments], capture_output=True, text=True)
    told, mine = json.loads(done.stdout), onset_ccd.compute_collision_free_stepsize(mesh, x_t0, x_t1, **options)
    assert bits(told["step"]) == bits(mine.step)
    assert bits(math.inf if told["toi"] is None else told["toi"]) == bits(mine.toi)
    assert (mine.limiting is None) == (told["limiting"] is None)
    if mine.limiting:
        assert (KINDS[told["limiting"]["kind"]], told["limiting"]["a"], told["limiting"]["b"]) == (
            mine.limiting.kind, mine.limiting.a, mine.limiting.b)

    done = subprocess.run([command_line, "active-set", first, second, "--csv", "-", *arguments], capture_output=True, text=True)
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    contacts = onset_ccd.construct_active_set(mesh, x_t0, x_t1, **options).contacts
    assert len(rows) == len(contacts)
    assert [KINDS[row["kind"]] for row in rows] == list(contacts["kind"])
    for name in ("a", "b", "degenerate"):
        assert [int(row[name]) for row in rows] == list(contacts[name].astype(int)), name
    for name, field in NUMBERS.items():
        assert np.array_equal(bits([float(row[name]) for row in rows]), bits(contacts[field])), name
    for field, names in {"weights": ("w0", "w1", "w2", "w3"), "normal": ("nx", "ny", "nz")}.items():
        assert np.array_equal(bits([[float(row[n]) for n in names] for row in rows]), bits(contacts[field])), field
    return len(rows)


@pytest.mark.parametrize("exactness", ["conservative", "certify", "exact"])
def test_recorded_steps(command_line, recorded, exactness):
    assert compare(command_line, *recorded, "--certainty", exactness, exactness=exactness) > 100


def test_made_up_steps(command_line, crumpled, tmp_path):
    ends = []
    for name, x in (("a", crumpled.x_t0), ("b", crumpled.x_t1)):
        vertices = np.array([tuple(v) for v in x], dtype=[("x", "f8"), ("y", "f8"), ("z", "f8")])
        faces = np.array([(f,) for f in crumpled.faces.astype("i4")], dtype=[("vertex_indices", "i4", (3,))])
        plyfile.PlyData([plyfile.PlyElement.describe(vertices, "vertex"), plyfile.PlyElement.describe(faces, "face")]).write(
            tmp_path / f"{name}.ply")
        ends.append(tmp_path / f"{name}.ply")
    assert compare(command_line, *ends) > 10
    assert compare(command_line, *ends, "--min-separation", "0.01", min_separation=0.01) > 10
