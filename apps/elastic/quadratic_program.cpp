#include "elastic/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "simulation/system.hpp"

namespace elastic {
namespace {

using simulation::Vector;
using Sparse = Eigen::SparseMatrix<double>;
using RowSparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr double kStiffness = 1e3;  // of a row's penalty, in those of what the row moves
constexpr double kStill = 1e-3;     // of the accuracy: a change of x that is none
constexpr double kProgress =
    0.25;  // a round that leaves more of the last one's change is slow: penalties grow ...
constexpr double kStiffer = 10;    // ... by so much ...
constexpr double kStiffest = 1e6;  // ... and no further: rounding
constexpr int kRounds = 50;  // in which multipliers follow the rows, before rows are taken for contradictory
constexpr int kFactorizations = 200;  // in one round: the active set may not change for ever, by rounding

// The augmented Lagrangian of a program with given multipliers, and the x that minimizes it.
class Lagrangian {
 public:
  // weights: the penalty of each row.
  Lagrangian(const QuadraticProgram& program, Vector weights, Vector x)
      : program_(program), A_(program.A), weights_(std::move(weights)), x_(std::move(x)) {}

  const Vector& x() const { return x_; }
  void set_weights(Vector weights) { weights_ = std::move(weights), factorized_ = false; }

  // lambda + rho (b - A x), whose positive part is the multipliers at x.
  Vector forces(const Vector& multipliers) const {
    return multipliers + weights_.cwiseProduct(program_.bound - A_ * x_);
  }

  // Goes to the minimum where the rows with multipliers are active and no others: a guess of these is worth
  // more than one of x, from which Newton's method finds them one after the other.
  void go_to(const Vector& multipliers) {
    factorize(multipliers);
    const auto none = Vector::Zero(multipliers.size());
    const Vector force =
        (multipliers.array() > 0).select(multipliers + weights_.cwiseProduct(program_.bound), none);
    x_ = factor_.solve(program_.rhs + A_.transpose() * force);
  }

  // Newton's method, which is finite here: the Lagrangian is quadratic where the active set does not change.
  // It ends, too, where x moves by less than `least`: rounding may let rows come and go at the minimum.
  bool minimize(const Vector& multipliers, double least) {
    for (int i = 0; i < kFactorizations; ++i) {
      const Vector force = forces(multipliers);
      factorize(force);
      const Vector Hx = program_.lower.selfadjointView<Eigen::Lower>() * x_;
      const Vector downhill = program_.rhs - Hx + A_.transpose() * force.cwiseMax(0);
      const Vector dx = factor_.solve(downhill);
      const double step = line_search(dx, downhill.dot(dx), force);
      x_ += step * dx;
      if (step == 1 && ((forces(multipliers).array() > 0) == (force.array() > 0)).all()) return true;
      if (step * dx.lpNorm<Eigen::Infinity>() <= least) return true;
    }
    return false;
  }

 private:
  // H + A^T rho A of the active rows.
  void factorize(const Vector& force) {
    std::vector<char> active(std::size_t(force.size()));
    for (std::size_t r = 0; r < active.size(); ++r) active[r] = force[Eigen::Index(r)] > 0;
    if (factorized_ && active == active_) return;
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index r = 0; r < A_.rows(); ++r)
      if (active[std::size_t(r)])
        for (RowSparse::InnerIterator e(A_, r); e; ++e)
          entries.emplace_back(r, e.col(), std::sqrt(weights_[r]) * e.value());
    Sparse rows(A_.rows(), A_.cols());
    rows.setFromTriplets(entries.begin(), entries.end());
    const Sparse normal = Sparse(rows.transpose()) * rows;
    factor_.compute(program_.lower + Sparse(normal.triangularView<Eigen::Lower>()));
    if (factor_.info() != Eigen::Success) throw std::runtime_error("the quadratic program is not convex");
    active_ = std::move(active);
    factorized_ = true;
  }

  // The t in [0, 1] where the derivative along dx, which grows and is linear between the times at which a row
  // becomes active or ceases to be, is zero; 1 where it is not positive there.
  double line_search(const Vector& dx, double downhill, const Vector& force) const {
    const Vector along = weights_.cwiseProduct(A_ * dx);  // force falls by t times this
    double slope = dx.dot(program_.lower.selfadjointView<Eigen::Lower>() * dx);
    std::vector<std::pair<double, double>> changes;  // time, and what the slope changes by
    for (Eigen::Index r = 0; r < force.size(); ++r) {
      if (along[r] == 0) continue;
      const double curvature = along[r] * along[r] / weights_[r];
      if (force[r] > 0) slope += curvature;
      const double t = force[r] / along[r];
      if (t > 0 && t < 1) changes.emplace_back(t, force[r] > 0 ? -curvature : curvature);
      if (force[r] == 0 && along[r] < 0) slope += curvature;
    }
    std::sort(changes.begin(), changes.end());
    double t = 0, derivative = -downhill;
    for (const auto& [until, change] : changes) {
      const double next = derivative + slope * (until - t);
      if (next >= 0) return std::max(0.0, t - derivative / slope);
      t = until, derivative = next, slope += change;
    }
    const double end = derivative + slope * (1 - t);
    return end > kRounding * downhill ? std::max(0.0, t - derivative / slope) : 1;
  }

  static constexpr double kRounding = 1e-9;  // of the first derivative: the last one is zero but for rounding

  const QuadraticProgram& program_;
  const RowSparse A_;
  Vector weights_;
  Vector x_;
  std::vector<char> active_;
  bool factorized_ = false;
  Eigen::SimplicialLDLT<Sparse> factor_;
};

// As stiff as kStiffness times the vertices that a row moves, without their neighbours.
Vector penalties(const QuadraticProgram& program) {
  const Vector diagonal = program.lower.diagonal();
  Vector weights(program.A.rows());
  const RowSparse A = program.A;
  for (Eigen::Index r = 0; r < A.rows(); ++r) {
    double compliance = 0;
    for (RowSparse::InnerIterator e(A, r); e; ++e) compliance += e.value() * e.value() / diagonal[e.col()];
    weights[r] = compliance > 0 ? kStiffness / compliance : 1;
  }
  return weights;
}

std::optional<QuadraticSolution> solve_hard(const QuadraticProgram& program, double accuracy) {
  Vector weights = penalties(program);
  Lagrangian lagrangian(program, weights, program.x_guess);
  double latest = INFINITY, stiffness = kStiffness;
  Vector multipliers = program.multipliers_guess;
  if (multipliers.maxCoeff() > 0) lagrangian.go_to(multipliers);
  for (int round = 0; round < kRounds; ++round) {
    if (!lagrangian.minimize(multipliers, kStill * accuracy)) return {};
    const Vector next = lagrangian.forces(multipliers).cwiseMax(0);
    const double change = (next - multipliers).cwiseQuotient(weights).lpNorm<Eigen::Infinity>();
    multipliers = next;
    if (change <= accuracy) return QuadraticSolution{lagrangian.x(), multipliers, true};
    if (change > kProgress * latest && stiffness < kStiffest) {
      stiffness *= kStiffer, weights *= kStiffer;
      lagrangian.set_weights(weights);
    }
    latest = change;
  }
  return {};
}

}  // namespace

QuadraticSolution solve(const QuadraticProgram& program, double accuracy, double penalty) {
  if (auto found = solve_hard(program, accuracy)) return *found;
  const Vector none = Vector::Zero(program.A.rows());
  Lagrangian soft(program, Vector::Constant(program.A.rows(), penalty), program.x_guess);
  if (!soft.minimize(none, kStill * accuracy))
    throw std::runtime_error("the quadratic program has no solution");
  return {soft.x(), soft.forces(none).cwiseMax(0), false};
}

}  // namespace elastic
