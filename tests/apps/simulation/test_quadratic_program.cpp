// The quadratic programs of the elastic bodies: what they return solves them, at the sizes that contacts
// have.
#include <algorithm>
#include <cmath>
#include <random>

#include "elastic/quadratic_program.hpp"
#include "tests/catch.hpp"

namespace {

using namespace elastic;

constexpr double kAccuracy = 1e-9;  // m, where forces are thousands of newtons

// A chain of springs, each of its links pushed down, some of which must not go below a floor.
QuadraticProgram chain(int links, double stiffness, double force, double floor) {
  std::vector<Eigen::Triplet<double>> lower, rows;
  for (int i = 0; i < links; ++i) {
    lower.emplace_back(i, i, 2.01 * stiffness);
    if (i > 0) lower.emplace_back(i, i - 1, -stiffness);
  }
  int count = 0;
  for (int i = 0; i < links; i += 3) rows.emplace_back(count++, i, 1);
  QuadraticProgram program{Eigen::SparseMatrix<double>(links, links),
                           Eigen::VectorXd::Zero(links),
                           Eigen::SparseMatrix<double>(count, links),
                           Eigen::VectorXd::Constant(count, floor),
                           Eigen::VectorXd::Zero(links),
                           Eigen::VectorXd::Zero(count)};
  for (int i = 0; i < links; ++i) program.rhs[i] = -force * (1.5 + std::sin(0.1 * i));
  program.lower.setFromTriplets(lower.begin(), lower.end());
  program.A.setFromTriplets(rows.begin(), rows.end());
  return program;
}

void check_solved(const QuadraticProgram& program, const QuadraticSolution& found) {
  const Eigen::VectorXd gap = program.A * found.x - program.bound;
  CHECK(gap.minCoeff() > -2 * kAccuracy);
  CHECK(found.multipliers.minCoeff() >= 0);
  const double largest = program.rhs.lpNorm<Eigen::Infinity>();
  const Eigen::VectorXd force = program.lower.selfadjointView<Eigen::Lower>() * found.x - program.rhs -
                                program.A.transpose() * found.multipliers;
  CHECK(force.lpNorm<Eigen::Infinity>() < 1e-5 * largest);
  for (Eigen::Index r = 0; r < gap.size(); ++r)
    CHECK((found.multipliers[r] < 1e-4 * largest || gap[r] < 1e-7));
}

}  // namespace

TEST_CASE("a quadratic program is solved whatever the size of its forces", "[unit]") {
  for (const double force : {1e-2, 1.0, 1e3, 1e6, 1e8}) {
    const QuadraticProgram program = chain(300, 1e4 * force, force, -1e-4);
    const QuadraticSolution found = solve(program, kAccuracy, 1e9 * force);
    CHECK(found.feasible);
    check_solved(program, found);
    CHECK(found.multipliers.maxCoeff() > force);
  }
}

TEST_CASE("rows that repeat each other, in any number, are kept from any guess", "[unit]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    QuadraticProgram program = chain(60, 1e4, 10, -1e-4);
    const int count = 1 + trial * 3;
    std::vector<Eigen::Triplet<double>> rows;
    program.bound = Eigen::VectorXd::Zero(count);
    program.multipliers_guess = Eigen::VectorXd::Zero(count);
    const Eigen::VectorXd inside = Eigen::VectorXd::NullaryExpr(60, [&] { return 1e-3 * uniform(random); });
    for (int r = 0; r < count; ++r) {
      const bool repeats = r > 0 && r % 3 == 0;
      for (int k = 0; k < 12; ++k) {
        if (repeats)
          rows.emplace_back(r, rows[std::size_t(12 * (r - 1) + k)].col(),
                            rows[std::size_t(12 * (r - 1) + k)].value());
        else
          rows.emplace_back(r, int(random() % 60), uniform(random));
      }
      if (trial % 2 == 1) program.multipliers_guess[r] = 100 * std::max(0.0, uniform(random));
    }
    program.A.resize(count, 60);
    program.A.setFromTriplets(rows.begin(), rows.end());
    program.bound = program.A * inside - Eigen::VectorXd::Constant(count, trial % 3 == 0 ? 0.0 : 1e-6);
    const QuadraticSolution found = solve(program, kAccuracy, 1e10);
    CHECK(found.feasible);
    check_solved(program, found);
  }
}

TEST_CASE("rows that contradict each other give way", "[unit]") {
  QuadraticProgram program = chain(6, 1e4, 1, -1e-4);
  std::vector<Eigen::Triplet<double>> rows{{0, 0, 1}, {1, 0, -1}};  // x0 >= 1e-3 and -x0 >= 1e-3
  program.A.setFromTriplets(rows.begin(), rows.end());
  program.bound = Eigen::Vector2d(1e-3, 1e-3);
  const QuadraticSolution found = solve(program, kAccuracy, 1e9);
  CHECK_FALSE(found.feasible);
  CHECK(std::fabs(found.x[0]) < 1e-4);  // half of the way between them
  CHECK(found.x.size() == 6);
}
