"""Every call answers as it does in C++, and calls agree with each other."""

import math

import numpy as np
import pytest
from conftest import bits

import onset_ccd
from onset_ccd import Outcome, PairKind


def test_a_step_says_what_limits_it(falling):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    r = onset_ccd.compute_collision_free_stepsize(mesh, falling.x_t0, falling.x_t1, exactness="exact")
    assert r.outcome == Outcome.contact and r.toi == 0.5 and 0.4999 < r.step < 0.5
    assert r.limiting == onset_ccd.Pair(PairKind.vertex_face, 3, 0) and r.limiting.vertices == (3, 0, 1, 2)
    assert r.vertex == -1 and r.stats.candidates.total() > 0 and "contact" in repr(r)
    assert not onset_ccd.is_step_collision_free(mesh, falling.x_t0, falling.x_t1)
    assert onset_ccd.is_step_collision_free(mesh, falling.x_t0, falling.x_t0 + r.step * (falling.x_t1 - falling.x_t0))


@pytest.mark.parametrize("bad, outcome", [(math.nan, Outcome.non_finite), (math.inf, Outcome.non_finite), (1e308, Outcome.out_of_range)])
def test_what_a_solver_produces_is_an_outcome(falling, bad, outcome):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    falling.x_t1[4, 1] = bad
    for call in (onset_ccd.compute_collision_free_stepsize, onset_ccd.construct_active_set, onset_ccd.compute_candidates,
                 onset_ccd.truncate_step):
        r = call(mesh, falling.x_t0, falling.x_t1)
        assert r.outcome == outcome and r.vertex == 4
    assert onset_ccd.check(mesh, falling.x_t1).outcome == outcome
    assert onset_ccd.close_pairs(mesh, falling.x_t1, 1).outcome == outcome


def test_budgets_are_outcomes(crumpled):
    mesh = onset_ccd.Mesh(crumpled.x_t0, crumpled.faces)
    x = crumpled.x_t0, crumpled.x_t1
    assert onset_ccd.compute_collision_free_stepsize(mesh, *x, check_limit=0).outcome == Outcome.out_of_checks
    assert onset_ccd.compute_collision_free_stepsize(mesh, *x, time_limit=0).outcome == Outcome.out_of_time
    assert onset_ccd.construct_active_set(mesh, *x, memory_limit=1000).outcome == Outcome.out_of_memory


def test_threads_and_instruction_sets_give_the_same_bytes(crumpled):
    mesh = onset_ccd.Mesh(crumpled.x_t0, crumpled.faces)
    sets = [bits(onset_ccd.construct_active_set(mesh, crumpled.x_t0, crumpled.x_t1, threads=t, instruction_set=i).contacts)
            for t in (0, 1, 2) for i in ("automatic", "scalar")]
    assert len(set(sets)) == 1 and len(sets[0]) > 0


def test_candidates_listed_counted_and_visited(crumpled):
    mesh = onset_ccd.Mesh(crumpled.x_t0, crumpled.faces)
    x = crumpled.x_t0, crumpled.x_t1
    listed, counted, visited = onset_ccd.compute_candidates(mesh, *x), onset_ccd.count_candidates(mesh, *x), {}
    onset_ccd.visit_candidates(mesh, *x, lambda kind, pairs: visited.setdefault(kind, []).extend(map(tuple, pairs)), threads=2)
    assert counted.counts.total() == listed.counts.total() > 0
    assert sorted(visited[PairKind.vertex_face]) == list(map(tuple, listed.vertex_face))
    assert sorted(visited[PairKind.edge_edge]) == list(map(tuple, listed.edge_edge))
    whole = onset_ccd.compute_collision_free_stepsize(mesh, *x)
    again = onset_ccd.compute_collision_free_stepsize(mesh, onset_ccd.Candidates(listed.vertex_face, listed.edge_edge), *x)
    assert again.toi == whole.toi and again.limiting == whole.limiting
    assert onset_ccd.compute_collision_free_stepsize(mesh, listed, *x, gap_share=0.2).step < again.step


def test_line_search_and_close_pairs(falling):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    search = onset_ccd.LineSearch(mesh, falling.x_t0, falling.x_t1 - falling.x_t0, d_hat=0.3, gap_share=0.25)
    r = search.largest_step()
    assert 0.37 < r.step < 0.5 and r.assured and r.gap_share == 0.25 and not r.gap_share_reduced
    near = search.close_pairs(r.step)
    assert np.array_equal(near.pairs["a"], onset_ccd.close_pairs(mesh, falling.x_t0 + r.step * (falling.x_t1 - falling.x_t0), 0.3).pairs["a"])
    assert search.largest_step(0.1).step == 0.1 and search.candidates().total() > 0 and search.close_candidates().total() > 0
    with pytest.raises(ValueError, match="in .0, 1."):
        search.largest_step(2)


def test_safe_distances_and_a_bound_of_the_step(falling):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    dx = falling.x_t1 - falling.x_t0
    close = onset_ccd.close_pairs(mesh, falling.x_t0, 1.5)
    r = onset_ccd.safe_distances(mesh, falling.x_t0, close)
    assert r.shape == (6,) and 0 < r[3] <= 0.5
    assert 0 < onset_ccd.safe_step(r, dx) <= 0.25
    assert 0.25 < onset_ccd.compute_cfl_stepsize(mesh, falling.x_t0, falling.x_t1, close).step < 0.5


def test_constraints_are_triplets(falling):
    found = onset_ccd.construct_active_set(onset_ccd.Mesh(falling.x_t0, falling.faces), falling.x_t0, falling.x_t1)
    c = onset_ccd.assemble_constraints(found, 0.1)
    a = np.zeros((c.rows(), 18))
    np.add.at(a, (c.row, c.dof), c.value)
    for i, contact in enumerate(found):
        x = falling.x_t0 + contact.toi * (falling.x_t1 - falling.x_t0)
        assert abs(a[i] @ x.ravel() - contact.gap) < 1e-12
    assert (c.bound == 0.1).all() and len(found) == c.rows() == 3
    full = onset_ccd.assemble_constraints(found, full_vertex=[10, 11, 12, 20, 21, 22])
    assert full.dof.min() == 30 and full.dof.max() == 68


def test_match(crumpled):
    mesh = onset_ccd.Mesh(crumpled.x_t0, crumpled.faces)
    a = onset_ccd.construct_active_set(mesh, crumpled.x_t0, crumpled.x_t1)
    b = onset_ccd.construct_active_set(mesh, crumpled.x_t0, 0.5 * (crumpled.x_t0 + crumpled.x_t1))
    m = onset_ccd.match(a, b)
    key = lambda c: list(zip(c["kind"], c["a"], c["b"]))
    rows = {pair: i for i, pair in enumerate(key(b.contacts))}
    assert [rows.get(pair, -1) for pair in key(a.contacts)] == list(m.to_of_from)
    assert np.array_equal(onset_ccd.match(a.contacts, b.contacts).to_of_from, m.to_of_from)
    assert onset_ccd.match([a[0]], [onset_ccd.Pair(a[0].kind, a[0].a, a[0].b)]).count == 1


def test_check_names_faults_and_their_cure(crumpled):
    mesh = onset_ccd.Mesh(crumpled.x_t0, crumpled.faces)
    assert onset_ccd.check(mesh, crumpled.x_t0).clean() and not onset_ccd.has_intersections(mesh, crumpled.x_t0)
    report = onset_ccd.check(mesh, crumpled.x_t1)
    assert not report.acceptable() and report.findings[0].fault == onset_ccd.StartFault.intersecting
    assert report.findings[0].count == len(report.intersections) and "intersect" in report.findings[0].text
    rules = mesh.rules
    rules.excluded_intersections = report.intersections
    rules.excluded_pairs = report.touching
    mesh.rules = rules
    assert len(mesh.rules.excluded_intersections) == len(report.intersections)
    assert onset_ccd.check(mesh, crumpled.x_t1).acceptable()
    assert onset_ccd.duplicate_vertices([[0, 0, 0], [1, 0, 0], [0, 0, 0]]).tolist() == [[0, 2]]


def test_rules(falling):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    x = falling.x_t0, falling.x_t1
    assert list(mesh.components()) == [0, 0, 0, 1, 1, 1]
    mesh.rules = onset_ccd.CollisionRules(bodies=mesh.components(), excluded_bodies=[(0, 1)])
    assert onset_ccd.compute_collision_free_stepsize(mesh, *x).outcome == Outcome.free
    mesh.rules = onset_ccd.CollisionRules(thickness=np.full(6, 0.1))
    assert 0.39 < onset_ccd.compute_collision_free_stepsize(mesh, *x).step < 0.4
    mesh.rules = onset_ccd.CollisionRules(bodies=[0, 0, 0, 1, 1, 1], body_separations=[(0, 1, 0.4)])
    assert 0.29 < onset_ccd.compute_collision_free_stepsize(mesh, *x).step < 0.3
    mesh.rules = onset_ccd.CollisionRules(rest_positions=falling.x_t0, rest_share=0.25)
    assert 0.37 < onset_ccd.compute_collision_free_stepsize(mesh, *x, min_separation=5).step < 0.375
    assert np.array_equal(mesh.rules.rest_positions, falling.x_t0)
    mesh.rules = onset_ccd.CollisionRules(planes=[onset_ccd.Plane([0, 0, 2], 1.0)], static_vertices=[True] * 3 + [False] * 3)
    r = onset_ccd.compute_collision_free_stepsize(mesh, *x)
    assert r.limiting.kind == PairKind.vertex_plane and 0.249 < r.step < 0.25
    mesh.rules = None
    assert mesh.rules.thickness.size == 0 and mesh.filter_counts.vertex_face.may_meet() == 6
    mesh.rules = onset_ccd.CollisionRules(groups=[1, 1, 1, 2, 2, 2], masks=[1, 1, 1, 2, 2, 2])
    assert onset_ccd.compute_collision_free_stepsize(mesh, *x).step == 1


@pytest.mark.parametrize("rules, what", [
    (dict(bodies=[0, 0]), "bodies"), (dict(thickness=[-1.0] * 6), "thickness row 0"), (dict(points=[0]), "points row 0"),
    (dict(excluded_vertices=[(0, 9)]), "excluded_vertices row 0"), (dict(planes=[onset_ccd.Plane([0, 0, 0])]), "planes row 0"),
    (dict(rest_positions=np.zeros((2, 3))), "rest_positions"), (dict(excluded_rings=-1), "excluded_rings"),
    (dict(excluded_pairs=[onset_ccd.Pair(PairKind.vertex_face, 0, 99)]), "excluded_pairs row 0"),
])
def test_bad_rules_are_named(falling, rules, what):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    with pytest.raises(ValueError, match=what):
        mesh.rules = onset_ccd.CollisionRules(**rules)
    with pytest.raises(ValueError, match=what):
        onset_ccd.Mesh(falling.x_t0, falling.faces, rules=onset_ccd.CollisionRules(**rules))
    assert mesh.rules.bodies.size == 0


def test_rules_of_the_wrong_kind(falling):
    for wrong in (dict(groups=[-1]), dict(groups=[2**32]), dict(bodies=[0.5]), dict(static_vertices=[0, 1]), dict(excluded_bodies=[(1, 2, 3)])):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            onset_ccd.CollisionRules(**wrong)
    for wrong in (dict(planes=[1]), dict(excluded_pairs=[1]), dict(nonsense=1)):
        with pytest.raises(TypeError):
            onset_ccd.CollisionRules(**wrong)
    for wrong in (dict(weld="x"), dict(weld=1), dict(excluded_rings=1.5), dict(excluded_rings=[1]), dict(rest_share="a")):
        with pytest.raises(TypeError, match=next(iter(wrong)) + " must be"):
            onset_ccd.CollisionRules(**wrong)
    with pytest.raises(ValueError, match="excluded_rings 1099511627776 is out of range"):
        onset_ccd.CollisionRules(excluded_rings=2**40)
    rules = onset_ccd.CollisionRules(weld=np.True_, excluded_rings=np.int64(2), rest_share=np.float32(0.5))
    assert rules.weld is True and rules.excluded_rings == 2 and rules.rest_share == 0.5


@pytest.mark.parametrize("options, kind, what", [
    (dict(min_seperation=1), TypeError, "min_seperation"), (dict(min_separation=-1), ValueError, "min_separation"),
    (dict(tolerance="x"), TypeError, "tolerance"), (dict(tolerance=0), ValueError, "tolerance"), (dict(threads=-1), ValueError, "threads"),
    (dict(threads=1.5), TypeError, "threads"), (dict(exactness="maybe"), ValueError, "conservative, certify, exact"),
    (dict(exactness=7), TypeError, "exactness"), (dict(progress=3), TypeError, "progress"), (dict(gap_share=0.5), TypeError, "gap_share"),
    (dict(max_checks=2**70), TypeError, "max_checks"), (dict(window=math.nan), ValueError, "window"),
])
def test_bad_options_are_named(falling, options, kind, what):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    with pytest.raises(kind, match=what):
        onset_ccd.construct_active_set(mesh, falling.x_t0, falling.x_t1, **options)


def test_queries():
    t0 = np.array([[0.25, 0.25, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0]])
    t1 = t0.copy()
    t1[0, 2] = -1
    r = onset_ccd.vertex_face_ccd(t0, t1, exactness="exact")
    assert r.toi == 0.5 and r.collides() and r.certainty == onset_ccd.Certainty.certain and r.normal == [0, 0, 1] and r.checks >= 0
    assert np.allclose(r.weights, [1, -0.5, -0.25, -0.25])
    e0 = np.array([[-1, 0, 1], [1, 0, 1], [0, -1, 0], [0, 1, 0]])
    e1 = e0 - [[0, 0, 4], [0, 0, 4], [0, 0, 0], [0, 0, 0]]
    assert onset_ccd.edge_edge_ccd(e0, e1, exactness="exact").toi == 0.25
    p0 = [[0.5, 1], [0, 0], [1, 0]]
    assert onset_ccd.vertex_edge_ccd(p0, [[0.5, -1], [0, 0], [1, 0]], exactness="exact").toi == 0.5
    t1[0] = np.nan
    assert onset_ccd.vertex_face_ccd(t0, t1).outcome == onset_ccd.PairOutcome.non_finite
    with pytest.raises(ValueError, match="t1 is 3 x 3; it must be 4 x 3"):
        onset_ccd.vertex_face_ccd(t0, t1[:3])


def test_two_dimensions():
    x_t0 = np.array([[0, 0], [1, 0], [0.5, 1]])
    x_t1 = x_t0 - [[0, 0], [0, 0], [0, 2]]
    mesh = onset_ccd.Mesh(x_t0, edges=[[0, 1]], rules=onset_ccd.CollisionRules(points=[2]))
    assert mesh.dimension == 2
    r = onset_ccd.construct_active_set(mesh, x_t0, x_t1, exactness="exact")
    assert r.dimension == 2 and r[0].kind == PairKind.vertex_edge and r[0].toi == 0.5
    assert onset_ccd.truncate_step(mesh, x_t0, x_t1).positions.shape == (3, 2)
    assert onset_ccd.Mesh(3, edges=[[0, 1]], dimension=2).dimension == 2
    with pytest.raises(ValueError, match="no faces"):
        onset_ccd.Mesh(x_t0, [[0, 1, 2]])


def test_each_vertex_has_a_step_of_its_own(falling):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    r = onset_ccd.truncate_step(mesh, falling.x_t0, falling.x_t1, gap_share=0.5, d_hat=3.0)
    assert r.positions.shape == r.displacements.shape == (6, 3) and r.outcome == Outcome.contact and 0 < r.kept < 1
    assert not onset_ccd.has_intersections(mesh, r.positions) and (r.share >= 0).all() and (r.share <= 1).all()
    assert r.limited_by[3] >= 0 and r.pairs[r.limited_by[3]]["a"] == 3
    assert onset_ccd.is_step_collision_free(mesh, falling.x_t0, r.positions)


def test_a_body_that_turns(falling):
    motion = onset_ccd.RigidTrajectory(falling.x_t0)
    assert motion.add_body([3, 4, 5], rotation=[0, 0, 1], translation=[0, 0, -2], centre=[0.5, 0.5, 1]) == 0
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    r = onset_ccd.compute_collision_free_stepsize(mesh, motion)
    assert 0.49 < r.step <= 0.5 and not onset_ccd.is_step_collision_free(mesh, motion)
    assert len(onset_ccd.construct_active_set(mesh, motion)) >= 1 and motion.body(4) == 0 and motion.body(0) == onset_ccd.Trajectory.kLinear
    assert np.allclose(motion.at(1)[3], [0.5, 0.5, -1])
    with pytest.raises(ValueError, match="is in body 0 already"):
        motion.add_body([3], [0, 0, 1], [0, 0, 0], [0, 0, 0])


class Curved(onset_ccd.Trajectory):
    """The upper triangle falls along a parabola, x_t0 - 2 t^2."""

    def __init__(self, x):
        super().__init__()
        self.x = x

    def num_vertices(self):
        return len(self.x)

    def body(self, vertex):
        return self.kFree if vertex >= 3 else self.kLinear

    def positions(self, t, vertices):
        x = self.x[vertices].copy()
        x[vertices >= 3, 2] -= 2 * t * t
        return x

    def straying(self, t0, t1, vertices):
        return np.full(len(vertices), 0.5 * (t1 - t0) ** 2 + 1e-14)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_trajectory_written_in_python(falling, threads):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    r = onset_ccd.compute_collision_free_stepsize(mesh, Curved(falling.x_t0), threads=threads)
    assert math.sqrt(0.5) - 1e-3 < r.step <= math.sqrt(0.5)


def test_what_a_trajectory_raises_leaves_the_call(falling):
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)

    class Broken(Curved):
        def positions(self, t, vertices):
            raise KeyError("lost")

    class Short(Curved):
        def straying(self, t0, t1, vertices):
            return [0.0]

    class Vague(Curved):
        def body(self, vertex):
            return None

    with pytest.raises(TypeError, match="body.. did not return a whole number"):
        onset_ccd.compute_collision_free_stepsize(mesh, Vague(falling.x_t0))

    class Empty(onset_ccd.Trajectory):
        pass

    with pytest.raises(KeyError, match="lost"):
        onset_ccd.compute_collision_free_stepsize(mesh, Broken(falling.x_t0))
    with pytest.raises(ValueError, match="straying"):
        onset_ccd.compute_collision_free_stepsize(mesh, Short(falling.x_t0))
    with pytest.raises(TypeError, match="Empty is a Trajectory and must have num_vertices"):
        onset_ccd.compute_collision_free_stepsize(mesh, Empty())


def test_surfaces_and_maps(falling):
    x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [9, 9, 9]], float)
    s = onset_ccd.surface_of_tetrahedra([[0, 1, 2, 3]], x)
    mesh = s.mesh()
    assert s.faces.shape == (4, 3) and s.edges.shape == (6, 2) and list(s.full_vertices) == [0, 1, 2, 3] and list(s.surface_vertices) == [0, 1, 2, 3, -1]
    assert mesh.num_full_vertices == 5 and np.array_equal(mesh.surface_positions(x), x[:4])
    doubled = onset_ccd.VertexMap(6, range(6), range(6), np.full(6, 2.0), (6, 6))
    assert np.array_equal(doubled.positions(falling.x_t0), 2 * falling.x_t0) and doubled.num_dofs == 18
    found = onset_ccd.construct_active_set(onset_ccd.Mesh(falling.x_t0, falling.faces), falling.x_t0, falling.x_t1)
    plain, mapped = onset_ccd.assemble_constraints(found), onset_ccd.assemble_constraints(found, 0.0, doubled)
    assert np.array_equal(np.sort(mapped.value), np.sort(2 * plain.value))
    assert np.array_equal(doubled.to_dofs(np.ones(18)), np.full(18, 2.0)) and doubled.rounding(falling.x_t0, falling.x_t1) > 0
    row, column, value = doubled.hessian_to_dofs([0, 1], [0, 1], [1.0, 1.0])
    assert list(value) == [4, 4] and list(row) == list(column) == [0, 1]
    with pytest.raises(ValueError, match="entry 0 is at"):
        onset_ccd.VertexMap(6, [6], [0], [1.0], (6, 6))


def test_rules_are_assigned_as_a_whole(falling):
    rules = onset_ccd.CollisionRules(planes=[onset_ccd.Plane([0, 0, 1])], static_vertices=[True] * 6, body_separations=[(0, 1, 0.5)])
    assert isinstance(rules.planes, tuple) and isinstance(rules.body_separations, tuple)
    for array in (rules.static_vertices, rules.bodies, rules.thickness, rules.excluded_bodies):
        assert not array.flags.writeable
    assert "Plane([0.0, 0.0, 1.0], offset=0.0)" in repr(rules.planes)
    mesh = onset_ccd.Mesh(falling.x_t0, falling.faces)
    with pytest.raises(TypeError, match="rules must be CollisionRules"):
        mesh.rules = {"weld": True}
    with pytest.raises(TypeError, match="rules must be CollisionRules"):
        onset_ccd.Mesh(falling.x_t0, falling.faces, rules=5)


def test_rigid_trajectories_have_no_classes_of_their_own():
    with pytest.raises(TypeError):
        type("Own", (onset_ccd.RigidTrajectory,), {})


def test_the_version_is_that_of_the_library():
    import importlib.util
    import pathlib
    import re

    project = pathlib.Path(__file__).parents[2] / "CMakeLists.txt"
    assert importlib.util.find_spec("onset_ccd") and onset_ccd.__version__ == re.search(r"project\(onset VERSION ([0-9.]+)", project.read_text())[1]


def test_docstrings_come_from_the_headers():
    assert "certainly free of contact" in onset_ccd.compute_collision_free_stepsize.__doc__
    for name in onset_ccd.__all__:
        assert getattr(onset_ccd, name).__doc__, name
    for member in ("step", "toi", "rounding", "limiting"):
        assert getattr(onset_ccd.StepResult, member).__doc__, member
    for outcome in onset_ccd.Outcome:
        assert outcome.__doc__, outcome
    assert "a pair may be reported once" in onset_ccd.Options.__doc__
