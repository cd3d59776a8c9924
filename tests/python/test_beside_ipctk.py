"""The same arrays given to ipctk: its steps are no later than ours, its contacts are among ours."""

import ipctk
import numpy as np
import pytest

import onset_ccd


def scenes():
    random = np.random.default_rng(5)
    for _ in range(40):
        x_t0 = random.uniform(-1, 1, (12, 3))
        x_t0[6:, 2] += 3
        x_t1 = x_t0 + random.uniform(-0.5, 0.5, x_t0.shape)
        x_t1[6:, 2] -= random.uniform(1, 4)
        yield x_t0, x_t1, np.array([[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11]])


@pytest.mark.parametrize("order", ["C", "F"])
def test_steps(order):
    limited = 0
    for x_t0, x_t1, faces in scenes():
        x_t0, x_t1 = np.array(x_t0, order=order), np.array(x_t1, order=order)
        mesh = onset_ccd.Mesh(x_t0, faces)
        if onset_ccd.has_intersections(mesh, x_t0):
            continue
        ours = onset_ccd.compute_collision_free_stepsize(mesh, x_t0, x_t1, exactness="exact")
        theirs = ipctk.compute_collision_free_stepsize(ipctk.CollisionMesh(x_t0, ipctk.edges(faces), faces), x_t0, x_t1)
        assert theirs <= ours.toi
        limited += ours.step < 1
    assert limited > 10


def test_edges_are_theirs():
    for _, _, faces in scenes():
        ours, theirs = onset_ccd.edges(faces), ipctk.edges(faces)
        assert {frozenset(e) for e in ours.tolist()} == {frozenset(e) for e in theirs.tolist()}
