// NaN, infinities and positions beyond range are outcomes that name the first such vertex: no exception, no
// hang, a step of zero.
#include "tests/catch.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

struct Bad {
  double value;
  Outcome outcome;
  PairOutcome of_pair;
};
constexpr Bad kBad[] = {{NAN, Outcome::non_finite, PairOutcome::non_finite},
                        {INFINITY, Outcome::non_finite, PairOutcome::non_finite},
                        {-INFINITY, Outcome::non_finite, PairOutcome::non_finite},
                        {0x1.0000000000001p1020, Outcome::out_of_range, PairOutcome::out_of_range},
                        {-0x1p1023, Outcome::out_of_range, PairOutcome::out_of_range}};

void expect_outcome(const Mesh& mesh, const scenes::Scene& s, Outcome outcome, int vertex) {
  for (BroadPhaseMethod method :
       {BroadPhaseMethod::automatic, BroadPhaseMethod::brute, BroadPhaseMethod::bvh}) {
    Options o;
    o.broad_phase = method;
    const StepResult r = compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, o);
    CHECK(r.outcome == outcome);
    CHECK(r.step == 0);
    CHECK(r.vertex == vertex);
    CHECK_FALSE(r.limiting);
    const ActiveSet a = construct_active_set(mesh, s.x_t0, s.x_t1, o);
    CHECK(a.outcome == outcome);
    CHECK(a.size() == 0);
    CHECK(a.vertex == vertex);
    CHECK_FALSE(is_step_collision_free(mesh, s.x_t0, s.x_t1, o));
    const Candidates c = compute_candidates(mesh, s.x_t0, s.x_t1, o);
    CHECK(c.outcome == outcome);
    CHECK(c.vertex == vertex);
    CHECK(c.counts.total() == 0);
  }
}

}  // namespace

TEST_CASE("a bad coordinate at either end is named by its vertex", "[unit]") {
  const NamedScene named = some_scenes()[3];
  const Mesh mesh = named.mesh();
  for (const Bad& bad : kBad)
    for (int axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end) {
        scenes::Scene s = named.scene;
        (end == 0 ? s.x_t0 : s.x_t1)(11, axis) = bad.value;
        (end == 0 ? s.x_t1 : s.x_t0)(17, axis) = bad.value;
        expect_outcome(mesh, s, bad.outcome, 11);
      }
}

TEST_CASE("the largest coordinates in range are answered", "[unit]") {
  NamedScene named = some_scenes()[3];
  named.scene.x_t0 *= 0x1p1018, named.scene.x_t1 *= 0x1p1018;
  const StepResult r = compute_collision_free_stepsize(named.mesh(), named.scene.x_t0, named.scene.x_t1);
  CHECK(r.outcome == Outcome::contact);
  CHECK(r.step > 0.33);
  CHECK(r.step <= 0.34);
}

TEST_CASE("single queries answer bad coordinates in the same way", "[unit]") {
  for (const Bad& bad : kBad) {
    VertexFaceQuery vf{{{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                       {{{0, 0, 2}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    EdgeEdgeQuery ee{vf.t0, vf.t1};
    vf.t1[2][1] = ee.t0[3][2] = bad.value;
    for (const QueryResult& r : {vertex_face_ccd(vf), edge_edge_ccd(ee)}) {
      CHECK(r.outcome == bad.of_pair);
      CHECK(r.toi == 0);
      CHECK(r.collides());
    }
  }
}
