// What is asked about a vertex and a plane.
#pragma once

#include <array>

namespace onset {

// The vertex moves from x0 to x1, three coordinates each in the order of `normal`.
struct PlaneQuestion {
  std::array<double, 3> normal;
  double offset;
  const double *x0, *x1;
  // What the two must keep, >= 0: model length, in the norm asked for.
  double separation;
  bool maximum_norm;
};

}  // namespace onset
