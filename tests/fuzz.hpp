// How much the randomised tests try: the environment variable ONSET_FUZZ multiplies every count.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace onset::tests {

inline double fuzz_factor() {
  const char* text = std::getenv("ONSET_FUZZ");
  return text && *text ? std::atof(text) : 1;
}

inline int fuzz(double count) { return std::max(1, int(count * fuzz_factor())); }

// Says whether the i-th of many that are alike is tried: all are, or that share where the factor is below 1.
inline bool is_tried(int i) {
  const double share = fuzz_factor();
  return share >= 1 || std::floor(share * (i + 1)) > std::floor(share * i);
}

}  // namespace onset::tests
