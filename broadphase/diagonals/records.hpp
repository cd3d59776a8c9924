// Places of vertices along the diagonals in single precision, and what sums of them decide.
#pragma once

#include "base/aligned.hpp"
#include "broadphase/broad_phase.hpp"
#include "broadphase/diagonals/kernel.hpp"

namespace onset {

// The records of vertices, by their place in a list or by id.
struct DiagonalRecords {
  AlignedArray<float> records;
  DiagonalRange range;
  LinearMap map{};
  // Of all vertices of the mesh.
  double thinnest = 0, thickest = 0;

  // Makes those of the vertices ids[0..count), at their places, or at their ids of which there are
  // `size`. The memory there is used again. They are not to be used where it was stopped.
  void write(const BroadPhaseInput& input, double t_max, const LinearMap& by, const int* ids,
             std::size_t count, std::size_t size, bool by_id, const Stop& stop = {});
};

// Of the vertices of two primitives that are widened by these inflations and their thickness. Both must have
// gone through one map.
DiagonalLimits diagonal_limits(const BroadPhaseInput& input, double inflations, const DiagonalRecords& a,
                               const DiagonalRecords& b);

}  // namespace onset
