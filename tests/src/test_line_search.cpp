#include <cmath>
#include <onset/onset.hpp>
#include <stdexcept>
#include <utility>

#include "tests/catch.hpp"

using namespace onset;

namespace {

// A triangle above another, and where it would like to be: below it.
struct TwoTriangles {
  Eigen::MatrixXd x{6, 3}, target;
  Eigen::MatrixXi F{2, 3};
  TwoTriangles() {
    x << 0, 0, 0, 1, 0, 0, 0, 1, 0, .2, .2, .5, 1.2, .2, .6, .2, 1.2, .7;
    F << 0, 1, 2, 3, 4, 5;
    target = x;
    for (int v = 3; v < 6; ++v) target(v, 2) -= 1;
  }
  Mesh mesh() const { return Mesh(x, F); }
};

LineSearchOptions keeping(double gap_share, const Options& options = {}) {
  LineSearchOptions all = options;
  all.gap_share = gap_share;
  return all;
}

}  // namespace

TEST_CASE("steps along one direction approach a contact and never reach it", "[unit]") {
  TwoTriangles s;
  const Mesh mesh = s.mesh();
  const double gap_share = 0.2;
  Eigen::MatrixXd x = s.x;
  double gap = x(3, 2);
  for (int i = 0; i < 15; ++i) {  // down to gaps of 1e-11
    const LineSearchStep r = LineSearch(mesh, x, s.target - x, keeping(gap_share)).largest_step();
    REQUIRE(r.step > 0);
    REQUIRE(r.outcome == Outcome::contact);
    CHECK_FALSE(r.gap_share_reduced);
    CHECK(r.gap_share == gap_share);
    x = x + r.step * (s.target - x);
    CHECK(x(3, 2) >= gap_share * gap);  // after rounding to doubles
    CHECK(x(3, 2) <=
          (gap_share + (1 - gap_share) / 4) * gap * (1 + 1e-9));  // the stop rule: a quarter of the rest
    gap = x(3, 2);
  }
}

TEST_CASE("a gap that rounding can close is named", "[unit]") {
  TwoTriangles s;
  s.x.col(2).tail(3).array() += 4e-15 - 0.5;
  const LineSearchStep r = LineSearch(s.mesh(), s.x, s.target - s.x).largest_step();
  CHECK(r.gap_share_reduced);
  CHECK(r.gap_share < 0.2);
  CHECK(r.closest);
  CHECK(r.rounding > 0);
}

TEST_CASE("the largest step keeps the separation as well", "[unit]") {
  TwoTriangles s;
  Options options;
  options.min_separation = 0.1;
  const LineSearchStep r = LineSearch(s.mesh(), s.x, s.target - s.x, keeping(0.25, options)).largest_step();
  const double height = s.x(3, 2) - r.step;
  CHECK(height >= 0.1 + 0.25 * 0.4);
  CHECK(height <= 0.1 + 0.25 * 0.4 + 1e-3);
}

TEST_CASE("without a share to keep the line search agrees with the step size", "[unit]") {
  TwoTriangles s;
  const LineSearchStep r = LineSearch(s.mesh(), s.x, s.target - s.x, keeping(0)).largest_step();
  const StepResult whole = compute_collision_free_stepsize(s.mesh(), s.x, s.target);
  CHECK(r.step <= whole.step);  // room for rounding is kept
  CHECK(r.step >= whole.step * (1 - 1e-9));
  REQUIRE((r.limiting && whole.limiting));
  CHECK((r.limiting->kind == whole.limiting->kind && r.limiting->a == whole.limiting->a));
}

TEST_CASE("an upper bound below the contact is returned as it is", "[unit]") {
  TwoTriangles s;
  const LineSearch search(s.mesh(), s.x, s.target - s.x);
  const LineSearchStep r = search.largest_step(0.25);
  CHECK(r.step == 0.25);
  CHECK(r.outcome == Outcome::free);
  CHECK(search.candidates().total() > 0);
}

TEST_CASE("a line search that holds nothing says so, and may be assigned to", "[unit]") {
  TwoTriangles s;
  const Eigen::MatrixXd dx = s.target - s.x;
  const auto throws = [](const LineSearch& search) {
    CHECK_THROWS_AS(search.largest_step(), std::logic_error);
    CHECK_THROWS_AS(search.largest_step(0.5), std::logic_error);
    CHECK_THROWS_AS(search.close_pairs(0.5), std::logic_error);
    CHECK_THROWS_AS(search.candidates(), std::logic_error);
    CHECK_THROWS_AS(search.close_candidates(), std::logic_error);
  };
  LineSearch search;
  throws(search);
  search = LineSearch(s.mesh(), s.x, dx);
  const double step = search.largest_step().step;
  CHECK((step > 0 && step < 0.5));
  LineSearch other = std::move(search);
  throws(search);
  CHECK(other.largest_step().step == step);
  search = std::move(other);
  CHECK(search.largest_step().step == step);
  search = LineSearch();
  throws(search);
}

TEST_CASE("a line search without options of its own keeps a fifth of each gap", "[unit]") {
  TwoTriangles s;
  const Eigen::MatrixXd dx = s.target - s.x;
  CHECK((LineSearchOptions().gap_share == 0.2 && LineSearchOptions().d_hat == 0));
  Options options;
  options.max_checks = 77, options.min_separation = 0.1;
  const LineSearchOptions all = options;
  CHECK((all.max_checks == 77 && all.min_separation == 0.1 && all.gap_share == 0.2 && all.d_hat == 0));
  CHECK(LineSearch(s.mesh(), s.x, dx).largest_step().gap_share == 0.2);
  CHECK(LineSearch(s.mesh(), s.x, dx, options).largest_step().step ==
        LineSearch(s.mesh(), s.x, dx, keeping(0.2, options)).largest_step().step);
  CHECK(LineSearch(s.mesh(), s.x, dx, options).largest_step().step <
        LineSearch(s.mesh(), s.x, dx, keeping(0.1, options)).largest_step().step);
}

TEST_CASE("line search arguments out of range are rejected, bad motion is an outcome", "[unit]") {
  TwoTriangles s;
  const Eigen::MatrixXd dx = s.target - s.x;
  CHECK_THROWS_AS(LineSearch(s.mesh(), s.x, dx, keeping(1.0)), std::invalid_argument);
  CHECK_THROWS_AS(LineSearch(s.mesh(), s.x, dx, keeping(NAN)), std::invalid_argument);
  CHECK_THROWS_AS(LineSearch(s.mesh(), s.x, dx.topRows(4)), std::invalid_argument);
  CHECK_THROWS_AS(LineSearch(s.mesh(), s.x, dx).largest_step(1.5), std::invalid_argument);
  Eigen::MatrixXd broken = dx;
  broken(2, 1) = NAN;
  const LineSearchStep r = LineSearch(s.mesh(), s.x, broken).largest_step();
  CHECK(r.outcome == Outcome::non_finite);
  CHECK(r.vertex == 2);
  CHECK(r.step == 0);
}
