#include "tests/soak/timing.hpp"

#include <algorithm>

namespace onset::tests {
namespace {

double median_of(std::vector<double> values) {
  if (values.size() < 100) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double Durations::Samples::median() const {
  return median_of({seconds.begin(), seconds.begin() + std::ptrdiff_t(count)});
}

Durations::Durations(std::size_t most) {
  for (Samples& s : samples_) s.seconds.assign(most, 0.0);
}
void Durations::add(Asked asked, double seconds) {
  Samples& s = samples_[std::size_t(asked)];
  if (s.count < s.seconds.size()) s.seconds[s.count++] = seconds;
}

double Durations::ratio_of_medians(Asked asked, const Durations& other) const {
  const double there = other.samples_[std::size_t(asked)].median();
  return there > 0 ? samples_[std::size_t(asked)].median() / there : 0;
}

double Durations::median_of_ratios(Asked asked, const Durations& other) const {
  const Samples &here = samples_[std::size_t(asked)], &there = other.samples_[std::size_t(asked)];
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(here.count, there.count); ++i)
    ratios.push_back(here.seconds[i] / there.seconds[i]);
  return median_of(ratios);
}

}  // namespace onset::tests
