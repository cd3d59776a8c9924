// The interface of the inner loops of the tree, one text that is compiled for every instruction set.
#pragma once

#include <cstddef>

#include "broadphase/box_test.hpp"
#include "broadphase/diagonals/kernel.hpp"
#include "scene/pair_sink.hpp"

namespace onset {

// A box is given by its supports: how far it reaches along -x -y -z +x +y +z. A swept box has 6, a motion box
// 12: those at the start, then those at the end. The union of boxes is the maximum of their supports; two
// boxes are apart along an axis where opposite supports have a negative sum. A block of eight boxes has a row
// of eight floats a support; unused lanes hold kNowhere.
inline constexpr int kBlock = 8;
inline constexpr float kNowhere = -0x1p126f;
inline constexpr int kMaxLevels = 12;

// Indexed by whether boxes are motion boxes. (Of an inline function the linker could keep the AVX2 copy.)
inline constexpr int kRowsOf[2] = {6, 12};
inline constexpr int kBoxStrideOf[2] = {8, 16};

// An implicit tree: lane i of block n of level l > 0 is the union of block 8 n + i of level l - 1. There are
// at least three levels, and the last one has one block.
struct TreeView {
  float* level[kMaxLevels];
  // The union of each block, kBoxStrideOf floats, the supports first.
  float* box[kMaxLevels];
  int blocks[kMaxLevels];
  int levels;
  // 8 a leaf block.
  const int* ids;
  // Ranks or ids; a row of 8 for each vertex of a primitive, a leaf block.
  const int* vertices;
  // Its records are null where no diagonals are tested.
  DiagonalPlaces diagonals;
  // These are null unless keys are compared (scene/primitive_filter.hpp).
  // The PrimitiveKey::body that all of a lane shares, or 0; eight a block.
  const int* bodies[kMaxLevels];
  // Flags, group and mask: three rows of 8 a leaf block.
  const int* keys;
};

struct FitArguments {
  TreeView tree;
  bool motion;
  // Records of kBoxStrideOf floats: -x -y -z 0 +x +y +z 0 at t = 0, then at t = 1.
  const float* supports;
  // The records whose union is the box of a lane: members_each rows of 8 a leaf block.
  const int* members;
  int members_each;
};

// The primitives of a pair; of two edges the smaller id is first. Edges against faces take the swept test
// only.
enum class Sides { vertices_faces, edges_edges, edges_faces, vertices_edges };

// What a traversal keeps its lists in: more than a thread's stack may have to spare.
struct TraversalMemory {
  alignas(32) unsigned char bytes[44 << 10];
};

// What makes the supports of vertices without thickness, through a linear FloatMap.
struct SupportArguments {
  double centre[4], scale, inverse;  // of the map; the fourth is padding
  const double* motion;              // a row of eight a vertex: x y z 0 at t = 0, x y z 0 at t = 1
  const int* ids;
  double inflation, t_max;
  // Whether a record has one end only, that of the whole motion.
  bool swept;
  // Where the record of ids[i] goes: at i, or at its id.
  bool by_id;
  float* records;
};

// How pairs are tested, and where those that pass go.
struct PairTestArguments {
  BoxTest test;
  Sides sides;
  // Bit i: equal floats on axis i need not be equal doubles.
  int rounded_axes;
  // Whether the boxes of both sides are BoxTree::linear.
  bool linear;
  // Null unless diagonals are tested, too.
  const DiagonalLimits* diagonals;
  // Decide pairs that float cannot: about boxes, and about some of the diagonals.
  bool (*meets)(const void* context, int a, int b);
  bool (*diagonals_apart)(const void* context, int a, int b, unsigned which);
  const void* context;
  void (*consume)(void* context, const IdPair* pairs, std::size_t count);
  void* consume_context;
  // As Stop::asked: null, or says whether the rest need not be looked at.
  bool (*stop)(void* context);
  void* stop_context;
  TraversalMemory* memory;
};

// A leaf block of the query and some lanes of a block at level 1 of the other tree, which are leaf blocks,
// too.
struct BlockRun {
  int query, node, lanes;
};
// Takes runs from whoever lists them. It returns false where the rest need not come.
struct BlockRunSink {
  void* context;
  bool (*take)(void* context, const BlockRun* runs, std::size_t count);
};

struct TraverseArguments : PairTestArguments {
  TreeView query, tree;
  // Whether both are one tree: each unordered pair is then found once.
  bool self;
  // Whether both trees have keys, which are then compared.
  bool keyed;
  // Blocks at level 1 of `query`, of 64 primitives each, where there is no `list`.
  std::size_t first, last;
  // Decides pairs both of whose keys have kExcludedFlag.
  bool (*excluded)(const void* context, int a, int b);
  // Null, or lists the pairs of leaf blocks that may meet, each once; kernels then look at no level above 1.
  // Of one tree the query has no larger number than the others.
  void (*list)(const void* context, const BlockRunSink& sink);
  const void* list_context;
};

#define ONSET_DECLARE_BVH_KERNEL(isa)                                                                \
  namespace isa {                                                                                    \
  void fit_leaves(const FitArguments& arguments, std::size_t first, std::size_t last);               \
  void fit_level(const TreeView& tree, int level, bool motion, std::size_t first, std::size_t last); \
  int write_vertices(const SupportArguments& arguments, std::size_t first, std::size_t last);        \
  void traverse(const TraverseArguments& arguments);                                                 \
  }
ONSET_DECLARE_BVH_KERNEL(bvh_scalar)
ONSET_DECLARE_BVH_KERNEL(bvh_avx2)
#undef ONSET_DECLARE_BVH_KERNEL

}  // namespace onset
