// What the kernel texts that make records of diagonals and test pairs by them are given.
#pragma once

#include <cstddef>

namespace onset {

// A record of a vertex has its places along the diagonals at t = 0, then at t = 1, through a linear
// map; of a vertex that is too far out for the error of the others it has kFarOut and -kFarOut, with which
// nothing is apart.
inline constexpr int kDiagonalStride = 16;
inline constexpr float kFarOut = 0x1p100f;
// So far out, the sum of the magnitudes of its coordinates; and at t = 1, where only the motion up to a
// t_max < 1 matters.
inline constexpr double kFarthest = 0x1p6, kFarthestEnd = 0x1p12;

// Maps x to (x - centre) * scale, a power of two.
struct LinearMap {
  double centre[3], scale;
};

// What makes the records of vertices.
struct DiagonalArguments {
  LinearMap map;
  const double* motion;  // a row of eight a vertex: x y z 0 at t = 0, x y z 0 at t = 1
  const int* ids;
  double t_max;
  // Where the record of ids[i] goes: at i, or at its id.
  bool by_id;
  float* records;
};

// The largest sum of magnitudes of coordinates of those that are not too far out, and whether others are.
struct DiagonalRange {
  double largest = 0;
  bool far_out = false;
};

// Two primitives are apart where, with the smallest of their reaches over one another along a diagonal, the
// sum with its `apart` is negative. They certainly are not where all sums with `together` are positive or 0.
struct DiagonalLimits {
  float apart[8], together[8];
  // Whether there may be vertices of kFarOut, for which the latter says nothing. The smallest reach of a pair
  // with such a vertex is 0 or about kFarOut along all diagonals.
  bool far_out;
};

// The records of vertices, and which of them are those of primitives: in rows of eight, a row for each
// vertex of a primitive, one block after the other.
struct DiagonalPlaces {
  const float* records;
  const int* vertices;
};

#define ONSET_DECLARE_DIAGONALS_KERNEL(isa)                                                             \
  namespace isa {                                                                                       \
  DiagonalRange write_records(const DiagonalArguments& arguments, std::size_t first, std::size_t last); \
  }
ONSET_DECLARE_DIAGONALS_KERNEL(diagonals_scalar)
ONSET_DECLARE_DIAGONALS_KERNEL(diagonals_avx2)
#undef ONSET_DECLARE_DIAGONALS_KERNEL

}  // namespace onset
