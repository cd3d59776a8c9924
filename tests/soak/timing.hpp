// Whether calls grow slower: the same work, in turns, by this process and by one that has just begun.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/soak/cloth.hpp"

namespace onset::tests {

// CPU seconds of each call, in order.
class Durations {
 public:
  // Memory for so many of each kind is taken, and touched, at once.
  explicit Durations(std::size_t most);
  void add(Asked asked, double seconds);
  // How much longer a call took than in `other`, which asked the same: by the medians of both, and by the
  // median over what each one call took by what it took there. 0 where there are fewer than 100.
  double ratio_of_medians(Asked asked, const Durations& other) const;
  double median_of_ratios(Asked asked, const Durations& other) const;

 private:
  struct Samples {
    std::vector<double> seconds;
    std::size_t count = 0;
    double median() const;
  };
  std::array<Samples, kAsked> samples_;
};

// A call is slower where both of them are above this.
constexpr double kNoise = 1.25;

}  // namespace onset::tests
