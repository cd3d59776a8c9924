#include "sweep.hpp"

#include <numeric>

namespace app {

std::vector<Measured> sweep(Subject& subject, const std::vector<Setting>& settings, const SweepPlan& plan,
                            const std::function<void()>& done) {
  std::vector<Measured> all;
  for (const Setting& setting : settings) {
    all.push_back({setting, {}, {}, {}, {}, {}, {}});
    subject.answer(all.back());
    done();
  }
  const double scale = subject.grounds().primitives ? 1 : double(all.front().answers.asked);
  const auto spent = [&](const Measured& m) {
    return 1e-6 * scale * std::accumulate(m.wall.begin(), m.wall.end(), 0.0);
  };
  for (int round = 0; round < plan.repeats; ++round)
    for (Measured& m : all)
      if (round < 2 || spent(m) < plan.seconds) subject.time(m), done();
  return all;
}

}  // namespace app
