// An edge and a face at rest in integers of fixed or any width.
#pragma once

#include "narrowphase/at_rest/edge_face.hpp"
#include "narrowphase/exact/integer_polynomial.hpp"
#include "narrowphase/exact/static.hpp"

namespace onset {

// For coordinates below 2^c, C holds differences, below 2^(c + 1), M areas, below 2^(2c + 4), and T volumes
// and products of two areas, below 2^(4c + 9).
template <class C, class M, class T>
class ExactEdgeFace {
 public:
  using Point = std::array<C, 3>;
  static constexpr bool fits(int c, int bits_of_c, int bits_of_m, int bits_of_t) {
    return c + 1 < bits_of_c && 2 * c + 4 < bits_of_m && 4 * c + 9 < bits_of_t;
  }

  ExactEdgeFace(const Point (&e)[2], const Point (&f)[3]) : e_(e), f_(f) {}

  std::array<M, 3> normal() const {
    return exact_cross<M>(difference(f_[1], f_[0]), difference(f_[2], f_[0]));
  }

  // Decides for a face with area, which a line meets iff no two of its sides are passed on different sides.
  EdgeFace decide(const std::array<M, 3>& n) const {
    const int s0 = side(n, e_[0]), s1 = side(n, e_[1]);
    if (s0 == s1) return s0 == 0 ? coplanar(n) : EdgeFace::apart;
    const Point d = difference(e_[1], e_[0]);
    bool left = false, right = false, on = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto area = exact_cross<M>(difference(f_[i], e_[0]), difference(f_[(i + 1) % 3], e_[0]));
      const int s = sign_of(volume(area, d));
      left = left || s > 0, right = right || s < 0, on = on || s == 0;
    }
    if (left && right) return EdgeFace::apart;
    return on || s0 == 0 || s1 == 0 ? EdgeFace::touching : EdgeFace::crossing;
  }

  // Decides for a face that is the segment from `first` to `last`. overlapping: all are on one line, and what
  // they share is left open.
  static EdgeFace of_segments(const Point& e0, const Point& e1, const Point& first, const Point& last) {
    const Point u = difference(e1, e0), v = difference(last, first), w = difference(first, e0);
    const auto m = exact_cross<M>(u, v), s = exact_cross<M>(w, v), t = exact_cross<M>(w, u);
    for (std::size_t k = 0; k < 3; ++k) {
      const int sign = sign_of(m[k]);
      if (sign == 0) continue;
      // e0 + s/m u = first + t/m v, if anywhere.
      if (sign_of(volume(m, w)) != 0) return EdgeFace::apart;
      const auto inside = [&](const M& x) { return sign * sign_of(x) >= 0 && sign * sign_of(m[k] - x) >= 0; };
      return inside(s[k]) && inside(t[k]) ? EdgeFace::touching : EdgeFace::apart;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (sign_of(s[k]) != 0 || sign_of(t[k]) != 0) return EdgeFace::apart;  // parallel
    return EdgeFace::overlapping;
  }

 private:
  static T volume(const std::array<M, 3>& area, const Point& x) {
    return T(area[0]) * T(x[0]) + T(area[1]) * T(x[1]) + T(area[2]) * T(x[2]);
  }
  int side(const std::array<M, 3>& n, const Point& p) const {
    return sign_of(volume(n, difference(p, f_[0])));
  }

  // Keeps the part of the edge, from 0 to 1, on the inner side of all sides, projected along an axis.
  EdgeFace coplanar(const std::array<M, 3>& n) const {
    std::size_t k = 0;
    while (sign_of(n[k]) == 0) ++k;
    M from = 0, from_of = 1, to = 1, to_of = 1;  // fractions
    for (std::size_t i = 0; i < 3; ++i) {
      const Point side = difference(f_[(i + 1) % 3], f_[i]);
      M h[2];
      for (std::size_t end = 0; end < 2; ++end) {
        h[end] = exact_cross<M>(side, difference(e_[end], f_[i]))[k];
        if (sign_of(n[k]) < 0) h[end] = -h[end];
      }
      const int s0 = sign_of(h[0]), s1 = sign_of(h[1]);
      if (s0 < 0 && s1 < 0) return EdgeFace::apart;
      if (s0 < 0 && less(from, from_of, -h[0], h[1] - h[0])) from = -h[0], from_of = h[1] - h[0];
      if (s1 < 0 && less(h[0], h[0] - h[1], to, to_of)) to = h[0], to_of = h[0] - h[1];
    }
    if (less(to, to_of, from, from_of)) return EdgeFace::apart;
    const Point d = difference(e_[1], e_[0]);
    const bool same_ends = sign_of(d[0]) == 0 && sign_of(d[1]) == 0 && sign_of(d[2]) == 0;
    return same_ends || !less(from, from_of, to, to_of) ? EdgeFace::touching : EdgeFace::overlapping;
  }

  // a / b < c / d for b, d > 0.
  static bool less(const M& a, const M& b, const M& c, const M& d) {
    return sign_of(T(a) * T(d) - T(c) * T(b)) < 0;
  }

  const Point (&e_)[2];
  const Point (&f_)[3];
};

}  // namespace onset
