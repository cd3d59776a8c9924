// How far the vertices of a group may go, by the planes of their pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/stop.hpp"
#include "src/truncate/motion_limits.hpp"
#include "src/truncate/plane_limits.hpp"
#include "src/truncate/vertex_groups.hpp"

namespace onset {

// Which limits each group has.
class LimitsOfGroups {
 public:
  // A vertex of the pair of a limit, by its place among the pair's four.
  struct Entry {
    std::uint32_t limit;
    std::uint8_t place;
  };
  // Where it is stopped, it must not be asked.
  LimitsOfGroups(const VertexGroups& groups, const std::vector<MotionLimit>& limits, const Stop& stop);
  const Entry* begin(std::size_t group) const { return entries_.data() + start_[group]; }
  const Entry* end(std::size_t group) const { return entries_.data() + start_[group + 1]; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::size_t> start_;
};

// What a vertex is to do, by the axes of the motion.
struct StoredVertex {
  double position[3], displacement[3];
};
// Moves a vertex by a share s of its motion, 0 <= s <= 1; all its way for 1.
StoredVertex moved(const Motion& motion, int vertex, double s);

struct Cut {
  // The share of its motion that each vertex of the group may go.
  double share = 1;
  // Which limit cuts it; -1: none.
  int limit = -1;
};
// Finds a share at which every vertex of the group, as moved() gives it, is certainly on its side of every
// plane; at worst 0, where each is.
Cut cut_group(const Motion& motion, const std::vector<MotionLimit>& limits, const PlaneLimits& planes,
              const LimitsOfGroups::Entry* first, const LimitsOfGroups::Entry* last);

}  // namespace onset
