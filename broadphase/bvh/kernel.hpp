// The inner loops of the tree: plain pointers and counts, one text, compiled for every instruction set.
#pragma once

#include <cstddef>

#include "broadphase/box_test.hpp"
#include "scene/pair_sink.hpp"

namespace onset {

// A float box is given by its supports: how far it reaches along -x -y -z +x +y +z, at the start of the
// motion and then at its end. The union of boxes is the maximum of their supports; along an axis, two boxes
// are apart where a support and the opposite support of the other have a negative sum. A swept box has 6
// supports, a motion box 12. Boxes are stored in blocks of eight, one row of eight floats a support; unused
// lanes hold kNowhere.
inline constexpr int kBlock = 8;
inline constexpr float kNowhere = -0x1p126f;
inline constexpr int kMaxLevels = 12;

// Indexed by whether boxes are motion boxes. (No inline functions here: the linker could keep the AVX2 copy
// for everyone.)
inline constexpr int kRowsOf[2] = {6, 12};
inline constexpr int kBoxStrideOf[2] = {8, 16};

// An implicit tree: lane i of block n of level l > 0 is the union of block 8 n + i of level l - 1. There are
// at least three levels, and the last one has one block.
struct TreeView {
  float* level[kMaxLevels];
  float* box[kMaxLevels];  // per block: the union of its boxes, kBoxStrideOf floats, the supports first
  int blocks[kMaxLevels];
  int levels;
  const int* ids;       // 8 a leaf block
  const int* vertices;  // ranks or ids; 8 a vertex of the primitive a leaf block
  // Null unless keys are compared (scene/primitive_filter.hpp). bodies: eight a block, PrimitiveKey::body of
  // what all of a lane has in common, 0 where it has not. keys: three rows of 8 a leaf block: flags, group, mask.
  const int* bodies[kMaxLevels];
  const int* keys;
};

struct FitArguments {
  TreeView tree;
  bool motion;
  // Records of kBoxStrideOf floats: -x -y -z 0 +x +y +z 0 at t = 0, then at t = 1.
  const float* supports;
  const int* members;  // members_each rows of 8 a leaf block: the records whose union is the box of a lane
  int members_each;
};

// What is on each side; of two edges the smaller id comes first. Edges against faces by the swept test only.
enum class Sides { vertices_faces, edges_edges, edges_faces };

struct TraverseArguments {
  TreeView query, tree;
  BoxTest test;
  Sides sides;
  bool self;   // one tree of edges: each unordered pair once
  bool keyed;  // both trees have bodies and keys, which are tested
  int rounded_axes;         // bit i: equal floats on axis i need not be equal doubles
  std::size_t first, last;  // blocks at level 1 of `query`: 64 primitives each
  bool linear;  // motion boxes: supports are those of a linear map, but for the rounding to float
  // Decides pairs that float cannot.
  bool (*meets)(const void* context, int a, int b);
  // Decides pairs both of whose keys have kExcludedFlag.
  bool (*excluded)(const void* context, int a, int b);
  const void* context;  // of both
  void (*consume)(void* context, const IdPair* pairs, std::size_t count);
  void* consume_context;
};

#define ONSET_DECLARE_BVH_KERNEL(isa)                                                                \
  namespace isa {                                                                                    \
  void fit_leaves(const FitArguments& arguments, std::size_t first, std::size_t last);               \
  void fit_level(const TreeView& tree, int level, bool motion, std::size_t first, std::size_t last); \
  void traverse(const TraverseArguments& arguments);                                                 \
  }
ONSET_DECLARE_BVH_KERNEL(bvh_scalar)
ONSET_DECLARE_BVH_KERNEL(bvh_avx2)
#undef ONSET_DECLARE_BVH_KERNEL

}  // namespace onset
