#include "narrowphase/exact/complete.hpp"

#include <climits>

#include "narrowphase/exact/integer_polynomial.hpp"
#include "narrowphase/exact/pair.hpp"

namespace onset {
namespace {

using Polynomial = IntegerPolynomial;
using IntegerPoints = std::array<std::array<Integer, 3>, 4>;

struct Bits {
  std::int64_t mantissa;
  int exponent;  // x = mantissa 2^exponent, the mantissa odd or 0
};
Bits split(double x) {
  if (x == 0) return {0, INT_MAX};
  int e;
  std::int64_t m = std::int64_t(std::ldexp(std::frexp(x, &e), 53));
  e -= 53;
  while (m % 2 == 0) m /= 2, ++e;
  return {m, e};
}

// In units of the last bit of any coordinate: contact does not depend on the unit.
void set_points(const ExactPair& pair, IntegerPoints& t0, IntegerPoints& t1) {
  int last = INT_MAX;
  for (const auto* points : {&pair.t0, &pair.t1})
    for (const double* p : *points)
      for (int a = 0; a < 3; ++a) last = std::min(last, split(p[a]).exponent);
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) {
      const Bits x0 = split(pair.t0[i][a]), x1 = split(pair.t1[i][a]);
      t0[i][a] = x0.mantissa == 0 ? Integer(0) : Integer(x0.mantissa) << unsigned(x0.exponent - last);
      t1[i][a] = x1.mantissa == 0 ? Integer(0) : Integer(x1.mantissa) << unsigned(x1.exponent - last);
    }
}

// Replaces the start by the positions at `from`, scaled to integers.
void start_later(double from, IntegerPoints& t0, IntegerPoints& t1) {
  const Dyadic t = to_dyadic(from);
  const Integer one = Integer(1) << unsigned(t.exponent);
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) {
      t0[i][a] = t0[i][a] * (one - t.numerator) + t1[i][a] * t.numerator;
      t1[i][a] *= one;
    }
}

Polynomial cross(const std::array<Polynomial, 3>& u, const std::array<Polynomial, 3>& v, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  return u[i] * v[j] - u[j] * v[i];
}
Polynomial dot(const std::array<Polynomial, 3>& u, const std::array<Polynomial, 3>& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

RelativeVectors<Polynomial> relative_motion(PairKind kind, const IntegerPoints& t0, const IntegerPoints& t1) {
  std::array<std::array<Polynomial, 3>, 4> x;
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) x[i][a] = Polynomial({t0[i][a], t1[i][a] - t0[i][a]});
  return relative_vectors(kind, x);
}

Polynomial derivative(const Polynomial& p) {
  std::vector<Integer> c;
  for (int i = 1; i <= p.degree(); ++i) c.push_back(p[i] * i);
  return Polynomial(std::move(c));
}

double rounded_down(const Integer& k, unsigned depth) {
  if (k.is_zero()) return 0;
  const int last = std::max(int(msb(k)) - int(depth) - 52, -1074);  // exponent of the last bit of the double
  const int shift = int(depth) + last;
  const Integer digits = shift > 0 ? Integer(k >> unsigned(shift)) : Integer(k << unsigned(-shift));
  return std::ldexp(double(std::int64_t(digits)), last);
}
bool equal(double x, const Integer& k, unsigned depth) {
  const Dyadic d = to_dyadic(x);
  return (Integer(d.numerator) << depth) == (k << unsigned(d.exponent));
}
double rounded_up(const Integer& k, unsigned depth) {
  const double down = rounded_down(k, depth);
  return equal(down, k, depth) ? down : std::nextafter(down, 2);
}

DoubleBracket bracket(const IsolatedRoot& root, bool adjacent) {
  const double lo = rounded_down(root.k, root.depth);
  if (root.exact) return {lo, rounded_up(root.k, root.depth)};
  const double hi = rounded_up(root.k + 1, root.depth);
  if (!adjacent) return {lo, hi};
  const int before = sign_at(root.p, root.k, root.depth);
  // Doubles strictly between lo and hi are in the isolating interval.
  const double guess = lo + position_in_interval(root) * (hi - lo);
  return adjacent_doubles(lo, hi, guess, [&](double t) {
    const Dyadic d = to_dyadic(t);
    return before * sign_at(root.p, d.numerator, unsigned(d.exponent));
  });
}

// The complete decision (docs/theory.md, §15.4). At the roots of f = q.n, n = a x b, one axis with n_k != 0
// decides; where n = 0 the boundary is all there is, as it is where f is 0 for all t and the pair apart at 0
// (L41).
class CompleteDecision {
 public:
  CompleteDecision(PairKind kind, const IntegerPoints& t0, const IntegerPoints& t1)
      : kind_(kind), r_(relative_motion(kind, t0, t1)) {
    for (int k = 0; k < 3; ++k) n_[k] = cross(r_.a, r_.b, k);
    segments_ = boundary_of(kind, r_, boundary_);
  }

  // Calls found(root) for contacts, the first one among them, or for none.
  template <class Found>
  void find(Found&& found) const {
    const Polynomial f = dot(r_.q, n_);
    if (f.is_zero()) return find_coplanar(found);
    for (IsolatedRoot& root : isolated_roots(f))
      if (touches(root)) return found(root);
  }

 private:
  bool touches(IsolatedRoot& t) const {
    for (int k = 0; k < 3; ++k) {
      const int s = sign_at(n_[k], t);
      if (s != 0) return inside(t, k, s);
    }
    for (int i = 0; i < segments_; ++i)
      if (touches(boundary_[i], t)) return true;
    return false;
  }

  bool inside(IsolatedRoot& t, int k, int sign_of_n) const {
    const Polynomial u = cross(r_.q, r_.b, k), v = cross(r_.a, r_.q, k);
    const auto not_negative = [&](const Polynomial& g) { return sign_of_n * sign_at(g, t) >= 0; };
    if (!not_negative(u) || !not_negative(v)) return false;
    if (kind_ != PairKind::edge_edge) return not_negative(n_[k] - u - v);
    return not_negative(n_[k] - u) && not_negative(n_[k] - v);
  }

  static Polynomial extent(const PointAndSegment<Polynomial>& s) { return dot(s.w, difference(s.e, s.w)); }

  static bool touches(const PointAndSegment<Polynomial>& s, IsolatedRoot& t) {
    for (int k = 0; k < 3; ++k)
      if (sign_at(cross(s.w, s.e, k), t) != 0) return false;
    return sign_at(extent(s), t) >= 0;
  }

  template <class Found>
  void find_coplanar(Found&& found) const {
    IsolatedRoot start{Polynomial({Integer(0), Integer(1)}), 0, 0, true};
    if (touches(start)) return found(start);
    for (int i = 0; i < segments_; ++i) find_on(boundary_[i], found);
  }

  // Precondition: the segment is not touched at t = 0.
  template <class Found>
  static void find_on(const PointAndSegment<Polynomial>& s, Found&& found) {
    Polynomial on_line;  // zero where w x e = 0
    for (int k = 0; k < 3; ++k) on_line = greatest_common_divisor(on_line, cross(s.w, s.e, k));
    const Polynomial h = extent(s);
    if (on_line.is_zero()) {  // collinear for all t: h, negative at 0, reaches zero
      auto roots = isolated_roots(h);
      if (!roots.empty()) found(roots.front());
      return;
    }
    for (IsolatedRoot& root : isolated_roots(on_line))
      if (sign_at(h, root) >= 0) return found(root);
  }

  PairKind kind_;
  RelativeVectors<Polynomial> r_;
  std::array<Polynomial, 3> n_;
  PointAndSegment<Polynomial> boundary_[4];
  int segments_;
};

}  // namespace

bool completely_touches(const ExactPair& pair, double from) {
  IntegerPoints t0, t1;
  set_points(pair, t0, t1);
  if (from > 0) start_later(from, t0, t1);
  bool touches = false;
  CompleteDecision(pair.kind, t0, t1).find([&](const IsolatedRoot&) { touches = true; });
  return touches;
}

std::optional<DoubleBracket> complete_first_contact(const ExactPair& pair, bool adjacent) {
  IntegerPoints t0, t1;
  set_points(pair, t0, t1);
  std::optional<DoubleBracket> first;
  CompleteDecision(pair.kind, t0, t1).find([&](const IsolatedRoot& root) {
    // Rounding is monotonic: the ends of the earliest are the smallest ends.
    const DoubleBracket t = bracket(root, adjacent);
    first = first ? DoubleBracket{std::min(first->lo, t.lo), std::min(first->hi, t.hi)} : t;
  });
  return first;
}

// By Taylor: the first derivative that is not 0 decides, the odd ones with the other sign.
int side_before(const ExactPair& pair, double t) {
  IntegerPoints t0, t1;
  set_points(pair, t0, t1);
  const RelativeVectors<Polynomial> r = relative_motion(pair.kind, t0, t1);
  const Dyadic time = to_dyadic(t);
  int turn = 1;
  Polynomial f = pair.kind == PairKind::vertex_edge
                     ? cross(r.a, r.q, 2)
                     : dot(r.q, {cross(r.a, r.b, 0), cross(r.a, r.b, 1), cross(r.a, r.b, 2)});
  for (; !f.is_zero(); f = derivative(f), turn = -turn) {
    const int s = sign_at(f, time.numerator, unsigned(time.exponent));
    if (s != 0 || t == 0) return turn * s;
  }
  return 0;
}

}  // namespace onset
