// What never happens is at infinity; what happens at the end of the step is at 1.
#include "tests/catch.hpp"
#include "tests/src/support/one_pair.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;

namespace {

Query over_a_face(double from, double to) {
  const Point f0{-2, -2, 0}, f1{2, -2, 0}, f2{0, 2, 0};
  return {PairKind::vertex_face, {{{0, 0, from}, f0, f1, f2}}, {{{0, 0, to}, f0, f1, f2}}};
}

struct Answers {
  QueryResult query;
  StepResult step;
  ActiveSet set;
  bool free;
};
Answers ask(const Query& query, const Options& options) {
  const Mesh mesh = mesh_of(query.kind);
  const Eigen::MatrixXd x_t0 = positions(query.t0), x_t1 = positions(query.t1);
  return {scenes::ccd(query, options), compute_collision_free_stepsize(mesh, x_t0, x_t1, options),
          construct_active_set(mesh, x_t0, x_t1, options), is_step_collision_free(mesh, x_t0, x_t1, options)};
}

}  // namespace

TEST_CASE("a pair that never touches does so at infinity", "[unit]") {
  for (Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact}) {
    Options options;
    options.exactness = level;
    for (const Query& query : {over_a_face(1, 0.5), over_a_face(1, 1), over_a_face(1, 2)}) {
      const Answers a = ask(query, options);
      CHECK((a.query.outcome == PairOutcome::free && a.query.toi == INFINITY &&
             a.query.step_limit == INFINITY));
      CHECK((a.step.outcome == Outcome::free && a.step.step == 1 && a.step.toi == INFINITY));
      CHECK((a.step.toi_hi == INFINITY && !a.step.limiting));
      CHECK((a.set.size() == 0 && a.set.complete_until == INFINITY && a.free));
    }
  }
}

TEST_CASE("a pair that touches at the end does so at 1, and the step ends before", "[unit]") {
  for (Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact}) {
    Options options;
    options.exactness = level;
    const Answers a = ask(over_a_face(1, 0), options);
    CHECK((a.query.outcome == PairOutcome::contact && a.query.toi <= 1 && a.query.toi > 0.99));
    CHECK((a.step.outcome == Outcome::contact && a.step.step < 1 && a.step.step > 0.99 && a.step.limiting &&
           a.step.limiting->a == 0));
    CHECK((a.step.toi <= 1 && a.step.toi > 0.99));
    CHECK((a.set.size() == 1 && a.set[0].toi == a.step.toi && !a.free));
    if (level == Exactness::exact) CHECK((a.query.toi == 1 && a.step.toi == 1 && a.step.toi_hi == 1));
  }
}

TEST_CASE("a pair that parts within its separation is met again at infinity, or where it is", "[unit]") {
  Options options;
  options.min_separation = 0.25;
  const Answers parts = ask(over_a_face(0.125, 1), options);
  CHECK((parts.query.outcome == PairOutcome::initial_separating && parts.query.toi == 0));
  CHECK(parts.query.step_limit == INFINITY);
  CHECK((parts.step.step == 1 && parts.step.outcome == Outcome::free && !parts.step.limiting));
  REQUIRE(parts.set.size() == 1);
  CHECK((parts.set[0].outcome == PairOutcome::initial_separating && parts.set[0].toi == 0));
  CHECK(parts.set[0].step_limit == INFINITY);
}
