// The tree over the primitives of one kind: an order along a space-filling curve, and eight boxes a node.
#pragma once

#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh/float_boxes.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "broadphase/bvh/vertex_order.hpp"

namespace onset {

// The entry points of kernel.hpp for one instruction set.
struct BvhKernel {
  decltype(&bvh_scalar::fit_leaves) fit_leaves;
  decltype(&bvh_scalar::fit_level) fit_level;
  decltype(&bvh_scalar::traverse) traverse;
};
const BvhKernel& bvh_kernel(InstructionSet kernel);  // scalar or avx2

class BoxTree {
 public:
  // Of the primitives listed, whose vertices all have a rank. `alone`: it is traversed against itself and
  // other trees of the same order only; else vertices are told apart by ids, which all orders share.
  BoxTree(const MeshData& mesh, Primitive kind, const IdList& list, const VertexOrder& order, bool alone);

  // New boxes, widened by `inflation` and the primitives' own thickness. `vertices`: supports of the vertices
  // by rank, widened alike, used where no primitive has an inflation of its own.
  void fit(const BroadPhaseInput& input, double inflation, const FloatMap& map, const Supports& vertices);

  // Whether the unions of the boxes of both trees, fitted, are apart.
  bool apart(const BoxTree& other, bool motion) const;
  std::size_t units() const { return (blocks() + kBlock - 1) / kBlock; }  // of traversal: blocks at level 1
  const TreeView& view() const { return view_; }
  int rounded_axes() const { return rounded_axes_; }
  // Motion boxes only: whether all coordinates went through a linear map, but for the rounding to float.
  bool linear() const { return linear_; }

 private:
  std::size_t blocks() const { return ids_.size() / kBlock; }
  float reach(int row) const;  // that support of the union of all boxes
  void lay_out(bool motion);
  void make_keys(const MeshData& mesh);

  Primitive kind_;
  std::size_t count_;
  int rounded_axes_ = 0;
  bool linear_ = false;
  AlignedArray<int> ids_, vertices_;        // see TreeView; vertices_: ranks
  std::vector<int> names_, bodies_, keys_;  // names_: vertices_ as ids, empty where ranks will do
  AlignedArray<float> boxes_;
  TreeView view_{};
};

}  // namespace onset
