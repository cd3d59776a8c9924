#include "narrowphase/distance/maximum_norm.hpp"

#include <algorithm>
#include <cmath>

namespace onset {
namespace {

using Precise = VecOf<DoubleDouble>;

// Keeps the direction, in the sign that separates better, whose margin is the largest.
class Best {
 public:
  explicit Best(const Differences<DoubleDouble>& d) : d_(d) {}

  void consider(const Precise& direction) {
    Vec w = rounded(direction);
    const double size = largest_component(w);
    if (!(size > 0x1p-400)) return;
    w = std::ldexp(1.0, -std::ilogb(size)) * w;
    const Precise exact{{w[0], w[1], w[2]}};
    DoubleDouble low = dot(exact, d_.corner[0]), high = low;
    for (int k = 1; k < d_.corners(); ++k) {
      const DoubleDouble here = dot(exact, d_.corner[k]);
      if (here < low) low = here;
      if (here > high) high = here;
    }
    const bool turned = -high > low;
    const DoubleDouble sum = DoubleDouble(std::fabs(w[0])) + std::fabs(w[1]) + std::fabs(w[2]);
    const DoubleDouble margin = (turned ? -high : low) / sum;
    if (found_ && !(margin > margin_)) return;
    found_ = true, margin_ = margin, w_ = turned ? -1 * w : w;
  }
  Vec direction() const { return unit(w_); }

 private:
  const Differences<DoubleDouble>& d_;
  bool found_ = false;
  DoubleDouble margin_;
  Vec w_{};
};

}  // namespace

// The candidates are those of docs/theory.md, L8.
Vec best_direction_in_maximum_norm(const Differences<DoubleDouble>& d) {
  Best best(d);
  for (int a = 0; a < 3; ++a) {
    Precise axis{};
    axis[a] = 1.0;
    best.consider(axis);
    for (const Precise& edge : {d.a, d.b, d.b - d.a}) best.consider(cross(edge, axis));
  }
  best.consider(cross(d.a, d.b));
  return best.direction();
}

// Any direction w bounds the distance from below by min_k w.c_k / |w|_1. The products err by less than 145
// u^2 of the size with their corners (docs/theory.md, L43), for which 2^-97 is taken; the factors cover the
// rounding of `hi`, of |w|_1 (two sums), of the difference and of the quotient.
double distance_below_in_maximum_norm(PairKind kind, const double* const (&x)[4]) {
  const PreciseMotion motion(kind, x, x);
  if (motion.size == 0) return 0;
  const Differences<DoubleDouble>& d = motion.start;
  const Vec w = best_direction_in_maximum_norm(d);
  const double size = sum_of_magnitudes(w);
  if (!(size > 0)) return 0;
  const Precise exact{{w[0], w[1], w[2]}};
  DoubleDouble low = dot(exact, d.corner[0]);
  for (int k = 1; k < d.corners(); ++k)
    if (const DoubleDouble here = dot(exact, d.corner[k]); here < low) low = here;
  const double lower = (low.hi * (1 - 0x1p-51) - 0x1p-97 * motion.size) / size * (1 - 0x1p-49);
  return std::max(0.0, lower * motion.unit - 0x1p-1074);
}

}  // namespace onset
