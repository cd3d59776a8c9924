#include "tests/soak/timing.hpp"

#include <algorithm>
#include <cmath>

#include "tests/soak/process.hpp"

namespace onset::tests {
namespace {

// Some microseconds of doubles in the cache, as most of the calls' work is.
double yardstick_work() {
  static std::vector<double> values(2000, 1.5);
  double sum = 0;
  for (int round = 0; round < 4; ++round)
    for (std::size_t i = 0; i < values.size(); ++i) sum += std::sqrt(values[i] + sum * 1e-9);
  return values[0] = 1.5 + sum * 1e-300;
}

double median_of(std::vector<double> values) {
  if (values.size() < 100) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double Tenth::Samples::median() const {
  return median_of({seconds.begin(), seconds.begin() + std::ptrdiff_t(count)});
}

Tenth::Tenth(std::size_t most) {
  for (Samples& s : samples_) s.seconds.assign(most, 0.0);
  yardstick_.seconds.assign(most, 0.0);
}
void Tenth::add(Asked asked, double seconds) { samples_[std::size_t(asked)].add(seconds); }
void Tenth::measure_yardstick() {
  const double before = cpu_seconds();
  if (yardstick_work() > 0) yardstick_.add(cpu_seconds() - before);
}

double Tenth::ratio_of_medians(Asked asked, const Tenth& first) const {
  const double before = first.samples_[std::size_t(asked)].median();
  const double yard = yardstick() * before;
  return yard > 0 ? samples_[std::size_t(asked)].median() * first.yardstick() / yard : 0;
}

double Tenth::median_of_ratios(Asked asked, const Tenth& first) const {
  const Samples &after = samples_[std::size_t(asked)], &before = first.samples_[std::size_t(asked)];
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(after.count, before.count); ++i)
    ratios.push_back(after.seconds[i] / before.seconds[i]);
  return yardstick() > 0 ? median_of(ratios) * first.yardstick() / yardstick() : 0;
}

}  // namespace onset::tests
