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

}  // namespace onset
