// What the library's calls cost on one scene.
#pragma once

#include <cstdint>
#include <onset/onset.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/scene/scene.hpp"
#include "measure/timing.hpp"

namespace app {

// One call, repeated, in seconds. `broad` and `narrow` are the library's own account of the wall time.
struct CallCost {
  Spread wall, cpu, broad, narrow;
  std::optional<std::int64_t> peak_bytes;  // of one call, beyond what was resident before
};

struct SceneCost {
  CallCost active_set, step, pairs;  // pairs: swept boxes counted, none stored
  onset::Stats stats;                // of the active set, with the swept pairs filled in
  onset::StepResult step_result;
  std::uint64_t hash = 0;  // of the active set

  double narrow_ns_a_candidate() const;  // of CPU time, which is shared out as the wall time is
  double checks_a_hit() const;
};

// Runs each call once, for its memory and to warm up, then all of them in turn `repeats` times; 0: the first
// runs are those timed. No pairs are held between calls. Throws std::runtime_error where two runs of the
// active set differ.
SceneCost bench_scene(const Scene& scene, const onset::Options& options, int repeats);

// FNV-1a over kind, a, b, the bits of toi and status, row after row: the same on every machine of the same
// byte order.
std::uint64_t hash_of(const onset::ActiveSet& set);

}  // namespace app
