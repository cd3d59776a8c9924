// The tests that make a pair a candidate, and which of them is cheaper.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "onset/export.hpp"

namespace onset {

struct MeshData;
struct Motion;

// When two boxes, closed and widened outward, overlap (docs/theory.md, L29):
// - swept: the boxes of the whole motion overlap.
// - both_ends: no axis separates them on one side at both ends; a subset of swept up to outward rounding.
// - moving: in addition, moving linearly from start to end, they are together at some time, give or take
//   2^-45 of it. This pays where things move by more than twice their size.
enum class BoxTest { swept, both_ends, moving };

// Returns both_ends or moving, as a sample of the moving edges promises the cheaper step. Earlier calls do
// not matter.
BoxTest cheaper_box_test(const MeshData& mesh, const Motion& motion);

// What it asks of an edge: its largest extent at the start, and how far its first vertex moves.
struct EdgeSample {
  double size;
  std::array<double, 3> moved;
};
ONSET_API EdgeSample sample_edge(const Motion& motion, const std::array<int, 2>& edge);
// Of the moving edges, in the order of ids, every so many is in the sample, from the first on.
ONSET_API std::size_t sampled_edge_stride(std::size_t moving_edges);
// Decides by a sample in that order.
ONSET_API BoxTest cheaper_box_test(const std::vector<EdgeSample>& samples);

}  // namespace onset
