"""Whatever is handed over, a call answers or raises ValueError or TypeError, and its answers hold. ONSET_FUZZ=100 for 10^5 inputs."""

import math
import os

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import onset_ccd

EXAMPLES = int(250 * float(os.environ.get("ONSET_FUZZ", "1")))
many = settings(max_examples=EXAMPLES, deadline=None, database=None, derandomize=True,
                suppress_health_check=list(HealthCheck))

coordinates = st.one_of(st.sampled_from([0.0, 1.0, -1.0, 0.5, -0.0, 5e-324, 1e308, math.nan, math.inf, 2.0**-30]), st.floats(-2, 2, width=32),
                        st.floats())
tame = st.one_of(st.sampled_from([0.0, 1.0, -1.0, 0.5, 2.0]), st.floats(-2, 2, width=32))
dtypes = st.sampled_from([np.float64, np.float32, np.float16, np.int8, np.int64, np.uint64, np.complex128, np.bool_, np.dtype(">f8"),
                          np.dtype("O"), np.dtype("U3"), np.longdouble, np.dtype("M8[s]")])


@st.composite
def arrays_of_any_kind(draw):
    dtype = draw(dtypes)
    shape = draw(hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=7))
    array = np.zeros(shape, dtype)
    if array.dtype.kind in "fiub":
        array = draw(hnp.arrays(dtype, shape))
    if draw(st.booleans()):
        array = array.T
    if array.ndim and draw(st.booleans()):
        array = array[:: draw(st.sampled_from([-1, 2, -2]))]
    return array


things = st.one_of(arrays_of_any_kind(), st.none(), st.integers(), st.floats(), st.text(max_size=3), st.lists(st.lists(st.integers(-1, 7))),
                   st.binary(max_size=9), st.dictionaries(st.text(max_size=2), st.integers(), max_size=2))

options = st.fixed_dictionaries({}, optional={
    "tolerance": st.one_of(st.none(), st.floats(), st.text(max_size=2)), "relative_tolerance": st.floats(), "min_separation": st.floats(),
    "norm": st.sampled_from(["euclidean", "maximum", "x", 1, onset_ccd.Norm.maximum]), "max_checks": st.integers(),
    "window": st.floats(), "check_limit": st.integers(), "memory_limit": st.integers(), "time_limit": st.floats(max_value=0.2),
    "threads": st.sampled_from([0, 1, 2, -1, "2"]), "exactness": st.sampled_from(["exact", "certify", "conservative", "", None]),
    "hold_candidates": st.booleans(), "touching_may_pass_through": st.one_of(st.booleans(), st.integers()), "gap_share": st.floats(), "d_hat": st.one_of(st.none(), st.floats()),
    "progress": st.sampled_from([None, 3, lambda share: True, lambda share: share < 0.5]), "other": st.none()})


def ask(call, *arguments, **named):
    try:
        return call(*arguments, **named)
    except (ValueError, TypeError, OverflowError):
        return None


@st.composite
def soups(draw, values=coordinates):
    vertices = draw(st.integers(3, 9))
    rows = st.lists(st.integers(0, vertices - 1), min_size=3, max_size=3, unique=True)
    faces = draw(st.lists(rows, min_size=0, max_size=5))
    x = [draw(hnp.arrays(np.float64, (vertices, 3), elements=values)) for _ in range(2)]
    return onset_ccd.Mesh(vertices, np.array(faces, int).reshape(-1, 3)), *x


@many
@given(things, things, things, things)
def test_meshes_and_rules_of_anything(rest, faces, edges, rule):
    if isinstance(rest, int) and rest > 10**6:
        rest = 10**6  # memory for each vertex is asked for
    ask(onset_ccd.Mesh, rest, faces, edges)
    ask(onset_ccd.edges, faces)
    ask(onset_ccd.surface_of_tetrahedra, faces, rest)
    ask(onset_ccd.duplicate_vertices, rest)
    for name in ("points", "thickness", "bodies", "rigid_bodies", "excluded_bodies", "static_vertices", "groups", "rest_positions", "planes",
                 "body_separations", "excluded_pairs", "excluded_intersections", "weld", "excluded_rings", "excluded_vertices"):
        rules = ask(onset_ccd.CollisionRules, **{name: rule})
        if rules is not None:
            ask(onset_ccd.Mesh, 6, [[0, 1, 2], [3, 4, 5]], rules=rules)


@many
@given(soups(), things, things, options)
def test_calls_on_anything(soup, x_t0, x_t1, named):
    mesh = soup[0]
    for call in (onset_ccd.compute_collision_free_stepsize, onset_ccd.construct_active_set, onset_ccd.compute_candidates, onset_ccd.LineSearch,
                 onset_ccd.truncate_step, onset_ccd.RigidTrajectory):
        ask(call, *([] if call is onset_ccd.RigidTrajectory else [mesh]), x_t0, x_t1, **({} if call is onset_ccd.RigidTrajectory else named))
    ask(onset_ccd.check, mesh, x_t0, **named)
    ask(onset_ccd.close_pairs, mesh, x_t0, x_t1, **named)
    ask(onset_ccd.vertex_face_ccd, x_t0, x_t1, **named)
    ask(onset_ccd.edge_edge_ccd, x_t0, x_t1, **named)
    ask(onset_ccd.vertex_edge_ccd, x_t0, x_t1, **named)
    ask(onset_ccd.VertexMap, 3, x_t0, x_t1, x_t0, (3, 3))
    ask(onset_ccd.safe_step, x_t0, x_t1)


@many
@given(soups(), options)
def test_steps_of_any_positions(soup, named):
    mesh, x_t0, x_t1 = soup
    r = ask(onset_ccd.compute_collision_free_stepsize, mesh, x_t0, x_t1, **named)
    if r is not None:
        assert 0 <= r.step <= 1 and isinstance(r.outcome, onset_ccd.Outcome) and repr(r)
    found = ask(onset_ccd.construct_active_set, mesh, x_t0, x_t1, **named)
    if found is not None and len(found):
        assert (found.contacts["toi"] <= 1).all() and np.isfinite(found.contacts["normal"]).all() and found.earliest() is not None
        c = onset_ccd.assemble_constraints(found)
        assert c.rows() == len(found) and len(c.row) == len(c.dof) == len(c.value)
    ask(onset_ccd.truncate_step, mesh, x_t0, x_t1, **named)
    ask(onset_ccd.check, mesh, x_t0, **named)
    search = ask(onset_ccd.LineSearch, mesh, x_t0, x_t1, **named)
    if search is not None:
        ask(search.largest_step, 0.5)
        ask(search.close_pairs, 0.5)


@many
@given(soups(tame))
def test_where_a_step_ends_nothing_intersects(soup):
    mesh, x_t0, x_t1 = soup
    if onset_ccd.has_intersections(mesh, x_t0):
        return
    step = onset_ccd.compute_collision_free_stepsize(mesh, x_t0, x_t1).step
    assert not onset_ccd.has_intersections(mesh, x_t0 + step * (x_t1 - x_t0)) or step == 0
    cut = onset_ccd.truncate_step(mesh, x_t0, x_t1)
    assert not onset_ccd.has_intersections(mesh, cut.positions)
