// When do two primitives that move linearly first touch? Exact, for any field Q.
//
// n = a x b is the normal, f = q.n the coplanarity cubic. Where f = 0 and n != 0, q = U a + V b with U n = q
// x b and V n = a x q, so one axis with n_k != 0 decides. Where n = 0 the primitive is the union of its
// boundary segments, and a point w lies on the segment from 0 to e iff w x e = 0 and w.(e - w) >= 0; this
// holds for e = 0 too.
//
// If f vanishes for all t (everything stays coplanar) and there is no contact at t = 0, the first contact is
// on the boundary: if it were in the interior at t* > 0 with n(t*) != 0, then U and V, continuous there,
// would be inside a little earlier as well.
#pragma once

#include <optional>

#include "tests/oracle/arithmetic/geometry.hpp"
#include "tests/oracle/arithmetic/root.hpp"

namespace onset::oracle {

template <class Q>
class FirstContact {
 public:
  using P = Polynomial<Q>;

  FirstContact(PairKind kind, const std::array<Vector<Q>, 4>& t0, const std::array<Vector<Q>, 4>& t1) {
    std::array<Vector<P>, 4> x;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) x[i][k] = P::linear(t0[i][k], t1[i][k]);
    r_ = relative(kind, x);
    n_ = cross(r_.a, r_.b);
    boundary_ = boundary(r_);
  }

  // The first contact in (0, 1] of a pair that is not coplanar for all t: its contacts are isolated.
  // Elsewhere none.
  std::optional<Bracket> time_after_start() const {
    const P f = dot(r_.q, n_);
    if (f.is_zero()) return std::nullopt;
    for (Root<Q>& root : roots_in_unit_interval(f))
      if (root.hi > 0 && touches(root)) return to_doubles(root);
    return std::nullopt;
  }

  // None: the two do not touch in [0, 1].
  std::optional<Bracket> time() const {
    const P f = dot(r_.q, n_);
    if (f.is_zero()) return coplanar_time();
    for (Root<Q>& root : roots_in_unit_interval(f))
      if (touches(root)) return to_doubles(root);
    return std::nullopt;
  }

 private:
  // At a time where the four points are coplanar.
  bool touches(Root<Q>& t) const {
    for (int k = 0; k < 3; ++k) {
      const int s = sign_at(n_[k], t);
      if (s != 0) return inside(t, k, s);
    }
    for (const OnSegment<P>& segment : boundary_)
      if (touches(segment, t)) return true;
    return false;
  }

  bool inside(Root<Q>& t, int k, int sign_of_n) const {
    const P u = cross(r_.q, r_.b, k), v = cross(r_.a, r_.q, k);
    const auto not_negative = [&](const P& g) { return sign_of_n * sign_at(g, t) >= 0; };
    if (!not_negative(u) || !not_negative(v)) return false;
    if (r_.kind == PairKind::vertex_face) return not_negative(n_[k] - u - v);
    return not_negative(n_[k] - u) && not_negative(n_[k] - v);
  }

  static P extent(const OnSegment<P>& s) { return dot(s.w, s.e - s.w); }

  static bool touches(const OnSegment<P>& segment, Root<Q>& t) {
    for (int k = 0; k < 3; ++k)
      if (sign_at(cross(segment.w, segment.e, k), t) != 0) return false;
    return sign_at(extent(segment), t) >= 0;
  }

  std::optional<Bracket> coplanar_time() const {
    Root<Q> start{P({Q(0), Q(1)}), Q(0), Q(0)};
    if (touches(start)) return Bracket{0, 0};
    std::optional<Bracket> first;
    for (const OnSegment<P>& segment : boundary_)
      if (const auto t = time_on(segment)) {
        if (!first) first = t;  // rounding is monotonic: the ends of the earliest are the smallest ends
        first = Bracket{std::min(first->lo, t->lo), std::min(first->hi, t->hi)};
      }
    return first;
  }

  // The segment is not touched at t = 0.
  static std::optional<Bracket> time_on(const OnSegment<P>& segment) {
    P on_line;  // zero where w x e = 0
    for (int k = 0; k < 3; ++k) on_line = gcd(on_line, cross(segment.w, segment.e, k));
    const P h = extent(segment);
    if (on_line.is_zero()) {  // collinear for all t: the first time at which h reaches zero from below
      if (h.is_zero()) return Bracket{0, 0};
      const auto roots = roots_in_unit_interval(h);
      return roots.empty() ? std::nullopt : std::optional<Bracket>(to_doubles(roots.front()));
    }
    for (Root<Q>& root : roots_in_unit_interval(on_line))
      if (sign_at(h, root) >= 0) return to_doubles(root);
    return std::nullopt;
  }

  Relative<P> r_;
  Vector<P> n_;
  std::vector<OnSegment<P>> boundary_;
};

}  // namespace onset::oracle
