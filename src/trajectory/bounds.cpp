#include "src/trajectory/bounds.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "scene/motion/motion.hpp"

namespace onset {

Outcome fault_of(int vertex, const double* from, const double* to, double bound) {
  if (bound < 0)
    throw std::invalid_argument("the bound of straying of vertex " + std::to_string(vertex) + " is below 0");
  Outcome worst = Outcome::free;
  for (const double x : {from[0], from[1], from[2], to[0], to[1], to[2], bound}) {
    if (!std::isfinite(x)) return Outcome::non_finite;
    if (std::fabs(x) > kMaxCoordinate) worst = Outcome::out_of_range;
  }
  return worst;
}

Fault ask_straying(const Trajectory& trajectory, double t0, double t1, const int* vertices, std::size_t count,
                   double* bounds) {
  constexpr double kOrigin[3] = {0, 0, 0};
  trajectory.straying(t0, t1, vertices, count, bounds);
  Fault first;
  for (std::size_t i = 0; i < count; ++i)
    if (const Outcome o = fault_of(vertices[i], kOrigin, kOrigin, bounds[i]);
        o != Outcome::free && first.outcome == Outcome::free)
      first = {o, vertices[i]};
  return first;
}

}  // namespace onset
