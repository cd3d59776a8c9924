// The check of options, and what follows from them for a motion.
#pragma once

#include <array>

#include "onset/export.hpp"
#include "onset/options.hpp"
#include "onset/result.hpp"
#include "scene/mesh_data.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// Throws std::invalid_argument naming the option and its value.
ONSET_API void check(const Options& options);
// Does the same for the share of a gap to keep.
ONSET_API void check_gap_share(double gap_share);

// Returns the distance, rounded up, that the thickest pair must keep: no less than separation_of_pair of any.
double largest_separation(const MeshData& mesh, const Options& options);

// Returns Options::tolerance, or the relative one times `extent`; always > 0 and finite.
double absolute_tolerance(const Options& options, double extent);

// The lengths, in units of the model, by which the narrow phase works.
struct Accuracy {
  double tolerance = 0;
  // The largest corner difference that a pair with overlapping boxes can have.
  double extent = 0;
  // Of a corner at any time, by the caller's axes.
  std::array<double, 3> error_bound{};
};
// Returns these for a motion.
Accuracy accuracy_of(const MeshData& mesh, const Motion& motion, const Options& options);
// Copies them into the statistics of a call.
void note(const Accuracy& accuracy, Stats& stats);

}  // namespace onset
