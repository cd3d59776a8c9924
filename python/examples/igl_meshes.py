"""Meshes of libigl: read, refined and measured with igl, whose matrices are Onset's.

    python igl_meshes.py [MESH.obj|.ply|.off|.stl]

Without a file it makes one: a tetrahedron, refined by igl to a ball, which falls on a copy of itself.
"""

import os
import sys
import tempfile

import igl
import numpy as np
import onset_ccd


def ball_file(folder):
    """A ball of 4^5 triangles, written with igl."""
    x = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    x, faces = igl.upsample(x, faces, 4)
    path = os.path.join(folder, "ball.obj")
    igl.writeOBJ(path, x / np.linalg.norm(x, axis=1)[:, None], faces)
    return path


def same_edges(faces):
    """igl's edges and Onset's: the same rows in the same order, so that data on edges needs no renumbering."""
    theirs, ours = igl.edges(faces), onset_ccd.edges(faces)
    print(f"edges: igl {theirs.shape} {theirs.dtype}, onset_ccd {ours.shape} {ours.dtype}, equal: {np.array_equal(theirs, ours)}")
    return theirs, ours


def read(path):
    if path.lower().endswith(".obj"):
        x, _, _, faces, _, _ = igl.readOBJ(path)
        return x, faces
    return igl.read_triangle_mesh(path)


def main(path):
    x, faces = read(path)
    print(f"{path}: V {x.shape} {x.dtype}, F {faces.shape} {faces.dtype}")
    theirs, _ = same_edges(faces)

    # A copy above falls through the mesh. Positions and ids go in as igl has them, the edges too.
    height = np.ptp(x[:, 2])
    both = np.vstack([x, x + [0.1 * height, 0.05 * height, 1.2 * height]])
    end = both.copy()
    end[len(x):, 2] -= 2.4 * height
    mesh = onset_ccd.Mesh(both, np.vstack([faces, faces + len(x)]), np.vstack([theirs, theirs + len(x)]))
    step = onset_ccd.compute_collision_free_stepsize(mesh, both, end)
    print(f"step {step.step:.6f}: {step.outcome.name}, limited by {step.limiting}")

    # What comes back are numpy arrays that igl takes.
    moved = both + step.step * (end - both)
    contacts = onset_ccd.construct_active_set(mesh, both, end).contacts
    hit = np.unique(contacts["b"][contacts["kind"] == int(onset_ccd.PairKind.vertex_face)])
    area = igl.doublearea(moved, mesh.faces[hit]).sum() / 2
    print(f"{len(contacts)} contacts on the whole way, with {len(hit)} faces of area {area:.4f}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        main(sys.argv[1] if len(sys.argv) > 1 else ball_file(folder))
