#include "src/trajectory/proof.hpp"

#include <algorithm>

#include "narrowphase/distance/closest_points.hpp"
#include "src/trajectory/crossing.hpp"

namespace onset {
namespace {

// Of the step: the first try, after toi.
constexpr double kFirstTry = 0x1p-44;

PairBoxes boxes(Pieces& pieces, const Contact& contact, double t0, double t1) {
  PairBoxes r;
  for (std::size_t i = 0; i < 4; ++i) r[i] = pieces.box(contact.vertices[i], t0, t1);
  return r;
}

// What the pair must keep, rounded down.
double separation_of(const std::vector<double>& thickness, double min_separation, const Contact& contact) {
  if (thickness.empty()) return min_separation;
  double largest[2] = {0, 0};
  for (int i = 0; i < 4; ++i) {
    double& side = largest[i >= points_of_first_side(contact.kind)];
    side = std::max(side, thickness[std::size_t(contact.vertices[std::size_t(i)])]);
  }
  return (min_separation + largest[0] + largest[1]) * (1 - 0x1p-51);
}

// The distance of the middles of the boxes, and how far a vertex is from its own at most, are no more than
// the separation together.
bool is_within(double separation, const Contact& contact, const PairBoxes& at) {
  if (separation == 0) return false;
  double x[4][3], strays[2] = {0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    double wide = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      x[i][a] = 0.5 * (at[i].lo[a] + at[i].hi[a]);
      wide = std::max({wide, at[i].hi[a] - x[i][a], x[i][a] - at[i].lo[a]});
    }
    double& side = strays[int(i) >= points_of_first_side(contact.kind)];
    side = std::max(side, 1.75 * wide);  // sqrt(3), rounded up
  }
  const double* const points[4] = {x[0], x[1], x[2], x[3]};
  return (closest_points(contact.kind, points).upper + strays[0] + strays[1]) * (1 + 0x1p-50) <= separation;
}

}  // namespace

void prove(Pieces& pieces, const std::vector<double>& thickness, double min_separation, Contact& contact) {
  const double separation = separation_of(thickness, min_separation, contact);
  const double toi = contact.toi;
  const PairBoxes first = boxes(pieces, contact, toi, toi);
  for (double length = kFirstTry, t = 0; t < 1; length *= 4) {
    t = std::min(toi + length, 1.0);
    if (!(t > toi)) continue;
    const PairBoxes last = boxes(pieces, contact, t, t);
    if (!is_certain_to_cross(contact.kind, first, last, boxes(pieces, contact, toi, t)) &&
        !is_within(separation, contact, last))
      continue;
    contact.certainty = Certainty::certain, contact.toi_hi = t;
    return;
  }
}

}  // namespace onset
