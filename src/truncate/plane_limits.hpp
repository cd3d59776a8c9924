// How far vertices may go before the planes of a mesh, which are planes to stay in front of as they are.
#pragma once

#include <vector>

#include "src/planes/plane_blocks.hpp"
#include "src/truncate/motion_limits.hpp"

namespace onset {

class PlaneLimits {
 public:
  PlaneLimits(const MeshData& mesh, const Motion& motion, const TruncateOptions& options)
      : mesh_(mesh), motion_(motion), options_(options), blocks_(mesh, motion.axes, options.norm) {}

  // Appends the vertices that do not certainly go all their way: at most `most`, with the limits that are
  // there already. Of these, plane.first is the height to keep, an approximation. One that starts within its
  // separation keeps its own instead.
  void add(std::size_t most, Budget& budget, Gathered<MotionLimit>& all) const;

  // Says, exactly, whether a vertex that is stored at x keeps its separation, and nearly, whether the height
  // of its limit. Of one that starts within its separation it says, exactly, whether it comes no closer.
  bool keeps(const MotionLimit& limit, const double* x) const;

  // The heights of its limit that a vertex has to lose at both ends of its motion, and what storing can
  // change: nearly. Of one that starts within its separation only their signs are right.
  struct Heights {
    double start, end, rounding;
  };
  Heights heights(const MotionLimit& limit) const;

 private:
  double separation(int vertex) const;
  bool comes_no_closer(const MotionLimit& limit, const double* x) const;

  const MeshData& mesh_;
  const Motion& motion_;
  const TruncateOptions& options_;
  const PlaneBlocks blocks_;
};

}  // namespace onset
