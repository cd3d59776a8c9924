// Touching, or closer than the separation, at the start: what presses is told from what parts.
#include <cmath>
#include <onset/onset.hpp>

#include "tests/catch.hpp"

using namespace onset;

namespace {

VertexFaceQuery moving_vertex(Point from, Point to) {
  const Point f0{0, 0, 0}, f1{1, 0, 0}, f2{0, 1, 0};
  return {{from, f0, f1, f2}, {to, f0, f1, f2}};
}
PairOutcome outcome(Point from, Point to, double d = 0, bool may_pass_through = false) {
  Options options;
  options.min_separation = d;
  options.touching_may_pass_through = may_pass_through;
  return vertex_face_ccd(moving_vertex(from, to), options).outcome;
}
EdgeEdgeQuery crossing_edges(double height_t0, double height_t1) {
  const auto a = [](double h) { return std::array<Point, 2>{Point{-1, 0, h}, Point{1, 0, h}}; };
  const Point b0{0, -1, 0}, b1{0, 1, 0};
  return {{a(height_t0)[0], a(height_t0)[1], b0, b1}, {a(height_t1)[0], a(height_t1)[1], b0, b1}};
}

// One face below, one vertex's face above it: the upper one moves.
StepResult step_of(double from, double to, double d = 0) {
  Eigen::MatrixXd x0(6, 3);
  x0 << 0, 0, 0, 1, 0, 0, 0, 1, 0, .25, .25, from, 1.25, .5, from + 1, .5, 1.25, from + 1;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  Eigen::MatrixXd x1 = x0;
  for (int v = 3; v < 6; ++v) x1(v, 2) += to - from;
  Options options;
  options.min_separation = d;
  return compute_collision_free_stepsize(Mesh(x0, F), x0, x1, options);
}

}  // namespace

TEST_CASE("a touching pair blocks the step, and where it may part is told from one that presses", "[unit]") {
  const auto check = [](Point from, Point to, PairOutcome allowed) {
    CHECK(outcome(from, to) == PairOutcome::initial_contact);
    CHECK(outcome(from, to, 0, true) == allowed);
  };
  check({.25, .25, 0}, {.25, .25, 1}, PairOutcome::initial_separating);
  check({.25, .25, 0}, {.25, .25, 0}, PairOutcome::initial_separating);  // at rest
  check({0, 0, 0}, {-1, -1, .1}, PairOutcome::initial_separating);       // vertex on vertex
  check({.5, 0, 0}, {.5, -1, 0}, PairOutcome::initial_separating);       // vertex on side
  check({.5, 0, 0}, {.5, .2, 0}, PairOutcome::initial_contact);          // slides into the face's plane
  Options part;
  part.touching_may_pass_through = true;
  CHECK(edge_edge_ccd(crossing_edges(0, 1)).outcome == PairOutcome::initial_contact);
  CHECK(edge_edge_ccd(crossing_edges(0, 1), part).outcome == PairOutcome::initial_separating);
}

TEST_CASE("a pair apart by less than rounding can show is decided exactly", "[unit]") {
  for (const double gap : {1e-17, 1e-25, 1e-40}) {
    CHECK(outcome({.25, .25, gap}, {.25, .25, -1}) == PairOutcome::contact);
    CHECK(outcome({.25, .25, gap}, {.25, .25, 1}) == PairOutcome::free);
    CHECK(outcome({.25, .25, -gap}, {.25, .25, 1}) == PairOutcome::contact);
    CHECK(outcome({.25, .25, -gap}, {.25, .25, -1}) == PairOutcome::free);
    CHECK(edge_edge_ccd(crossing_edges(gap, -1)).outcome == PairOutcome::contact);
    CHECK(edge_edge_ccd(crossing_edges(gap, 1)).outcome == PairOutcome::free);
    CHECK(edge_edge_ccd(crossing_edges(-gap, 1)).outcome == PairOutcome::contact);
  }
}

TEST_CASE("closer than the separation: receding goes free, approaching gives step 0 with the pair",
          "[unit]") {
  CHECK(outcome({.25, .25, .05}, {.25, .25, 1}, .1) == PairOutcome::initial_separating);
  CHECK(outcome({.25, .25, .05}, {.25, .25, .06}, .1) == PairOutcome::initial_separating);
  CHECK(outcome({.25, .25, .05}, {.45, .25, .05}, .1) ==
        PairOutcome::initial_separating);  // keeps its distance
  CHECK(outcome({.25, .25, .05}, {.25, .25, .04}, .1) == PairOutcome::initial_contact);

  const StepResult receding = step_of(.05, .5, .1);
  CHECK(receding.step == 1);
  CHECK(receding.outcome == Outcome::free);
  const StepResult pressing = step_of(.05, -.5, .1);
  CHECK(pressing.step == 0);
  CHECK(pressing.outcome == Outcome::initial_contact);
  CHECK(pressing.limiting);
}

TEST_CASE("what is in contact at the start has touched by then, whether it parts or not", "[unit]") {
  const auto check = [](double height, double to, double d, bool may_pass_through, PairOutcome expected) {
    CAPTURE(height, to, d, may_pass_through);
    Options o;
    o.min_separation = d;
    o.touching_may_pass_through = may_pass_through;
    for (const QueryResult& r : {vertex_face_ccd(moving_vertex({.25, .25, height}, {.25, .25, to}), o),
                                 edge_edge_ccd(crossing_edges(height, to), o)}) {
      CHECK(r.outcome == expected);
      CHECK(r.certainty == Certainty::touching_at_start);
      CHECK((r.toi == 0 && r.toi_hi == 0));
    }
  };
  for (const bool may : {false, true}) {
    check(.05, .5, .1, may, PairOutcome::initial_separating);
    check(.05, -.5, .1, may, PairOutcome::initial_contact);
  }
  check(0, .5, 0, false, PairOutcome::initial_contact);
  check(0, .5, 0, true, PairOutcome::initial_separating);
  check(0, .5, .1, true, PairOutcome::initial_separating);

  Eigen::MatrixXd x0(4, 3), x1;
  x0 << 0, 0, 0, 1, 0, 0, 0, 1, 0, .25, .25, .05;
  x1 = x0;
  x1(3, 2) = .5;
  const Mesh mesh(x0, Eigen::RowVector3i(0, 1, 2));
  Options o;
  o.min_separation = .1;
  const ActiveSet set = construct_active_set(mesh, x0, x1, o);
  REQUIRE(set.size() == 1);
  CHECK(set[0].outcome == PairOutcome::initial_separating);
  CHECK((set[0].certainty == Certainty::touching_at_start && set[0].toi_hi == 0));
}

TEST_CASE("a pair that parts and is met again later limits the step there", "[unit]") {
  // The vertex leaves the first face, and flies into a second one parallel to it at height 1.
  Eigen::MatrixXd x0(7, 3);
  x0 << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, .25, .25, 0;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  Eigen::MatrixXd x1 = x0;
  x1(6, 2) = 2;
  CHECK(compute_collision_free_stepsize(Mesh(x0, F), x0, x1).outcome == Outcome::initial_contact);
  Options part;
  part.touching_may_pass_through = true;
  const StepResult r = compute_collision_free_stepsize(Mesh(x0, F), x0, x1, part);
  CHECK(r.outcome == Outcome::contact);
  CHECK(r.step < 0.5);
  CHECK(r.step > 0.499);
  REQUIRE(r.limiting);
  CHECK(r.limiting->b == 1);
}

// The vertex leaves a corner of the face, whose other corners swing after it and rise by `rise`.
TEST_CASE("what parts from a touch and is met again is decided exactly, too", "[unit]") {
  const auto limit = [](double rise, Exactness exactness) {
    const VertexFaceQuery q{{{{0, 0, 0}, {0, 0, 0}, {1, -1, -1}, {1, 1, 1}}},
                            {{{-1, 0, .125}, {0, 0, 0}, {-3, -1, -1 + rise}, {-3, 1, 1 + rise}}}};
    Options o;
    o.touching_may_pass_through = true;
    o.exactness = exactness;
    const QueryResult r = vertex_face_ccd(q, o);
    CHECK(r.outcome == PairOutcome::initial_separating);
    return r.step_limit;
  };
  for (const Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact}) {
    CAPTURE(int(level));
    CHECK((limit(.25, level) <= .5 && limit(.25, level) > .499));
    CHECK(limit(.0625, level) == INFINITY);
    CHECK(limit(.375, level) <= 1);
  }
  const double nearly = .375 + 0x1p-50;  // they would meet just after the step
  CHECK(limit(nearly, Exactness::conservative) <= 1);
  CHECK(limit(nearly, Exactness::exact) == INFINITY);
}
