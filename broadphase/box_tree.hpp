// The tree over the primitives of one kind: an order along a space-filling curve, and eight boxes a node.
#pragma once

#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh_kernel.hpp"
#include "broadphase/supports.hpp"
#include "broadphase/vertex_order.hpp"

namespace onset {

// The entry points of bvh_kernel.hpp for one instruction set.
struct BvhKernel {
  decltype(&bvh_scalar::fit_leaves) fit_leaves;
  decltype(&bvh_scalar::fit_level) fit_level;
  decltype(&bvh_scalar::traverse) traverse;
};
const BvhKernel& bvh_kernel(Kernel kernel);  // scalar or avx2

class BoxTree {
 public:
  BoxTree(const MeshData& mesh, Primitive kind, const VertexOrder& order);

  // New boxes. `vertices`: supports of all vertices by rank, used where no primitive has an inflation of its
  // own.
  void fit(const BroadPhaseInput& input, const FloatMap& map, const Supports& vertices);

  std::size_t units() const { return (blocks() + kBlock - 1) / kBlock; }  // of traversal: blocks at level 1
  const TreeView& view() const { return view_; }
  int rounded_axes() const { return rounded_axes_; }

 private:
  std::size_t blocks() const { return ids_.size() / kBlock; }
  void lay_out(bool motion);

  Primitive kind_;
  std::size_t count_;
  int rounded_axes_ = 0;
  AlignedArray<int> ids_, vertices_;  // see TreeView
  AlignedArray<float> boxes_;
  TreeView view_{};
};

}  // namespace onset
