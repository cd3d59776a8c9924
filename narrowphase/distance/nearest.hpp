// The point of a pair's differences nearest to the origin, and the direction that keeps it away.
#pragma once

#include <algorithm>
#include <cmath>

#include "narrowphase/distance/double_double.hpp"
#include "narrowphase/vec.hpp"
#include "onset/result.hpp"

namespace onset {

inline Vec rounded(const VecOf<DoubleDouble>& v) { return {{v[0].hi, v[1].hi, v[2].hi}}; }

// The differences first - second of a pair, q - U a - V b: (U, V) is in the triangle U, V >= 0, U + V <= 1
// (vertex-face: a and b lead from the face's first corner) or in the unit square (edge-edge: a runs against
// the first edge, b along the second), with corners (0, 0), (0, 1), (1, 0), (1, 1).
template <class T>
struct Differences {
  PairKind kind;
  VecOf<T> q, a, b;
  VecOf<T> corner[4];

  int corners() const { return kind != PairKind::edge_edge ? 3 : 4; }
  void set_corners() {
    const bool triangle = kind != PairKind::edge_edge;
    corner[0] = q, corner[triangle ? 2 : 1] = q - b, corner[triangle ? 1 : 2] = q - a;
    if (!triangle) corner[3] = corner[2] - b;
  }
};

// The least width that is resolved, of a length of 1, and the least square that is trusted.
template <class T>
struct Precision;
template <>
struct Precision<double> {
  static constexpr double thinnest = 0x1p-40, tiny2 = 0x1p-600;
};
template <>
struct Precision<DoubleDouble> {
  static constexpr double thinnest = 0x1p-92, tiny2 = 0x1p-400;
};

// The plane of a and b by Gram-Schmidt from the longer one, twice: `across` is then as exact as the other
// edge, however thin the primitive is.
template <class T>
struct PairPlane {
  bool swapped = false;        // b is the longer one
  bool resolved = false;       // its width is more than `thinnest` of its length
  VecOf<T> along{}, across{};  // the longer edge, and the other's part across it
  T length2{}, width2{}, share{};

  explicit PairPlane(const Differences<T>& d) {
    const T aa = dot(d.a, d.a), bb = dot(d.b, d.b);
    swapped = bb > aa;
    length2 = swapped ? bb : aa;
    along = swapped ? d.b : d.a;
    if (!(length2 > T(Precision<T>::tiny2))) return;
    const VecOf<T>& other = swapped ? d.a : d.b;
    share = dot(other, along) / length2;
    across = other - share * along;
    across = across - (dot(across, along) / length2) * along;
    width2 = dot(across, across);
    constexpr double least = Precision<T>::thinnest * Precision<T>::thinnest;
    resolved = width2 > T(Precision<T>::tiny2) && width2 > T(least) * length2;
  }
  VecOf<T> normal() const { return cross(along, across); }
};

template <class T>
struct Nearest {
  T U{}, V{};
  // The point is above a resolved plane, and the direction is square to that.
  bool inside = false;
  // Its `margin` is the distance, up to rounding.
  VecOf<T> direction{};
};

// Finds the plane's nearest point; false: outside. The second round takes back what the first lost to a thin
// primitive.
template <class T>
bool foot_on_plane(const Differences<T>& d, const PairPlane<T>& plane, Nearest<T>& r) {
  const VecOf<T>& other = plane.swapped ? d.a : d.b;
  T x = 0.0, y = 0.0;
  VecOf<T> left = d.q;
  for (int round = 0; round < 2; ++round) {
    const T dy = dot(left, plane.across) / plane.width2;
    x = x + (dot(left, plane.along) / plane.length2 - dy * plane.share);
    y = y + dy;
    if (round == 0) left = (d.q - x * plane.along) - y * other;
  }
  r.U = plane.swapped ? y : x, r.V = plane.swapped ? x : y;
  const T zero = 0.0, one = 1.0;
  if (r.U < zero || r.V < zero) return false;
  return d.kind != PairKind::edge_edge ? !(r.U + r.V > one) : !(r.U > one || r.V > one);
}

// Finds the nearest point of the boundary. Inside a side the direction is made square to it: rounding along
// the side would tilt it where the distance is short.
template <class T>
Nearest<T> nearest_on_sides(const Differences<T>& d) {
  struct Side {
    int from;  // corner
    double U, V, dU, dV;
  };
  static constexpr Side kTriangle[] = {{0, 0, 0, 1, 0}, {0, 0, 0, 0, 1}, {1, 1, 0, -1, 1}};
  static constexpr Side kSquare[] = {{0, 0, 0, 1, 0}, {0, 0, 0, 0, 1}, {1, 0, 1, 1, 0}, {2, 1, 0, 0, 1}};
  const bool triangle = d.kind != PairKind::edge_edge;
  const VecOf<T> slanted = triangle ? d.b - d.a : VecOf<T>{};
  Nearest<T> best;
  T least = 0.0;
  for (int i = 0; i < (triangle ? 3 : 4); ++i) {
    const Side& s = triangle ? kTriangle[i] : kSquare[i];
    const VecOf<T>& e = s.dU == 0 ? d.b : s.dV == 0 ? d.a : slanted;
    const VecOf<T>& from = d.corner[s.from];
    const T ee = dot(e, e), reach = dot(from, e), zero = 0.0;
    const bool has_length = ee > T(Precision<T>::tiny2), within = has_length && reach > zero && ee > reach;
    const bool far_end = has_length && !(ee > reach);
    T t = far_end ? T(1.0) : zero;
    VecOf<T> w = from;
    if (within) {
      t = reach / ee;
      w = from - t * e;
      w = w - (dot(w, e) / ee) * e;
    } else if (far_end) {
      w = triangle ? d.corner[i == 0 ? 1 : 2] : d.corner[i == 0 ? 2 : i == 1 ? 1 : 3];
    }
    const T ww = dot(w, w);
    if (i > 0 && !(ww < least)) continue;
    least = ww;
    best = {T(s.U) + t * T(s.dU), T(s.V) + t * T(s.dV), false, w};
  }
  return best;
}

// Returns a lower bound of the distance, whatever n is.
template <class T>
T margin(const Differences<T>& d, const VecOf<T>& n) {
  const T nn = dot(n, n);
  if (!(nn > T(Precision<T>::tiny2))) return 0.0;
  T least = dot(n, d.corner[0]);
  for (int k = 1; k < d.corners(); ++k) {
    const T here = dot(n, d.corner[k]);
    if (here < least) least = here;
  }
  using std::sqrt;
  return least / sqrt(nn);
}

}  // namespace onset
