// What keeps surfaces apart and drags them along: a logarithmic barrier and friction on the pairs within
// d-hat.
#pragma once

#include <onset/close_pairs.hpp>

#include "simulation/system.hpp"

namespace simulation {

// kappa b(d^2 / d_hat^2) for each pair, with b(s) = -(s - 1)^2 ln s below 1 and 0 above: twice continuously
// differentiable, infinite at contact (Li et al. 2020, "Incremental potential contact", eq. 6).
class Barrier {
 public:
  Barrier(double kappa, double d_hat) : kappa_(kappa), d_hat_(d_hat) {}

  double energy(const onset::ClosePairs& close) const;  // at the positions `close` was made for
  void add_derivatives(const onset::ClosePairs& close, const std::vector<onset::Plane>& planes,
                       const Vector& x, System& system) const;
  double force(double distance) const;  // pushing apart, >= 0

 private:
  double kappa_, d_hat_;
};

// Coulomb friction with the contacts' normals and forces of the step's start (Li et al. 2020, section 5): a
// convex potential of the sideways displacement since then, smooth below `slip`.
class Friction {
 public:
  Friction(double coefficient, double slip, const Barrier& barrier, const onset::ClosePairs& close,
           const std::vector<onset::Plane>& planes, const Vector& x);

  double energy(const Vector& x) const;
  void add_derivatives(const Vector& x, System& system) const;

 private:
  struct Contact {
    std::array<int, 4> vertices;
    std::array<double, 4> weights;
    Vec3 normal, start;
    double limit;  // N, the largest force sideways
  };
  Vec3 slid(const Contact& c, const Vector& x) const;

  double slip_;
  std::vector<Contact> contacts_;
};

}  // namespace simulation
