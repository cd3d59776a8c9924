// What calls cost as a Newton solver makes them: one after the other, on positions that hardly change.
#pragma once

#include <cstdint>
#include <string>

#include "files/scene/scene.hpp"
#include "measure/timing.hpp"
#include "onset/results/outputs.hpp"

namespace app {

struct LoopSettings {
  int calls = 12;
  // Of the recorded motion, the share that each call has.
  double motion = 1;
  // How far a coordinate changes from call to call at most, in usual edges.
  double change = 0.005;
  // Bytes that are read and written between calls, as a solver does, so that no cache is warm.
  std::int64_t pause_bytes = 0;
};

// CPU seconds of the calls after the third, with Options::hold_candidates and without, made in turns.
struct LoopCost {
  struct OfCall {
    Spread held, fresh;
    int served = 0;  // calls that held pairs were used in
  };
  OfCall active_set, step;
  int later_calls = 0;
};

// Throws std::runtime_error where what is held changes an answer.
LoopCost bench_loop(const Scene& scene, const onset::Options& options, const LoopSettings& settings);

Json loop_json(const LoopCost& cost, const LoopSettings& settings);
std::string describe(const LoopCost& cost, const LoopSettings& settings);

}  // namespace app
