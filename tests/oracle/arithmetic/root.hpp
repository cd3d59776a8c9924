// Real roots of polynomials as isolating intervals, and exact signs at them.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/oracle/arithmetic/polynomial.hpp"
#include "tests/oracle/arithmetic/rational.hpp"

namespace onset::oracle {

// Sturm's chain of a square-free polynomial: counts its roots in (a, b], even where a or b is one.
template <class Q>
class Sturm {
 public:
  explicit Sturm(const Polynomial<Q>& p) : chain_{p, derivative(p)} {
    while (!chain_.back().is_zero()) chain_.push_back(-remainder(chain_[chain_.size() - 2], chain_.back()));
    chain_.pop_back();
  }
  int count(const Q& a, const Q& b) const { return variations(a) - variations(b); }

 private:
  int variations(const Q& t) const {
    int last = 0, changes = 0;
    for (const Polynomial<Q>& p : chain_) {
      const int s = sign(p.value(t));
      if (s != 0 && last != 0 && s != last) ++changes;
      if (s != 0) last = s;
    }
    return changes;
  }
  std::vector<Polynomial<Q>> chain_;
};

// The only root of the square-free p in [lo, hi]. Either lo == hi is the root, or it lies inside and p has
// opposite signs, neither zero, at the ends.
template <class Q>
struct Root {
  Polynomial<Q> p;
  Q lo, hi;
  bool exact() const { return lo == hi; }
};

template <class Q>
void bisect(Root<Q>& root) {
  const Q middle = (root.lo + root.hi) / 2;
  const int s = sign(root.p.value(middle));
  if (s == 0)
    root.lo = root.hi = middle;
  else
    (s == sign(root.p.value(root.lo)) ? root.lo : root.hi) = middle;
}

// Appends the roots in the open interval (lo, hi), in increasing order.
template <class Q>
void isolate(const Polynomial<Q>& p, const Sturm<Q>& sturm, const Q& lo, const Q& hi,
             std::vector<Root<Q>>& roots) {
  const bool root_at_hi = p.value(hi) == 0;
  const int inside = sturm.count(lo, hi) - root_at_hi;
  if (inside == 0) return;
  if (inside == 1 && !root_at_hi && p.value(lo) != 0) {
    roots.push_back({p, lo, hi});
    return;
  }
  const Q middle = (lo + hi) / 2;
  isolate(p, sturm, lo, middle, roots);
  if (p.value(middle) == 0) roots.push_back({p, middle, middle});
  isolate(p, sturm, middle, hi, roots);
}

// Whether the Bernstein coefficients on [0, 1] have one sign: there is no root then.
template <class Q>
bool of_one_sign(const Polynomial<Q>& f) {
  const int n = f.degree();
  for (int i = 0; i <= n; ++i) {
    Q sum = 0, weight = 1;  // C(i, j) / C(n, j)
    for (int j = 0; j <= i; ++j) {
      sum += weight * f[j];
      if (j < i) weight *= Q(i - j) / Q(n - j);
    }
    if (sign(sum) == 0 || sign(sum) != sign(f[0])) return false;
  }
  return true;
}

// The distinct roots of f != 0 in [0, 1], in increasing order.
template <class Q>
std::vector<Root<Q>> roots_in_unit_interval(const Polynomial<Q>& f) {
  if (of_one_sign(f)) return {};
  const Polynomial<Q> p = square_free(f);
  const Q zero = 0, one = 1;
  std::vector<Root<Q>> roots;
  if (p.degree() < 1) return roots;
  if (p.value(zero) == 0) roots.push_back({p, zero, zero});
  isolate(p, Sturm<Q>(p), zero, one, roots);
  if (p.value(one) == 0) roots.push_back({p, one, one});
  return roots;
}

// The exact sign of g at the root. May narrow the root's interval.
template <class Q>
int sign_at(const Polynomial<Q>& g, Root<Q>& root) {
  if (root.exact()) return sign(g.value(root.lo));
  const Polynomial<Q> r = remainder(g, root.p);  // the same value at the root
  if (r.degree() < 1) return r.is_zero() ? 0 : sign(r[0]);
  const Polynomial<Q> common =
      gcd(root.p, r);  // its only possible root in the interval is this one, and it is simple
  if (sign(common.value(root.lo)) != sign(common.value(root.hi))) return 0;
  const Sturm<Q> sturm(square_free(r));
  while (!root.exact() && sturm.count(root.lo, root.hi) > 0) bisect(root);
  return sign(r.value(root.hi));
}

struct Bracket {
  double lo = 0, hi = 0;
};

inline std::uint64_t bits(double x) {
  std::uint64_t b;
  std::memcpy(&b, &x, sizeof b);
  return b;
}
inline double from_bits(std::uint64_t b) {
  double x;
  std::memcpy(&x, &b, sizeof x);
  return x;
}

// A root in [0, 1] between adjacent doubles, or lo == hi where it is a double.
template <class Q>
Bracket to_doubles(const Root<Q>& root) {
  double lo = round_down(root.lo), hi = round_up(root.hi);
  if (root.exact()) return {lo, hi};
  const int sign_lo = sign(root.p.value(root.lo));
  while (bits(lo) + 1 < bits(hi)) {  // a double strictly between lo and hi is inside the isolating interval
    const double middle = from_bits(bits(lo) + (bits(hi) - bits(lo)) / 2);
    const int s = sign(root.p.value(Q(middle)));
    if (s == 0) return {middle, middle};
    (s == sign_lo ? lo : hi) = middle;
  }
  return {lo, hi};
}

}  // namespace onset::oracle
