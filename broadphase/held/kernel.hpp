// The interface of the inner loop that tests held pairs, one text that is compiled for every instruction set.
#pragma once

#include <cstddef>

#include "broadphase/box_test.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "scene/pair_sink.hpp"

namespace onset {

struct HeldArguments {
  const IdPair* pairs;
  std::size_t count;
  // Of the vertices of the first and the second side, by id: 16 floats, as FitArguments::supports. Of two
  // edges either may be the first; the smaller id is handed on as the first.
  const float *first_records, *second_records;
  // The vertices of edges (two each) or faces (three each), by id; not used for vertices.
  const int *first_vertices, *second_vertices;
  Sides sides;
  // Both ends or moving, never swept.
  BoxTest test;
  // As in TraverseArguments.
  int rounded_axes;
  bool linear;
  bool (*meets)(const void* context, int a, int b);
  const void* context;
  void (*consume)(void* context, const IdPair* pairs, std::size_t count);
  void* consume_context;
  bool (*stop)(void* context);
  void* stop_context;
  TraversalMemory* memory;
};

#define ONSET_DECLARE_HELD_KERNEL(isa)             \
  namespace isa {                                  \
  void test_pairs(const HeldArguments& arguments); \
  }
ONSET_DECLARE_HELD_KERNEL(held_scalar)
ONSET_DECLARE_HELD_KERNEL(held_avx2)
#undef ONSET_DECLARE_HELD_KERNEL

}  // namespace onset
