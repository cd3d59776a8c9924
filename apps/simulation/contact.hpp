// What keeps surfaces apart and drags them along: a logarithmic barrier and friction on the pairs within
// d-hat.
#pragma once

#include <onset/close_pairs.hpp>

#include "simulation/system.hpp"

namespace simulation {

// kappa b(d^2 / d_hat^2) for each pair, with b(s) = -(s - 1)^2 ln s below 1 and 0 above: twice continuously
// differentiable, infinite at contact (Li et al. 2020, "Incremental potential contact", eq. 6).
//
// With a rest shape the barrier of two edges is multiplied by a mollifier that goes to 0 as they become
// parallel, where the closest points jump (Li et al. 2020, section on parallel edge-edge contacts):
// m(c) = -c^2 / e^2 + 2 c / e below e and 1 above, c = |a x b|^2, e = 1e-3 |a|^2 |b|^2 at rest.
class Barrier {
 public:
  Barrier(double kappa, double d_hat) : kappa_(kappa), d_hat_(d_hat) {}
  Barrier(double kappa, double d_hat, const Vector& rest) : kappa_(kappa), d_hat_(d_hat), rest_(rest) {}

  double energy(const onset::ClosePairs& close) const;  // at the positions `close` was made for, no mollifier
  double energy(const onset::ClosePairs& close, const Vector& x) const;
  // The Hessian is projected to be positive semidefinite, that of an energy with mollifier as a whole.
  void add_derivatives(const onset::ClosePairs& close, const std::vector<onset::Plane>& planes,
                       const Vector& x, System& system) const;
  double force(double distance) const;  // pushing apart, >= 0

  // Energy, gradient and Hessian, not projected, of two edges whose mollifier is below 1.
  struct Mollified {
    double energy;
    Eigen::Matrix<double, 12, 1> gradient;
    Eigen::Matrix<double, 12, 12> hessian;
  };
  bool is_mollified(const onset::ClosePair& pair, const Vector& x) const;
  Mollified mollified(const onset::ClosePair& pair, const Vector& x) const;

 private:
  double threshold(const onset::ClosePair& pair) const;  // e
  struct Slopes {
    double value, first, second;  // of kappa b, by the distance squared
  };
  Slopes slopes(double squared) const;

  double kappa_, d_hat_;
  Vector rest_;  // empty: no mollifier
};

// Coulomb friction with the contacts' normals and forces of the step's start (Li et al. 2020, section 5): a
// convex potential of the sideways displacement since then, smooth below `slip`.
class Friction {
 public:
  struct Contact {
    std::array<int, 4> vertices;
    std::array<double, 4> weights;
    Vec3 normal, start;  // start: the sum of weights times positions when the step began
    double limit;        // N, the largest force sideways
  };
  Friction(double slip, std::vector<Contact> contacts) : slip_(slip), contacts_(std::move(contacts)) {}
  // That of a barrier.
  Friction(double coefficient, double slip, const Barrier& barrier, const onset::ClosePairs& close,
           const std::vector<onset::Plane>& planes, const Vector& x);

  double energy(const Vector& x) const;
  void add_derivatives(const Vector& x, System& system) const;

 private:
  Vec3 slid(const Contact& c, const Vector& x) const;

  double slip_;
  std::vector<Contact> contacts_;
};

// The vector between the points that the weights give, from the second primitive to the first.
Vec3 between(const std::array<int, 4>& vertices, const std::array<double, 4>& weights, const Vector& x);

}  // namespace simulation
