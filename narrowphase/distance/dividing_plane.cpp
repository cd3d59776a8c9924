#include "narrowphase/distance/dividing_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/distance/closest_points.hpp"
#include "narrowphase/distance/double_double.hpp"
#include "narrowphase/distance/maximum_norm.hpp"
#include "narrowphase/distance/precise_differences.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// A difference rounds by u, a product by u, and the sums by 2u of what is added up: 4u and second order. What
// underflows is below 2^-1070 (V2).
Height quick_height(const DividingPlane& plane, const double* x) {
  double h = 0, size = 0;
  for (int a = 0; a < 3; ++a) {
    const double part = plane.normal[a] * ((x[a] - plane.origin[a]) * plane.scale);
    h += part, size += std::fabs(part);
  }
  const double error = 0x1.8p-51 * size + 0x1p-900;  // 12u
  return {h - error, h + error};
}

// Differences are exact, products err by 8u^2 and each of three sums by 3u^2: 17u^2 of what is added up, for
// which 64u^2 is taken. The last term covers what is lost by rounding to a double and below it, twice over
// (V2).
Height precise_height(const DividingPlane& plane, const double* x) {
  DoubleDouble h = 0.0;
  double size = 0;
  for (int a = 0; a < 3; ++a) {
    const DoubleDouble part =
        DoubleDouble(plane.normal[a]) * scaled(two_difference(x[a], plane.origin[a]), plane.scale);
    h = h + part, size += std::fabs(part.hi);
  }
  const double error = 0x1p-100 * size + 0x1p-899 + 0x1p-52 * std::fabs(h.hi);
  return {h.hi - error, h.hi + error};
}

// Orders of operations as in docs/theory.md, L47: 5u of the larger coordinate. The bound keeps away from
// infinity.
double rounding_of_height(const DividingPlane& plane, const double* x0, const double* x1) {
  double r = 0;
  for (int a = 0; a < 3; ++a)
    r += std::fabs(plane.normal[a]) *
         std::min(5.5 * 0x1p-53 * std::max(std::fabs(x0[a]), std::fabs(x1[a])) * plane.scale, 0x1p1000);
  return r + 0x1p-1070 * plane.scale;
}

bool on_side(const DividingPlane& plane, bool first, const double* x) {
  const Height quick = quick_height(plane, x);
  if (first ? quick.lower >= plane.first : quick.upper <= plane.second) return true;
  if (first ? quick.upper < plane.first : quick.lower > plane.second) return false;
  const Height precise = precise_height(plane, x);
  return first ? precise.lower >= plane.first : precise.upper <= plane.second;
}

namespace {

struct Points {
  PairKind kind;
  const double* const (&x0)[4];
  const double* const (&x1)[4];
  int side() const { return points_of_first_side(kind); }
};

// How the pair lies and moves along a normal. All of them are certified on the side that is named.
struct Extent {
  // The least height of the first primitive and the largest of the second at the start (lower, upper), and at
  // either end.
  double first, second, lowest, highest;
  // What storing can change.
  double first_rounding, second_rounding;
};

template <class Heights>
Extent extent_of(const Points& p, const DividingPlane& plane, Heights&& height) {
  Extent e{INFINITY, -INFINITY, INFINITY, -INFINITY, 0, 0};
  for (int k = 0; k < 4; ++k) {
    const Height start = height(plane, p.x0[k]), end = height(plane, p.x1[k]);
    const bool moves = !std::equal(p.x0[k], p.x0[k] + 3, p.x1[k]);
    const double rounding = moves ? rounding_of_height(plane, p.x0[k], p.x1[k]) : 0;
    if (k < p.side()) {
      e.first = std::min(e.first, start.lower), e.lowest = std::min(e.lowest, end.lower);
      e.first_rounding = std::max(e.first_rounding, rounding);
    } else {
      e.second = std::max(e.second, start.upper), e.highest = std::max(e.highest, end.upper);
      e.second_rounding = std::max(e.second_rounding, rounding);
    }
  }
  e.lowest = std::min(e.lowest, e.first), e.highest = std::max(e.highest, e.second);
  return e;
}

// The height of a distance of 1 along the normal.
double unit_height(const DividingPlane& plane, const Demand& demand) {
  const Vec n = vec(plane.normal);
  return plane.scale * (demand.maximum_norm ? sum_of_magnitudes(n) : std::sqrt(dot(n, n)));
}

// The separation as a difference of heights, rounded up.
double demanded(const DividingPlane& plane, const Demand& demand) {
  if (demand.separation == 0) return 0;
  return demand.separation * unit_height(plane, demand) * (1 + 0x1p-49) + 0x1p-1000;
}

// What is left of a sum of rounded terms, each at most 4u off.
constexpr double kLess = 1 - 0x1p-48, kMore = 1 + 0x1p-48;

struct Room {
  double gap, room, wanted;
  bool free, apart;
  // The share of its approach that the pair may go.
  double share() const { return room > 0 ? room / wanted : 0; }
};
Room room_of(const Extent& e, double separation, double gap_share) {
  Room r;
  r.apart = e.first > e.second;
  r.gap = (e.first - e.second) - separation;
  // Less what place() has to show of the separation.
  r.room = r.gap > 0 ? std::max(0.0, r.gap * (1 - gap_share) * kLess - 0x1p-47 * separation) : 0;
  r.wanted = (e.first - e.lowest) + e.first_rounding + (e.highest - e.second) + e.second_rounding;
  r.free = r.gap > 0 && r.wanted * kMore <= r.room;
  return r;
}

// Puts the plane's two sides where each primitive has its part of the room; where rounding leaves nothing of
// that, where the primitives are.
void place(const Extent& e, const Room& r, double separation, DividingPlane& plane) {
  const double first = (e.first - e.lowest) + e.first_rounding,
               second = (e.highest - e.second) + e.second_rounding;
  if (r.room > 0 && r.wanted > 0) {
    plane.first = std::min(e.first, e.first - r.room * (first / (first + second)));
    plane.second = std::max(e.second, e.second + r.room * (second / (first + second)));
    if ((plane.first - plane.second) * kLess > separation) return;
  }
  plane.first = e.first, plane.second = e.second;
}

// Tries normals, and keeps the one that lets the pair move by the largest share. Where none lets it move at
// all, because it starts within its separation or beyond by no more than rounding, that is the one along
// which it is farthest apart: nearly its distance (V3).
class Search {
 public:
  Search(const Points& points, const Demand& demand) : p_(points), demand_(demand) {}

  void set_frame(const double (&weights)[4]) {
    int nearest = p_.side();
    for (int k = p_.side(); k < 4; ++k)
      if (std::fabs(weights[k]) > std::fabs(weights[nearest])) nearest = k;
    std::copy_n(p_.x0[nearest], 3, frame_.origin);
    double largest = 0;
    for (int k = 0; k < 4; ++k)
      for (int a = 0; a < 3; ++a)
        largest = std::max(
            {largest, std::fabs(p_.x0[k][a] - frame_.origin[a]), std::fabs(p_.x1[k][a] - frame_.origin[a])});
    frame_.scale = inverse_unit(largest);
  }

  // Says whether no pace along this normal brings the pair together.
  bool frees(const Vec& normal) {
    if (!(dot(normal, normal) > 0)) return false;
    DividingPlane plane = frame_;
    for (int a = 0; a < 3; ++a) plane.normal[a] = normal[a];
    const double separation = demanded(plane, demand_);
    Room r = room_of(extent_of(p_, plane, quick_height), separation, demand_.gap_share);
    if (r.free) return true;
    const Extent e = extent_of(p_, plane, precise_height);
    r = room_of(e, separation, demand_.gap_share);
    if (r.free) return true;
    if (!r.apart) return false;
    const double share = r.share(), distance = (e.first - e.second) / unit_height(plane, demand_);
    if (found_ && !(share > share_ || (share == share_ && distance > distance_))) return false;
    found_ = true, share_ = share, distance_ = distance;
    place(e, r, separation, plane);
    best_ = plane;
    return false;
  }
  bool found() const { return found_; }
  const DividingPlane& best() const { return best_; }

 private:
  const Points p_;
  const Demand& demand_;
  DividingPlane frame_{}, best_{};
  bool found_ = false;
  double share_ = 0, distance_ = 0;
};

}  // namespace

// The normals tried are those of the closest points at the start, at the end, with one primitive gone and the
// other not, and means of these with the first. Any would be safe.
Division divide(PairKind kind, const double* const (&x0)[4], const double* const (&x1)[4],
                const Demand& demand, DividingPlane& plane) {
  const Points points{kind, x0, x1};
  Search search(points, demand);
  const ClosestPoints start = closest_points(kind, x0);
  search.set_frame(start.weights);
  const Vec at_start = vec(start.direction);
  if (search.frees(at_start)) return Division::free;
  const double* mixed[4];
  for (const int ends : {3, 1, 2}) {  // a bit for each primitive that has moved
    for (int k = 0; k < 4; ++k) mixed[k] = (k < points.side() ? ends & 1 : ends & 2) ? x1[k] : x0[k];
    const Vec there = vec(closest_points(kind, {mixed[0], mixed[1], mixed[2], mixed[3]}).direction);
    if (search.frees(there) || search.frees(unit(at_start + there))) return Division::free;
  }
  if (demand.maximum_norm) {
    const double scale = inverse_unit(largest_corner_component(kind, x0));
    if (search.frees(best_direction_in_maximum_norm(precise_differences(kind, x0, scale))))
      return Division::free;
  }
  if (!search.found()) return Division::none;
  plane = search.best();
  return Division::divided;
}

}  // namespace onset
