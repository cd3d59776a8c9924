// Random numbers that are the same on every platform: the standard fixes mt19937_64 but not its
// distributions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <onset/query.hpp>
#include <random>

namespace onset::scenes {

using Random = std::mt19937_64;

// [0, 1), all 53 bits of the significand random.
inline double unit(Random& random) { return double(random() >> 11) * 0x1p-53; }
inline double uniform(Random& random, double low, double high) { return low + (high - low) * unit(random); }
inline bool coin(Random& random) { return random() >> 63; }

// low..high, both included.
inline int integer(Random& random, int low, int high) {
  return low + int(random() % std::uint64_t(std::int64_t(high) - low + 1));
}

// 10^x with x uniform in [low, high].
inline double power_of_ten(Random& random, double low, double high) {
  return std::pow(10.0, uniform(random, low, high));
}

inline Point point(Random& random, double size = 1) {
  Point p;
  for (double& x : p) x = uniform(random, -size, size);
  return p;
}

// Integers in [-2^bits, 2^bits]: sums of a few products by small integers stay exact for bits <= 40.
inline Point grid_point(Random& random, int bits) {
  const double size = std::ldexp(1.0, bits);
  Point p;
  for (double& x : p) x = std::floor(uniform(random, -size, size + 1));
  return p;
}

}  // namespace onset::scenes
