// The interface of the inner loop that tests held pairs, one text that is compiled for every instruction set.
#pragma once

#include <cstddef>

#include "broadphase/bvh/kernel.hpp"

namespace onset {

// `test` is never the swept one.
struct HeldArguments : PairTestArguments {
  const IdPair* pairs;
  std::size_t count;
  // Of the vertices of the first and the second side, by id: 16 floats, as FitArguments::supports. Of two
  // edges either may be the first; the smaller id is handed on as the first.
  const float *first_records, *second_records;
  // The vertices of edges (two each) or faces (three each), by id; not used for vertices.
  const int *first_vertices, *second_vertices;
  // Places of vertices along diagonals, by id, where these are tested.
  const float *first_diagonals, *second_diagonals;
};

#define ONSET_DECLARE_HELD_KERNEL(isa)             \
  namespace isa {                                  \
  void test_pairs(const HeldArguments& arguments); \
  }
ONSET_DECLARE_HELD_KERNEL(held_scalar)
ONSET_DECLARE_HELD_KERNEL(held_avx2)
#undef ONSET_DECLARE_HELD_KERNEL

}  // namespace onset
