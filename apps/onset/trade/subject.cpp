#include "onset/trade/subject.hpp"

#include <algorithm>

namespace app {

onset::Options finest(onset::Options base) {
  const onset::Options defaults;
  base.time_limit = defaults.time_limit, base.check_limit = defaults.check_limit;
  base.tolerance.reset();
  base.relative_tolerance = 1e-12;
  base.max_checks = std::max<std::int64_t>(base.max_checks, 1'000'000);
  base.narrow_phase = onset::NarrowPhaseMethod::automatic;
  base.exactness = onset::Exactness::conservative;
  return base;
}

std::vector<Measured> sweep(Subject& subject, const std::vector<Setting>& settings, const SweepPlan& plan,
                            const std::function<void()>& done) {
  std::vector<Measured> all;
  std::vector<double> warm_up;  // seconds
  for (const Setting& setting : settings) {
    all.push_back({setting, {}, {}, {}, {}, {}, {}});
    const Stopwatch watch;
    subject.answer(all.back());
    warm_up.push_back(watch.elapsed().wall);
    done();
  }
  for (int round = 0; round < plan.repeats; ++round)
    for (std::size_t i = 0; i < all.size(); ++i)
      if (round == 0 || (round + 1) * warm_up[i] < plan.seconds) subject.time(all[i]), done();
  return all;
}

}  // namespace app
