"""onset::edges(F) equals igl.edges(F) row for row: on random meshes, and on every scene of ONSET_DATA where it is set."""

import os
import pathlib
import subprocess
import sys

import igl
import numpy as np
import plyfile


def onset_edges(print_edges, faces):
    text = "\n".join(" ".join(map(str, face)) for face in faces.tolist())
    out = subprocess.run([print_edges], input=text, capture_output=True, text=True, check=True).stdout
    return np.array(out.split(), dtype=np.int64).reshape(-1, 2)


def compare(name, print_edges, faces):
    ours, theirs = onset_edges(print_edges, faces), np.asarray(igl.edges(faces))
    if ours.shape != theirs.shape or not (ours == theirs).all():
        where = 0
        if ours.shape == theirs.shape:
            where = int(np.argmax((ours != theirs).any(axis=1)))
        sys.exit(f"{name}: {len(ours)} edges, igl has {len(theirs)}; differ at row {where}: "
                 f"{ours[where:where + 1]} and {theirs[where:where + 1]}")
    print(f"{name}: {len(ours)} edges equal")


def random_mesh(random, vertices, faces):
    """Any triangles: non-manifold, of either orientation, with vertices that none uses; no vertex twice in a face."""
    F = random.integers(0, vertices, (8 * faces, 3))
    distinct = (F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])
    return F[distinct][:faces]


def read_faces(path):
    ply = plyfile.PlyData.read(path)
    return np.vstack(ply["face"].data["vertex_indices"]).astype(np.int64)


def main():
    print_edges = sys.argv[1]
    compare("one triangle", print_edges, np.array([[2, 0, 1]]))
    random = np.random.default_rng(20210501)
    for i in range(40):
        vertices = int(random.integers(3, 400))
        faces = random_mesh(random, vertices, int(random.integers(1, 800)))
        if len(faces) > 0:
            compare(f"random mesh {i}", print_edges, faces)

    if "ONSET_DATA" not in os.environ:
        print("skipped: the scenes of ONSET_DATA, which is not set")
        return
    frames = sorted(pathlib.Path(os.environ["ONSET_DATA"], "scenes").glob("*/frames/*.ply"))
    if not frames:
        sys.exit("ONSET_DATA is set, but has no scenes/*/frames/*.ply")
    for path in frames:
        compare(f"{path.parent.parent.name}/{path.name}", print_edges, read_faces(path))


main()
