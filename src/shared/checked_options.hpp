// Options checked once, and what follows from them for a motion.
#pragma once

#include "onset/options.hpp"
#include "scene/mesh_data.hpp"
#include "scene/motion/extents.hpp"
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

// Fills tolerance, extent and error_bound.
void describe_accuracy(const Motion& motion, const Extents& extents, const Options& options, Stats& stats);

}  // namespace onset
