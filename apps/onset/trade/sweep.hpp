// Tries every setting on a subject.
#pragma once

#include <functional>
#include <vector>

#include "onset/trade/subject.hpp"

namespace app {

struct SweepPlan {
  int repeats = 9;
  double seconds = 5;  // a setting is measured once, and again as long as this is not spent on it
};

// One round for the answers, which warms up too, then rounds over all settings in turn, so that what drifts
// on the machine meets them all. `done` is called after each call.
std::vector<Measured> sweep(Subject& subject, const std::vector<Setting>& settings, const SweepPlan& plan,
                            const std::function<void()>& done);

}  // namespace app
