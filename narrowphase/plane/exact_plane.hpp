// A vertex and a plane in integers: on which side is it, also as far as the separation, and when.
//
// With exact products on one grid, f(x) = n.x - offset is an integer, and so is the square of the separation
// times |n|: f > d |n| where f > 0 and f^2 > d^2 |n|^2. In the maximum norm the distance is f over the sum of
// the |n_a|, and d times that is an integer itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "narrowphase/exact/grid.hpp"
#include "narrowphase/plane/plane_question.hpp"

namespace onset {

// mantissa 2^exponent, both of any size: an approximation within 2^-52, relatively.
struct Approximation {
  double mantissa = 0;
  int exponent = 0;
  // Scaled by 2^-by; it underflows where it is that small.
  double scaled(int by) const { return std::ldexp(mantissa, exponent - by); }
  // Its magnitude is below 2^top().
  int top() const { return mantissa == 0 ? -100000 : exponent + std::ilogb(mantissa) + 1; }
};

template <int N>
Approximation approximate(const Wide<N>& a) {
  if (a.negative()) {
    const Approximation r = approximate(-a);
    return {-r.mantissa, r.exponent};
  }
  int i = N - 1;
  while (i > 0 && a.limb[i] == 0) --i;
  if (a.limb[i] == 0) return {};
  const int zeros = __builtin_clzll(a.limb[i]);
  std::uint64_t first = a.limb[i] << zeros;
  if (zeros > 0 && i > 0) first |= a.limb[i - 1] >> (64 - zeros);
  return {double(first), 64 * i - zeros};
}

// The product of two doubles in parts: mantissa 2^(exponent - 2150) but for the sign.
struct ProductParts {
  UInt128 mantissa;
  int exponent;
  bool negative;
};
inline ProductParts product_parts(double x, double y) {
  const DoubleParts p = parts_of(x), q = parts_of(y);
  return {UInt128(p.mantissa) * q.mantissa, p.exponent + q.exponent, p.negative != q.negative};
}

// Where all products of a question lie: integers below 2^bits() in units of 2^last.
struct ProductGrid {
  int last = 1 << 20, top = 0;

  int bits() const { return std::max(top - last, 0); }
  void add(const ProductParts& p) {
    if (p.mantissa == 0) return;
    const std::uint64_t low = std::uint64_t(p.mantissa), high = std::uint64_t(p.mantissa >> 64);
    last = std::min(last, p.exponent + (low != 0 ? __builtin_ctzll(low) : 64 + __builtin_ctzll(high)));
    top = std::max(top, p.exponent + (high != 0 ? 128 - __builtin_clzll(high) : 64 - __builtin_clzll(low)));
  }
};

template <int N>
Wide<N> on_grid(const ProductParts& p, int last) {
  if (p.mantissa == 0) return Wide<N>(0);
  const int shift = p.exponent - last;
  const Wide<N> size =
      shift < 0 ? Wide<N>(Int128(p.mantissa >> -shift)) : shifted(Wide<N>(Int128(p.mantissa)), shift);
  return p.negative ? -size : size;
}

// The products of a question: n_a x_a at both ends, the offset, and d n_a.
struct PlaneProducts {
  std::array<ProductParts, 3> at[2], separation;
  ProductParts offset;
  ProductGrid grid;

  explicit PlaneProducts(const PlaneQuestion& q) : offset(product_parts(q.offset, 1)) {
    for (std::size_t a = 0; a < 3; ++a) {
      at[0][a] = product_parts(q.normal[a], q.x0[a]);
      at[1][a] = product_parts(q.normal[a], q.x1[a]);
      separation[a] = product_parts(q.normal[a], q.separation);
      for (const ProductParts* p : {&at[0][a], &at[1][a], &separation[a]}) grid.add(*p);
    }
    grid.add(offset);
  }
};

// Numbers below 2^(64 N - 4) in units of 2^unit. M limbs hold them at any time k / 2^q that is asked for.
template <int N, int M>
class ExactPlane {
 public:
  ExactPlane(const PlaneProducts& p, const PlaneQuestion& q)
      : unit_(p.grid.bits() > 0 ? p.grid.last - 2150 : 0), separated_(q.separation > 0 && !q.maximum_norm) {
    const int last = p.grid.last;
    f_[0] = f_[1] = -on_grid<N>(p.offset, last);
    Wide<N> d[3];
    for (std::size_t a = 0; a < 3; ++a) {
      for (int end = 0; end < 2; ++end) f_[end] = f_[end] + on_grid<N>(p.at[end][a], last);
      d[a] = on_grid<N>(p.separation[a], last);
      if (d[a].negative()) d[a] = -d[a];
    }
    beyond_[0] = f_[0], beyond_[1] = f_[1];
    if (separated_)
      squares_ = square(d[0]) + square(d[1]) + square(d[2]);
    else  // 0, or that of the maximum norm
      for (Wide<N>& b : beyond_) b = b - (d[0] + d[1] + d[2]);
    slope_ = f_[1] - f_[0];
  }

  int sign(int end) const { return sign_of(f_[end]); }
  int sign_of_motion() const { return sign_of(slope_); }
  // The sign of the distance less the separation, negative behind the plane.
  int side(int end) const { return side_of(Wide<M>(beyond_[end]), 0); }
  // Whether side_at can be asked: t is k / 2^q with a q that fits.
  static bool fits(double t) { return to_dyadic(t).exponent <= 64 * (M - N) - 64; }
  int side_at(double t) const {
    const Dyadic k = to_dyadic(t);
    return side_of(at(beyond_[0], k), k.exponent);
  }

  // f at one end, f at a time, and how far f is beyond d times the length of n at one end.
  Approximation value(int end) const { return in_units(approximate(f_[end])); }
  Approximation value_at(double t) const {
    const Dyadic k = to_dyadic(t);
    Approximation r = in_units(approximate(at(f_[0], k)));
    r.exponent -= k.exponent;
    return r;
  }
  Approximation motion() const { return in_units(approximate(slope_)); }
  Approximation excess(int end) const {
    if (!separated_) return in_units(approximate(beyond_[end]));
    const Approximation f = in_units(approximate(f_[end])), root = root_of_squares();
    const int by = std::max(f.top(), root.top());
    if (sign_of(f_[end]) <= 0) return {f.scaled(by) - root.scaled(by), by};
    Approximation r = approximate(square(f_[end]) - squares_);  // = (f - d |n|) (f + d |n|)
    r.exponent += 2 * unit_ - by;
    r.mantissa /= f.scaled(by) + root.scaled(by);
    return r;
  }

 private:
  static Wide<2 * N> square(const Wide<N>& x) { return Wide<2 * N>(x) * Wide<2 * N>(x); }
  // The value at k 2^-q, times 2^q.
  Wide<M> at(const Wide<N>& start, const Dyadic& k) const {
    return shifted(Wide<M>(start), k.exponent) + Wide<M>(slope_) * Wide<M>(k.numerator);
  }
  int side_of(const Wide<M>& b, int q) const {
    const int s = sign_of(b);
    if (!separated_ || s <= 0) return separated_ ? -1 : s;
    return sign_of(Wide<2 * M>(b) * Wide<2 * M>(b) - shifted(Wide<2 * M>(squares_), 2 * q));
  }
  Approximation in_units(Approximation a) const {
    a.exponent += unit_;
    return a;
  }
  Approximation root_of_squares() const {
    Approximation s = approximate(squares_);
    if (s.exponent % 2 != 0) s.mantissa *= 2, s.exponent -= 1;
    return {std::sqrt(s.mantissa), s.exponent / 2 + unit_};
  }

  int unit_;
  bool separated_;
  Wide<N> f_[2], beyond_[2], slope_;
  Wide<2 * N> squares_{0};
};

}  // namespace onset
