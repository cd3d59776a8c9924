// Options checked once, and what follows from them for a motion.
#pragma once

#include <array>

#include "onset/options.hpp"
#include "onset/result.hpp"
#include "scene/mesh_data.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// Throws std::invalid_argument naming the option and its value.
void check(const Options& options);
// The same for the share of a gap to keep.
void check_gap_share(double gap_share);

// The distance, rounded up, that the thickest pair must keep.
double largest_separation(const MeshData& mesh, const Options& options);

// Options::tolerance, or the relative one times R (> 0 in any case).
double absolute_tolerance(const Options& options, double extent);

// What of a step's size the narrow phase goes by.
struct Accuracy {
  double tolerance = 0;  // model length, > 0
  double extent = 0;     // R: the largest corner difference that an overlapping pair can have
  std::array<double, 3> error_bound{};  // of a corner, per axis of the caller's
};
Accuracy accuracy_of(const MeshData& mesh, const Motion& motion, const Options& options);
void note(const Accuracy& accuracy, Stats& stats);

}  // namespace onset
