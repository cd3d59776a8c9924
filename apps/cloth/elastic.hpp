// What holds a cloth together: springs along edges, and bending.
#pragma once

#include <array>
#include <vector>

#include "simulation/system.hpp"

namespace cloth {

using namespace simulation;

struct Material {
  double density = 0.2;   // kg / m^2
  double stretch = 100;   // N / m, of one spring
  double bending = 1e-4;  // N m
};

class Elastic {
 public:
  // Rest shape: flat positions and the faces of the cloth alone.
  Elastic(const Vector& rest, const std::vector<std::array<int, 3>>& faces, const Material& material);

  double energy(const Vector& x) const;
  void add_derivatives(const Vector& x, System& system) const;  // the Hessian projected
  const std::vector<double>& masses() const { return mass_; }   // kg, 0 for vertices of no face

 private:
  struct Spring {
    int a, b;
    double length;
  };
  // Quadratic bending for a flat rest shape (Bergou et al. 2006, "A quadratic bending model for inextensible
  // surfaces"): stiffness / 2 |sum weight_i x_i|^2 for the edge 0 1 and the vertices 2, 3 opposite.
  struct Hinge {
    std::array<int, 4> vertices;
    std::array<double, 4> weights;
    double stiffness;
  };
  void add_hinge(const Vector& rest, int a, int b, int c, int d, double bending);

  double stretch_;
  std::vector<double> mass_;
  std::vector<Spring> springs_;
  std::vector<Hinge> hinges_;
};

}  // namespace cloth
