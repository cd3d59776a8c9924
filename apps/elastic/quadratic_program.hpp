// A sparse quadratic program with linear inequalities, solved by ProxQP.
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

// Whether the program was built with the solver.
bool has_quadratic_solver();

// Minimizes 1/2 x . H x + g . x where A x >= bound, to an accuracy of `accuracy` in A x. Where no x will do,
// or none is found, rows give way by s, at a price of penalty / 2 |s|^2; the last attempt is less accurate.
//
// Source: Bambade, El-Kazdadi, Taylor, Carpentier, "ProxQP: yet another quadratic programming solver for
// robotics and beyond", Robotics: Science and Systems 2022.
// Throws std::runtime_error where that fails too.
QuadraticSolution solve(const QuadraticProgram& program, double accuracy, double penalty);

}  // namespace elastic
