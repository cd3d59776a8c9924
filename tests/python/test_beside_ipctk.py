"""The same arrays given to ipctk: its steps are no later than ours, its contacts are among ours."""

import ipctk
import numpy as np
import pytest

import onset_ccd
from onset_ccd import ipc_toolkit


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


def plugged(mesh, x_t0, x_t1, broad, narrow, distance=0.0):
    candidates = ipctk.Candidates()
    candidates.build(mesh, x_t0, x_t1, 1e-3, broad)
    return len(candidates), candidates.compute_collision_free_stepsize(mesh, x_t0, x_t1, distance, narrow)


@pytest.fixture
def one_thread():
    threads = ipctk.get_num_threads()
    ipctk.set_num_threads(1)
    yield
    ipctk.set_num_threads(threads)


def test_a_narrow_phase_in_python_needs_one_thread(one_thread):
    ipctk.set_num_threads(2)
    with pytest.raises(RuntimeError, match="set_num_threads"):
        ipc_toolkit.NarrowPhaseCCD()


def test_onset_plugged_into_ipctk(one_thread):
    limited = 0
    for x_t0, x_t1, faces in scenes():
        native = onset_ccd.Mesh(x_t0, faces)
        if onset_ccd.has_intersections(native, x_t0):
            continue
        mesh = ipctk.CollisionMesh(x_t0, ipctk.edges(faces), faces)
        ours = plugged(mesh, x_t0, x_t1, ipc_toolkit.BroadPhase(), ipc_toolkit.NarrowPhaseCCD())
        theirs = plugged(mesh, x_t0, x_t1, ipctk.BruteForce(), ipctk.TightInclusionCCD())
        exact = onset_ccd.compute_collision_free_stepsize(native, x_t0, x_t1, exactness="exact")
        assert ours[0] == theirs[0] and 0 < ours[1] <= exact.toi
        kept = onset_ccd.LineSearch(native, x_t0, x_t1 - x_t0, tolerance=1e-6).largest_step().step
        assert abs(ours[1] - kept) < 1e-6
        limited += ours[1] < 1
    assert limited > 10


def test_a_filter_and_two_dimensions_plugged_into_ipctk(one_thread):
    x_t0, x_t1, faces = next(scenes())
    mesh = ipctk.CollisionMesh(x_t0, ipctk.edges(faces), faces)
    mesh.can_collide = ipctk.make_sparse_filter({(v, w): False for v in range(6) for w in (7, 8)}, True)
    assert plugged(mesh, x_t0, x_t1, ipc_toolkit.BroadPhase(), ipc_toolkit.NarrowPhaseCCD())[0] == plugged(
        mesh, x_t0, x_t1, ipctk.BruteForce(), ipctk.TightInclusionCCD())[0]
    flat_t0, edges = np.array([[0.0, 0], [1, 0], [0.25, 1], [0.75, 1]]), np.array([[0, 1], [2, 3]])
    flat_t1 = flat_t0 - [[0, 0], [0, 0], [0, 2], [0, 2]]
    flat = ipctk.CollisionMesh(flat_t0, edges, np.zeros((0, 3), int))
    count, step = plugged(flat, flat_t0, flat_t1, ipc_toolkit.BroadPhase(), ipc_toolkit.NarrowPhaseCCD(conservative_rescaling=0.5))
    assert count == plugged(flat, flat_t0, flat_t1, ipctk.BruteForce(), ipctk.TightInclusionCCD())[0] > 0
    assert 0.2499 < step <= 0.25
    broad = ipc_toolkit.BroadPhase()
    for arguments, named in (((flat_t0, edges, np.zeros((0, 3), int)), {}), ((flat_t0, flat_t1, edges, []), dict(inflation_radius=0.1)),
                             ((flat_t0, flat_t1, edges, [], 0.1), {})):
        broad.build(*arguments, **named)
        assert (len(broad.detect_edge_vertex_candidates()) > 0) == (len(arguments) > 3)
    with pytest.raises(ValueError, match="edges name vertices"):
        broad.build(flat_t0, flat_t1, [[0, -1]], [])
    with pytest.raises(ValueError, match="not finite"):
        plugged(flat, flat_t0, flat_t1 * np.nan, ipc_toolkit.BroadPhase(), ipc_toolkit.NarrowPhaseCCD())
    assert ipc_toolkit.NarrowPhaseCCD().point_triangle_ccd(*np.full((8, 3), np.nan)) == (True, 0.0)


def test_edges_are_theirs():
    for _, _, faces in scenes():
        ours, theirs = onset_ccd.edges(faces), ipctk.edges(faces)
        assert {frozenset(e) for e in ours.tolist()} == {frozenset(e) for e in theirs.tolist()}
