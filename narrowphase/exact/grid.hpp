// Doubles as integers in units of their last common bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "narrowphase/exact/root.hpp"

namespace onset {

// x = mantissa 2^exponent but for the sign and a common factor.
struct DoubleParts {
  std::uint64_t mantissa;
  int exponent;
  bool negative;
};
inline DoubleParts parts_of(double x) {
  const std::uint64_t b = double_bits(x);
  const int exponent = int(b >> 52 & 0x7ff);
  const std::uint64_t fraction = b & 0xfffffffffffffull;
  return {exponent == 0 ? fraction : fraction | 1ull << 52, std::max(exponent, 1), b >> 63 != 0};
}

// Coordinates are integers below 2^bits in units of 2^last.
struct Grid {
  int last = 4096, top = 0;

  int bits() const { return std::max(top - last, 0); }
  void add(const double* p) {
    for (int a = 0; a < 3; ++a) {
      const DoubleParts x = parts_of(p[a]);
      if (x.mantissa == 0) continue;
      last = std::min(last, x.exponent + __builtin_ctzll(x.mantissa));
      top = std::max(top, x.exponent + 64 - __builtin_clzll(x.mantissa));
    }
  }
};

// How a type of integers takes a mantissa 2^shift.
template <class C>
struct Placed {
  static C at(std::uint64_t mantissa, int shift) { return C(std::int64_t(mantissa)) << unsigned(shift); }
};
template <int N>
struct Placed<Wide<N>> {
  static Wide<N> at(std::uint64_t mantissa, int shift) {
    return shifted(Wide<N>(std::int64_t(mantissa)), shift);
  }
};

template <class C>
std::array<C, 3> on_grid(const double* p, int last) {
  std::array<C, 3> r;
  for (int a = 0; a < 3; ++a) {
    const DoubleParts x = parts_of(p[a]);
    const int shift = x.exponent - last;
    const C size = x.mantissa == 0 ? C(0)
                   : shift < 0     ? Placed<C>::at(x.mantissa >> -shift, 0)
                                   : Placed<C>::at(x.mantissa, shift);
    r[std::size_t(a)] = x.negative ? -size : size;
  }
  return r;
}

}  // namespace onset
