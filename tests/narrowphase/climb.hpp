// Looks for inputs whose errors come near the bounds that the code claims for them: random ones, then small
// changes to the best.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "tests/catch.hpp"
#include "tests/queries/query.hpp"
#include "tests/scenes/random.hpp"

namespace onset::tests {

template <class Input, class Compute>
struct ErrorBound {
  const char* name;
  Input (*make)(PairKind, scenes::Random&);
  double (*ratio)(Compute, const Input&);  // error / bound
  double at_least;  // found by the search: it looks in the right place, for the bound that the code needs
  int starts;
};

// x changed by up to a share of itself, or to one of its neighbours.
inline double nudged(double x, double share, scenes::Random& random) {
  return scenes::coin(random) ? x * (1 + share * scenes::uniform(random, -1, 1))
                              : std::nextafter(x, scenes::coin(random) ? 9e99 : -9e99);
}

template <class Input, class Compute>
double largest_ratio(const ErrorBound<Input, Compute>& bound, PairKind kind, Compute values,
                     Input (*change)(Input, scenes::Random&), int steps, scenes::Random& random) {
  double largest = 0;
  for (int i = 0; i < bound.starts; ++i) {
    Input best = bound.make(kind, random);
    double best_ratio = bound.ratio(values, best);
    for (int k = 0; k < steps; ++k) {
      Input next = change(best, random);
      const double r = bound.ratio(values, next);
      if (r >= best_ratio) best_ratio = r, best = std::move(next);
    }
    if (best_ratio > largest) largest = best_ratio;
  }
  return largest;
}

// Of the values that one build of the kernel text computes; prints what is found.
template <class Input, class Compute, std::size_t N>
void check_bounds(const char* build, Compute values, const ErrorBound<Input, Compute> (&bounds)[N],
                  Input (*change)(Input, scenes::Random&), int steps) {
  for (const auto& bound : bounds)
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      const std::string name = std::string(build) + ", " + scenes::name(kind) + ": " + bound.name;
      INFO(name);
      scenes::Random random(81);
      const double largest = largest_ratio(bound, kind, values, change, steps, random);
      std::printf("%-60s largest error / bound %.3f\n", name.c_str(), largest);
      CHECK(largest <= 1);
      CHECK(largest >= bound.at_least);
    }
}

}  // namespace onset::tests
