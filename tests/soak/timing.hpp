// Whether calls grow slower: the same work in the first tenth of a run and in the last.
#pragma once

#include <array>
#include <vector>

#include "tests/soak/cloth.hpp"

namespace onset::tests {

// What each call took in one tenth, beside a yardstick: work of the same size each time, that is done in
// turns with the calls. On a machine that others use it varies as the calls do.
class Tenth {
 public:
  // Memory for so many samples of each kind is taken, and touched, at once.
  explicit Tenth(std::size_t most);
  void add(Asked asked, double seconds);
  void measure_yardstick();
  double yardstick() const { return yardstick_.median(); }
  // How much longer a call took than in `first`, where it did the same, in units of the yardstick: by the
  // medians of both tenths, and by the median over what each one call took by what it took then. 0 where
  // there are fewer than 100 samples.
  double ratio_of_medians(Asked asked, const Tenth& first) const;
  double median_of_ratios(Asked asked, const Tenth& first) const;

 private:
  struct Samples {
    std::vector<double> seconds;
    std::size_t count = 0;
    void add(double s) {
      if (count < seconds.size()) seconds[count++] = s;
    }
    double median() const;
  };
  std::array<Samples, kAsked> samples_;
  Samples yardstick_;
};

// A call is slower where both of them are above this. On a machine with ten busy processes a core, 36 pairs
// of tenths of 1,000 steps had a median of ratios of at most 1.19.
constexpr double kNoise = 1.25;

}  // namespace onset::tests
