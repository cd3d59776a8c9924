// How much the randomised tests try: the environment variable ONSET_FUZZ multiplies every count.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace onset::tests {

inline int fuzz(double count) {
  const char* text = std::getenv("ONSET_FUZZ");
  const double factor = text && *text ? std::atof(text) : 1;
  return std::max(1, int(count * factor));
}

}  // namespace onset::tests
