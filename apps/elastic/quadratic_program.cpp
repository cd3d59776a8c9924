#include "elastic/quadratic_program.hpp"

#include <limits>
#include <optional>
#include <proxsuite/proxqp/sparse/sparse.hpp>
#include <stdexcept>

namespace elastic {
namespace {

using simulation::Vector;
using Sparse = Eigen::SparseMatrix<double>;
namespace qp = proxsuite::proxqp;

constexpr double kForces = 1e-6;     // accuracy of forces, of the largest one without rows
constexpr double kLastResort = 100;  // by how much less accurate what has no solution may be

// None where it ends without a solution.
std::optional<QuadraticSolution> attempt(const Sparse& H, const Vector& g, const Sparse& A,
                                         const Vector& bound, const Vector& x, const Vector& multipliers,
                                         double accuracy) {
  qp::sparse::QP<double, int> solver(H.cols(), 0, A.rows());
  solver.settings.eps_abs = accuracy;
  solver.settings.eps_rel = 0;
  solver.settings.max_iter = 100;
  solver.settings.initial_guess = qp::InitialGuessStatus::WARM_START;
  solver.settings.sparse_backend = qp::SparseBackend::SparseCholesky;
  const Vector none = Vector::Constant(A.rows(), std::numeric_limits<double>::infinity());
  solver.init(H, g, proxsuite::nullopt, proxsuite::nullopt, A, bound, none);
  solver.solve(x, Vector(), Vector(-multipliers));
  if (solver.results.info.status != qp::QPSolverOutput::PROXQP_SOLVED) return {};
  return QuadraticSolution{solver.results.x, (-solver.results.z).cwiseMax(0), true};
}

// One more unknown a row.
QuadraticProgram softened(const QuadraticProgram& program, double penalty) {
  const Eigen::Index n = program.A.cols(), rows = program.A.rows();
  QuadraticProgram soft{Sparse(n + rows, n + rows), Vector::Zero(n + rows),
                        Sparse(rows, n + rows),     program.bound,
                        Vector::Zero(n + rows),     program.multipliers_guess};
  soft.x_guess.head(n) = program.x_guess;
  soft.rhs.head(n) = program.rhs;
  std::vector<Eigen::Triplet<double>> lower, A;
  for (Eigen::Index c = 0; c < n; ++c) {
    for (Sparse::InnerIterator e(program.lower, c); e; ++e) lower.emplace_back(e.row(), c, e.value());
    for (Sparse::InnerIterator e(program.A, c); e; ++e) A.emplace_back(e.row(), c, e.value());
  }
  for (Eigen::Index r = 0; r < rows; ++r)
    lower.emplace_back(n + r, n + r, penalty), A.emplace_back(r, n + r, 1);
  soft.lower.setFromTriplets(lower.begin(), lower.end());
  soft.A.setFromTriplets(A.begin(), A.end());
  return soft;
}

// ProxQP has one accuracy for rows and for forces, which rounding does not let it reach where they differ
// much in size: the objective is scaled, and the multipliers with it, so that the same number suits both.
std::optional<QuadraticSolution> attempt(const QuadraticProgram& program, double accuracy) {
  const double largest = program.rhs.lpNorm<Eigen::Infinity>();
  const double scale = largest > 0 ? accuracy / (kForces * largest) : 1;
  const Sparse H = scale * Sparse(program.lower.selfadjointView<Eigen::Lower>());
  auto found = attempt(H, -scale * program.rhs, program.A, program.bound, program.x_guess,
                       scale * program.multipliers_guess, accuracy);
  if (found) found->multipliers /= scale;
  return found;
}

}  // namespace

bool has_quadratic_solver() { return true; }

QuadraticSolution solve(const QuadraticProgram& program, double accuracy, double penalty) {
  if (auto found = attempt(program, accuracy)) return *found;
  const QuadraticProgram soft = softened(program, penalty);
  auto found = attempt(soft, accuracy);
  if (!found) found = attempt(soft, kLastResort * accuracy);
  if (!found) throw std::runtime_error("the quadratic program has no solution");
  found->x.conservativeResize(program.A.cols());
  found->feasible = false;
  return *found;
}

}  // namespace elastic
