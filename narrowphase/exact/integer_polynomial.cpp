#include "narrowphase/exact/integer_polynomial.hpp"

#include <algorithm>

#include "narrowphase/exact/root.hpp"

namespace onset {

void IntegerPolynomial::trim() {
  while (!c_.empty() && c_.back().is_zero()) c_.pop_back();
}

IntegerPolynomial operator+(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  std::vector<Integer> c(std::max(a.c_.size(), b.c_.size()));
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (i < a.c_.size()) c[i] += a.c_[i];
    if (i < b.c_.size()) c[i] += b.c_[i];
  }
  return IntegerPolynomial(std::move(c));
}
IntegerPolynomial operator-(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  return a + IntegerPolynomial({Integer(-1)}) * b;
}
IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Integer> c(a.c_.size() + b.c_.size() - 1);
  for (std::size_t i = 0; i < a.c_.size(); ++i)
    for (std::size_t j = 0; j < b.c_.size(); ++j) c[i + j] += a.c_[i] * b.c_[j];
  return IntegerPolynomial(std::move(c));
}

namespace {

IntegerPolynomial primitive(const IntegerPolynomial& p) {
  Integer common = 0;
  for (int i = 0; i <= p.degree(); ++i) common = gcd(common, p[i]);
  if (common <= 1) return p;
  std::vector<Integer> c;
  for (int i = 0; i <= p.degree(); ++i) c.push_back(p[i] / common);
  return IntegerPolynomial(std::move(c));
}

// leading(d)^k p = quotient d + remainder, d != 0.
struct Division {
  IntegerPolynomial quotient, remainder;
};
Division pseudo_divide(const IntegerPolynomial& p, const IntegerPolynomial& d) {
  Division r{{}, p};
  const IntegerPolynomial leading({d.leading()});
  while (r.remainder.degree() >= d.degree()) {
    std::vector<Integer> c(std::size_t(r.remainder.degree() - d.degree()) + 1);
    c.back() = r.remainder.leading();
    const IntegerPolynomial term(std::move(c));
    r.quotient = leading * r.quotient + term;
    r.remainder = leading * r.remainder - term * d;
  }
  return r;
}

using Coefficients = std::vector<Integer>;

// Returns Bernstein coefficients on [k, k + 1] / 2^depth, up to a positive factor.
Coefficients bernstein(const IntegerPolynomial& p, const Integer& k, unsigned depth) {
  const int n = p.degree();
  Coefficients c;
  for (int i = 0; i <= n; ++i) c.push_back(p[i] << (depth * unsigned(n - i)));
  for (int i = 0; i < n; ++i)  // x -> x + k
    for (int j = n - 1; j >= i; --j) c[std::size_t(j)] += k * c[std::size_t(j) + 1];
  // n! b_i = sum_j i! (n - j)! / (i - j)! c_j
  Coefficients b(c.size());
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= i; ++j) {
      Integer weight = 1;
      for (int m = i - j + 1; m <= i; ++m) weight *= m;
      for (int m = 1; m <= n - j; ++m) weight *= m;
      b[std::size_t(i)] += weight * c[std::size_t(j)];
    }
  return b;
}

// Both halves, each multiplied by 2^degree.
void halve(const Coefficients& b, Coefficients& left, Coefficients& right) {
  const std::size_t n = b.size() - 1;
  Coefficients row = b;
  left.assign(n + 1, 0);
  right.assign(n + 1, 0);
  for (std::size_t level = 0; level <= n; ++level) {
    left[level] = row[0] << unsigned(n - level);
    right[n - level] = row[n - level] << unsigned(n - level);
    for (std::size_t i = 0; i + level < n; ++i) row[i] += row[i + 1];
  }
}

int sign_changes(const Coefficients& b) {
  int changes = 0, last = 0;
  for (const Integer& x : b) {
    const int s = x.sign();
    changes += s != 0 && last != 0 && s != last;
    if (s != 0) last = s;
  }
  return changes;
}

// Finds the roots in the open interval (0, 1), from left to right. It ends for square-free p: short pieces
// have at most one sign change. Roots may be as close as 2^-10000, so that a recursion could be as deep.
void isolate(const IntegerPolynomial& p, const Coefficients& b, std::vector<IsolatedRoot>& roots) {
  struct Piece {
    Coefficients b;
    Integer k;
    unsigned depth;
  };
  std::vector<Piece> open{{b, 0, 0}};
  while (!open.empty()) {
    const Piece piece = std::move(open.back());
    open.pop_back();
    // A right half begins with its middle, which no other piece has looked at.
    if (bit_test(piece.k, 0) && piece.b.front().is_zero()) roots.push_back({p, piece.k, piece.depth, true});
    const int changes = sign_changes(piece.b);
    if (changes == 0) continue;
    if (changes == 1 && !piece.b.front().is_zero() && !piece.b.back().is_zero()) {
      roots.push_back({p, piece.k, piece.depth, false});
      continue;
    }
    Piece left{{}, 2 * piece.k, piece.depth + 1};
    Piece right{{}, 2 * piece.k + 1, piece.depth + 1};
    halve(piece.b, left.b, right.b);
    open.push_back(std::move(right));
    open.push_back(std::move(left));
  }
}

}  // namespace

IntegerPolynomial greatest_common_divisor(IntegerPolynomial a, IntegerPolynomial b) {
  while (!b.is_zero()) {
    // Degrees are at most 3: growing eightfold in length is cheaper than dividing by common factors.
    IntegerPolynomial r = a.degree() < b.degree() ? a : pseudo_divide(a, b).remainder;
    a = std::move(b);
    b = std::move(r);
  }
  return a.degree() > 0 ? primitive(a) : a;
}

IntegerPolynomial square_free(const IntegerPolynomial& p) {
  std::vector<Integer> derivative;
  for (int i = 1; i <= p.degree(); ++i) derivative.push_back(p[i] * i);
  const IntegerPolynomial common = greatest_common_divisor(p, IntegerPolynomial(std::move(derivative)));
  return common.degree() < 1 ? p : primitive(pseudo_divide(p, common).quotient);
}

int sign_at(const IntegerPolynomial& p, const Integer& numerator, unsigned exponent) {
  Integer sum = 0;
  for (int i = p.degree(); i >= 0; --i)
    sum = sum * numerator + (p[i] << (exponent * unsigned(p.degree() - i)));
  return sum.sign();
}

double position_in_interval(const IsolatedRoot& root) {
  const Coefficients b = bernstein(root.p, root.k, root.depth);
  unsigned longest = 0;
  for (const Integer& x : b)
    if (!x.is_zero()) longest = std::max(longest, unsigned(msb(abs(x))));
  const unsigned shift = longest > 900 ? longest - 900 : 0;  // into the range of doubles
  double d[4] = {}, c[4];
  for (std::size_t i = 0; i < b.size(); ++i)
    d[i] = double(b[i].sign()) * static_cast<double>(Integer(abs(b[i]) >> shift));
  c[0] = d[0], c[3] = d[b.size() - 1];
  c[1] = b.size() == 4 ? d[1] : b.size() == 3 ? (d[0] + 2 * d[1]) / 3 : (2 * d[0] + d[1]) / 3;
  c[2] = b.size() == 4 ? d[2] : b.size() == 3 ? (2 * d[1] + d[2]) / 3 : (d[0] + 2 * d[1]) / 3;
  return approximate_root(c);
}

std::vector<IsolatedRoot> isolated_roots(const IntegerPolynomial& f) {
  const IntegerPolynomial p = square_free(f);
  std::vector<IsolatedRoot> roots;
  if (p.degree() < 1) return roots;
  const Coefficients b = bernstein(p, 0, 0);
  if (b.front().is_zero()) roots.push_back({p, 0, 0, true});
  isolate(p, b, roots);
  if (b.back().is_zero()) roots.push_back({p, 1, 0, true});
  return roots;
}

namespace {

bool has_one_sign(const Coefficients& b) {
  return sign_changes(b) == 0 && !b.front().is_zero() && !b.back().is_zero();
}

// Halves the root's interval until g has one sign in it, at most `rounds` times unless that is < 0; returns
// g's sign, or 0.
int narrow_to_one_sign(const IntegerPolynomial& g, IsolatedRoot& root, int rounds) {
  Coefficients p = bernstein(root.p, root.k, root.depth), left_p, right_p;
  Coefficients b = bernstein(g, root.k, root.depth), left, right;
  for (; !has_one_sign(b); --rounds) {
    if (rounds == 0) return 0;
    halve(p, left_p, right_p);
    halve(b, left, right);
    const int middle = right_p.front().sign();
    if (middle == 0) {
      root = {root.p, 2 * root.k + 1, root.depth + 1, true};
      return right.front().sign();
    }
    const bool in_left = middle != p.front().sign();
    p = in_left ? left_p : right_p;
    b = in_left ? left : right;
    root.k = 2 * root.k + (in_left ? 0 : 1);
    ++root.depth;
  }
  return b.front().sign();
}

}  // namespace

int sign_at(const IntegerPolynomial& g, IsolatedRoot& root) {
  if (root.exact) return sign_at(g, root.k, root.depth);
  if (g.degree() < 1) return g.is_zero() ? 0 : g[0].sign();
  constexpr int kCheap = 6;
  if (const int s = narrow_to_one_sign(g, root, kCheap); s != 0 || root.exact) return s;
  // The common divisor can have only this root in the interval, and it is simple.
  const IntegerPolynomial common = greatest_common_divisor(root.p, g);
  if (common.degree() > 0 && sign_at(common, root.k, root.depth) != sign_at(common, root.k + 1, root.depth))
    return 0;
  return narrow_to_one_sign(g, root, -1);
}

}  // namespace onset
