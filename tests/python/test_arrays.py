"""Arrays in: viewed where they can be, copied where that changes nothing, refused by name else. Arrays out: views."""

import gc

import numpy as np
import pytest

import onset_ccd
from onset_ccd import _onset


def where(x):
    address, row, column = _onset._viewed(x)
    return address, 8 * row, 8 * column


def test_contiguous_positions_are_not_copied():
    x = np.zeros((1000, 3))
    assert where(x) == (x.ctypes.data, *x.strides)
    f = np.asfortranarray(x)
    assert where(f) == (f.ctypes.data, *f.strides)


@pytest.mark.parametrize("view", [lambda x: x[::2], lambda x: x[::-1], lambda x: x[:, ::-1], lambda x: x[5:, 1:4], lambda x: x.T[:3].T,
                                  lambda x: np.broadcast_to(x[0, :3], (7, 3))])
def test_views_with_strides_are_not_copied(view):
    x = view(np.arange(60.0).reshape(10, 6))
    assert where(x) == (x.ctypes.data, *x.strides)


def test_read_only_arrays_are_viewed(falling):
    falling.x_t0.flags.writeable = False
    assert where(falling.x_t0)[0] == falling.x_t0.ctypes.data


def test_flat_arrays_are_not_copied():
    x = np.arange(12.0)
    assert where(x) == (x.ctypes.data, 24, 8)


@pytest.mark.parametrize("change", [np.asfortranarray, lambda x: x.astype(">f8"), lambda x: x.tolist(), lambda x: x[::-1].copy()[::-1],
                                    lambda x: x.ravel(), lambda x: memoryview(np.ascontiguousarray(x))])
def test_every_form_of_the_same_numbers_gives_the_same_step(falling, change):
    mesh = onset_ccd.Mesh(6, falling.faces)
    plain = onset_ccd.compute_collision_free_stepsize(mesh, falling.x_t0, falling.x_t1)
    other = onset_ccd.compute_collision_free_stepsize(mesh, change(falling.x_t0), change(falling.x_t1))
    assert 0.49 < plain.step < 0.5 and (plain.step, plain.toi, plain.limiting) == (other.step, other.toi, other.limiting)


@pytest.mark.parametrize("dtype", [np.float32, np.float16, np.int8, np.int32, np.uint16, bool])
def test_what_float64_holds_is_taken(falling, dtype):
    x = (4 * falling.x_t0).astype(dtype)
    mesh = onset_ccd.Mesh(x, falling.faces)
    exact = onset_ccd.close_pairs(mesh, x.astype(float), 100.0)
    assert len(exact) > 0
    assert np.array_equal(onset_ccd.close_pairs(mesh, x, 100.0).pairs, exact.pairs)


def test_numbers_that_are_not_aligned_are_copied(falling):
    packed = np.zeros(6, dtype=[("tag", "u1"), ("x", "<f8", (3,))])
    packed["x"] = falling.x_t0
    assert packed["x"].ctypes.data % 8 != 0
    mesh = onset_ccd.Mesh(6, falling.faces)
    steps = [onset_ccd.compute_collision_free_stepsize(mesh, x, falling.x_t1).step for x in (falling.x_t0, packed["x"])]
    assert steps[0] == steps[1] > 0


@pytest.mark.parametrize("x, what", [
    (np.zeros((6, 3), complex), "x_t0 is an array of complex128"),
    (np.zeros((6, 3), np.longdouble), "x_t0 is an array of longdouble|x_t0 is an array of float128"),
    (np.full((6, 3), "a"), "x_t0 is an array of str"),
    (np.full((6, 3), None), "x_t0 is an array of object"),
    (np.zeros((6, 3, 1)), "x_t0 has 3 axes"),
    (np.float64(1), "x_t0 has 0 axes"),
    ([[0, 0, 0], [1]], "x_t0 is not an array of numbers"),
    (np.zeros((6, 4)), "x_t0 has 6 rows of 4 coordinates"),
    (np.zeros((5, 3)), "x_t0 has 5 rows"),
])
def test_bad_positions_are_named(falling, x, what):
    mesh = onset_ccd.Mesh(6, falling.faces)
    with pytest.raises(ValueError, match=what):
        onset_ccd.compute_collision_free_stepsize(mesh, x, falling.x_t1)


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.uint8, np.uint64, np.int16])
@pytest.mark.parametrize("order", ["C", "F"])
def test_ids_of_any_width(falling, dtype, order):
    mesh = onset_ccd.Mesh(6, np.array(falling.faces, dtype, order=order))
    assert np.array_equal(mesh.faces, falling.faces)


@pytest.mark.parametrize("faces, what", [
    ([[0, 1, 6]], "face row 0: vertex 6 is out of range"),
    ([[0, 1, 2], [3, -1, 5]], "face row 1: vertex -1"),
    ([[0, 1, 2**40]], "face row 0"),
    (np.array([[0, 1, 2**64 - 1]], np.uint64), "faces row 0: 18446744073709551615 is out of range"),
    ([[0.0, 1.0, 2.0]], "faces is an array of float64"),
    ([[0, 1, 1]], "face row 0"),
    ([[0, 1, 2, 3]], "4 columns"),
    ([0, 1, 2], "faces is of shape"),
    ([[True, False, True]], "faces is an array of bool"),
])
def test_bad_faces_are_named(faces, what, recwarn):
    with pytest.raises(ValueError, match=what):
        onset_ccd.Mesh(6, faces)
    assert not recwarn.list


def test_masked_elements_are_refused(falling):
    mesh = onset_ccd.Mesh(6, falling.faces)
    masked = np.ma.array(falling.x_t0, mask=False)
    assert not onset_ccd.has_intersections(mesh, masked)
    masked[1, 2] = np.ma.masked
    with pytest.raises(ValueError, match="x is a masked array"):
        onset_ccd.has_intersections(mesh, masked)
    with pytest.raises(ValueError, match="faces is a masked array"):
        onset_ccd.Mesh(5, np.ma.array([[0, 1, 2]], mask=[[False, True, False]]))


@pytest.mark.parametrize("vertices", [2**63, -2**63 - 1, 2**62, -1])
def test_numbers_of_vertices_that_cannot_be(vertices):
    with pytest.raises(ValueError):
        onset_ccd.Mesh(vertices)


def test_numbers_of_numpy(falling):
    assert onset_ccd.Mesh(np.int64(6), falling.faces).num_vertices == 6
    mesh = onset_ccd.Mesh(6, falling.faces)
    for yes in (True, np.True_):
        assert onset_ccd.compute_collision_free_stepsize(mesh, falling.x_t0, falling.x_t1, touching_may_pass_through=yes).step < 0.5
    with pytest.raises(ValueError, match="whole numbers that float64 does not hold"):
        onset_ccd.close_pairs(mesh, np.full((6, 3), 2**53 + 1), 1.0)
    assert len(onset_ccd.close_pairs(mesh, np.arange(18).reshape(6, 3) + 2**52, 100.0)) > 0


def test_complex_numbers_are_not_cut_short(falling, recwarn):
    mesh = onset_ccd.Mesh(6, falling.faces)
    with pytest.raises(TypeError, match="min_separation"):
        onset_ccd.close_pairs(mesh, falling.x_t0, 1.0, min_separation=np.complex128(1))
    with pytest.raises(TypeError, match="body_separations"):
        onset_ccd.CollisionRules(body_separations=[np.ones(3, complex)])
    assert onset_ccd.close_pairs(mesh, falling.x_t0, 1.0, min_separation=np.float32(0.5)).pairs["separation"][0] == 0.5
    assert not recwarn.list


def test_lists_without_elements():
    mesh = onset_ccd.Mesh(np.zeros((0, 3)), [])
    assert (mesh.num_vertices, mesh.num_edges, mesh.num_faces) == (0, 0, 0)
    assert len(onset_ccd.construct_active_set(mesh, np.zeros((0, 3)), np.zeros((0, 3))).contacts) == 0
    assert onset_ccd.edges(np.zeros((0, 3), int)).shape == (0, 2)


def test_contacts_are_views_of_the_result(crumpled):
    found = onset_ccd.construct_active_set(onset_ccd.Mesh(crumpled.x_t0, crumpled.faces), crumpled.x_t0, crumpled.x_t1)
    contacts = found.contacts
    assert len(contacts) == len(found) > 10
    assert contacts.ctypes.data == found.contacts.ctypes.data
    assert not contacts.flags.writeable
    with pytest.raises(ValueError):
        contacts["toi"] = 1
    for i in (0, 1, -1):
        row, one = contacts[i], found[i]
        assert (row["kind"], row["a"], row["b"], tuple(row["vertices"])) == (one.kind, one.a, one.b, one.vertices)
        assert (row["toi"], row["toi_hi"], row["step_limit"], row["gap"], row["speed"]) == (
            one.toi, one.toi_hi, one.step_limit, one.gap, one.speed)
        assert (row["tolerance"], row["outcome"], row["certainty"], row["degenerate"]) == (
            one.tolerance, one.outcome, one.certainty, one.degenerate)
        assert list(row["weights"]) == one.weights and list(row["normal"]) == one.normal
    first = contacts.copy()
    del found
    gc.collect()
    junk = [np.full(contacts.nbytes, 255, np.uint8) for _ in range(20)]
    assert np.array_equal(contacts, first), len(junk)


def test_close_pairs_and_intersections_have_named_fields(crumpled):
    mesh = onset_ccd.Mesh(crumpled.x_t0, crumpled.faces)
    close = onset_ccd.close_pairs(mesh, crumpled.x_t0, 0.25).pairs
    x = crumpled.x_t0[close["vertices"]]
    assert np.allclose(np.linalg.norm(np.einsum("ij,ijk->ik", close["weights"], x), axis=1), close["distance"])
    assert (close["gap"] <= close["distance"]).all() and (close["separation"] == 0).all()
    crossing = onset_ccd.intersections(mesh, crumpled.x_t1).pairs
    assert len(crossing) > 0
    assert np.array_equal(crossing["vertices"][:, :2], mesh.edges[crossing["edge"]])
    assert np.array_equal(crossing["vertices"][:, 2:], mesh.faces[crossing["face"]])
    assert set(crossing["kind"]) <= set(onset_ccd.IntersectionKind)


def test_candidates_are_views(crumpled):
    found = onset_ccd.compute_candidates(onset_ccd.Mesh(crumpled.x_t0, crumpled.faces), crumpled.x_t0, crumpled.x_t1)
    assert found.vertex_face.ctypes.data == found.vertex_face.ctypes.data and found.vertex_face.dtype == np.int32
    assert len(found.vertex_face) == found.counts.vertex_face and len(found.edge_edge) == found.counts.edge_edge
    assert found.vertex_edge.shape == (0, 2)
