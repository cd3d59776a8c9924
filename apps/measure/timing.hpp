// Repeated measurements: what is reported of them.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace app {

struct Spread {
  double median = 0, least = 0, most = 0;
};

inline Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

// Wall time, and CPU time of all threads: on a machine that others use, the second says what the work cost.
struct Seconds {
  double wall = 0, cpu = 0;
};

class Stopwatch {
 public:
  Seconds elapsed() const {
    const auto wall = std::chrono::steady_clock::now() - wall_;
    return {std::chrono::duration<double>(wall).count(), cpu_now() - cpu_};
  }

 private:
  static double cpu_now() {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = cpu_now();
};

// Wall time of one call, for those too short for CPU clocks.
template <class Call>
double microseconds(Call&& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace app
