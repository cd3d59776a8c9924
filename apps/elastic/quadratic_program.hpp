// A sparse quadratic program with linear inequalities, by augmented Lagrangians.
#pragma once

#include <Eigen/Sparse>

#include "simulation/system.hpp"

namespace elastic {

struct QuadraticProgram {
  Eigen::SparseMatrix<double> lower;  // of H, positive definite
  Eigen::VectorXd rhs;                // -g
  Eigen::SparseMatrix<double> A;
  Eigen::VectorXd bound;
  Eigen::VectorXd x_guess, multipliers_guess;  // where to start: it changes x within the accuracy
};

struct QuadraticSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd multipliers;  // >= 0, one a row
  bool feasible = true;         // false: the rows contradict each other, or nearly, and were softened
};

// Minimizes 1/2 x . H x + g . x where A x >= bound, to an accuracy of `accuracy` in A x: multipliers follow
// the rows' violation, and between these rounds Newton's method with an exact line search minimizes the
// augmented Lagrangian, whose Hessian H + A^T rho A of the active rows is factorized anew where they change.
// Where no x will do, or none is found, rows give way by s, at a price of penalty / 2 |s|^2.
//
// Sources: Rockafellar, "Augmented Lagrange multiplier functions and duality in nonconvex programming", SIAM
// J. Control 12 (1974); Li, Sun, Toh, "A highly efficient semismooth Newton augmented Lagrangian method for
// solving Lasso problems", SIAM J. Optim. 28 (2018), for its inner method.
// Throws std::runtime_error where H is not positive definite.
QuadraticSolution solve(const QuadraticProgram& program, double accuracy, double penalty);

}  // namespace elastic
