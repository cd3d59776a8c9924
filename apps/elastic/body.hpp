// Elastic bodies of tetrahedra: the stable neo-Hookean material of Smith, de Goes, Kim, "Stable neo-Hookean
// flesh simulation", ACM Transactions on Graphics 37(2), 2018.
#pragma once

#include <array>
#include <vector>

#include "simulation/system.hpp"

namespace elastic {

using namespace simulation;

using Tetrahedron = std::array<int, 4>;

struct Material {
  double density = 1000;  // kg / m^3
  double young = 1e5;     // Pa
  double poisson = 0.4;   // in (0, 0.5)
};

// psi(F) = mu/2 (|F|^2 - 3) - mu/2 ln(|F|^2 + 1) + lambda/2 (det F - alpha)^2, finite for every F, flat and
// inverted elements included, and without stress at rest. For small strains it is Hooke's law of the given
// modulus and ratio.
class NeoHookean {
 public:
  explicit NeoHookean(const Material& material);

  double energy(const Mat3& F) const;  // J / m^3
  Mat3 stress(const Mat3& F) const;    // the first Piola-Kirchhoff stress, its gradient
  // By the columns of F, one below the other; not projected.
  Eigen::Matrix<double, 9, 9> stiffness(const Mat3& F) const;

 private:
  double mu_, lambda_, alpha_;
};

class Bodies {
 public:
  // Elements none of whose vertices is free take no part but with their mass.
  // Throws std::invalid_argument naming the element that has no volume at rest.
  Bodies(const Vector& rest, const std::vector<Tetrahedron>& tetrahedra, const std::vector<char>& is_free,
         const Material& material);

  double energy(const Vector& x) const;
  void add_derivatives(const Vector& x, System& system) const;  // each element's Hessian projected
  const std::vector<double>& masses() const { return mass_; }   // kg, 0 for vertices of no element
  // The least volume of an element that takes part, as a share of that at rest: <= 0 where one is inverted.
  double least_volume(const Vector& x) const;

 private:
  struct Element {
    Tetrahedron vertices;
    Mat3 inverse;  // of the edges at rest from the first vertex
    double volume;
  };
  Mat3 deformation(const Element& e, const Vector& x) const;

  NeoHookean material_;
  std::vector<double> mass_;
  std::vector<Element> elements_;
};

}  // namespace elastic
