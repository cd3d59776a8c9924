// A pair that starts beyond d first comes within d where the distance of two of its features (a corner, a
// side or the inside of {q - U a - V b}, and the origin) is d and the nearest point lies on the feature. Each
// is a polynomial that is zero and polynomials that are not negative. A polynomial that is zero at all times
// says nothing new: the first time at which its conditions hold is a time at which a feature of its boundary
// is at distance d, and corners have no conditions.
#include "tests/oracle/within.hpp"

#include <optional>

#include "tests/oracle/arithmetic/exact_points.hpp"
#include "tests/oracle/contact.hpp"
#include "tests/oracle/distance.hpp"
#include "tests/oracle/quick.hpp"

namespace onset::oracle {
namespace {

using P = Polynomial<Rational>;
using Points = ExactPoints;

class Earliest {
 public:
  // At a root of f where `inside` holds.
  template <class F>
  void look(const P& f, F&& inside) {
    if (f.is_zero()) return;
    for (Root<Rational>& root : roots_in_unit_interval(f))
      if (inside(root)) return add(to_doubles(root));
  }
  void add(const std::optional<Bracket>& t) {
    if (!t) return;
    truth_.collides = true;
    truth_.toi_lo = std::min(truth_.toi_lo, t->lo), truth_.toi_hi = std::min(truth_.toi_hi, t->hi);
  }
  const Truth& truth() const { return truth_; }

 private:
  Truth truth_;
};

bool not_negative(const P& g, Root<Rational>& t) { return sign_at(g, t) >= 0; }

void look_at_inside(const Relative<P>& r, const P& d2, Earliest& earliest) {
  const Vector<P> n = cross(r.a, r.b);
  const P height = dot(r.q, n), nn = dot(n, n);
  const P u = dot(cross(r.q, r.b), n), v = dot(cross(r.a, r.q), n);
  earliest.look(height * height - d2 * nn, [&](Root<Rational>& t) {
    if (sign_at(nn, t) <= 0 || !not_negative(u, t) || !not_negative(v, t)) return false;
    if (r.kind == PairKind::vertex_face) return not_negative(nn - u - v, t);
    return not_negative(nn - u, t) && not_negative(nn - v, t);
  });
}

void look_at_side(const OnSegment<P>& s, const P& d2, Earliest& earliest) {
  const P ee = dot(s.e, s.e), along = dot(s.w, s.e);
  const Vector<P> n = cross(s.w, s.e);
  earliest.look(dot(n, n) - d2 * ee, [&](Root<Rational>& t) {
    return sign_at(ee, t) > 0 && not_negative(along, t) && not_negative(ee - along, t);
  });
}

Truth euclidean(PairKind kind, const Points& t0, const Points& t1, const Rational& d) {
  std::array<Vector<P>, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) x[i][k] = P::linear(t0[i][k], t1[i][k]);
  const Relative<P> r = relative(kind, x);
  const P d2({d * d});
  Earliest earliest;
  look_at_inside(r, d2, earliest);
  for (const OnSegment<P>& side : boundary(r)) look_at_side(side, d2, earliest);
  for (const Vector<P>& corner : corners(r))
    earliest.look(dot(corner, corner) - d2, [](Root<Rational>&) { return true; });
  return earliest.truth();
}

// When the point that moves from w0 to w1 is first in the cube [-d, d]^3.
std::optional<Bracket> point_in_cube(const Vector<Rational>& w0, const Vector<Rational>& w1,
                                     const Rational& d) {
  Rational first = 0, last = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational step = w1[k] - w0[k];
    if (step == 0 && abs(w0[k]) > d) return std::nullopt;
    if (step == 0) continue;
    const Rational s = (-d - w0[k]) / step, t = (d - w0[k]) / step;
    first = std::max(first, std::min(s, t)), last = std::min(last, std::max(s, t));
  }
  if (first > last) return std::nullopt;
  return Bracket{round_down(first), round_up(first)};
}

// The differences are a polygon; it meets the cube first with a corner, a side on a side, or on the cube's
// corner.
Truth maximum(PairKind kind, const Points& t0, const Points& t1, const Rational& d) {
  Earliest earliest;
  const auto corner = [&](int bits) {
    return Vector<Rational>{bits & 1 ? d : -d, bits & 2 ? d : -d, bits & 4 ? d : -d};
  };
  const Polygon<Rational> w0 = corners(relative(kind, t0)), w1 = corners(relative(kind, t1));
  for (std::size_t i = 0; i < w0.size(); ++i) {
    const std::size_t j = (i + 1) % w0.size();
    earliest.add(point_in_cube(w0[i], w1[i], d));
    for (int from = 0; from < 8; ++from)
      for (int axis = 1; axis < 8; axis *= 2)
        if (!(from & axis))
          earliest.add(FirstContact<Rational>(PairKind::edge_edge,
                                              {w0[i], w0[j], corner(from), corner(from | axis)},
                                              {w1[i], w1[j], corner(from), corner(from | axis)})
                           .time());
  }
  for (int bits = 0; bits < 8; ++bits) {
    Points s0 = t0, s1 = t1;
    for (std::size_t i = 0; i < 4; ++i)
      if (kind == PairKind::vertex_face ? i < 1 : i >= 2)
        s0[i] = s0[i] - corner(bits), s1[i] = s1[i] - corner(bits);
    earliest.add(FirstContact<Rational>(kind, s0, s1).time());
  }
  return earliest.truth();
}

}  // namespace

Truth exact_within(const scenes::Query& query, double d, Norm norm) {
  if (d == 0) return surely_apart(query) ? Truth{} : exact_ccd(query);
  if (compare_distance(query, 0, d, norm) <= 0) return {true, 0, 0};
  const Rational scale = unit_scale(query, d), length = Rational(d) * scale;
  const auto of = norm == Norm::euclidean ? euclidean : maximum;
  return of(query.kind, exact(query.t0, scale), exact(query.t1, scale), length);
}

}  // namespace onset::oracle
