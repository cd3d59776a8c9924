// Looks for inputs that make a ratio large: random ones, then small changes to the best.
#pragma once

#include <cstdio>

#include "tests/scenes/random.hpp"

namespace onset::tests {

// Input make(random), Input change(Input, random), double ratio(Input). Returns the largest ratio and prints
// it.
template <class Make, class Change, class Ratio>
double climb(const char* what, int starts, int steps, scenes::Random& random, Make&& make, Change&& change,
             Ratio&& ratio) {
  double largest = 0;
  for (int i = 0; i < starts; ++i) {
    auto best = make(random);
    double best_ratio = ratio(best);
    for (int k = 0; k < steps; ++k) {
      auto next = change(best, random);
      const double r = ratio(next);
      if (r >= best_ratio) best_ratio = r, best = std::move(next);
    }
    if (best_ratio > largest) largest = best_ratio;
  }
  std::printf("%-58s largest error / bound %.3f\n", what, largest);
  return largest;
}

}  // namespace onset::tests
