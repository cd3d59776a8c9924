// The tree over the primitives of one kind: an order along a space-filling curve, and eight boxes a node.
#pragma once

#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh_kernel.hpp"
#include "broadphase/supports.hpp"

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
  // `vertices`: of all vertices, as vertex_supports gives them; used where no primitive has an inflation of
  // its own.
  BoxTree(const BroadPhaseInput& input, const FloatMap& map, const Supports& vertices, Primitive kind);

  // New boxes, same order.
  void refit(const BroadPhaseInput& input, const FloatMap& map, const Supports& vertices);

  std::size_t blocks() const { return (count_ + kBlock - 1) / kBlock; }
  const TreeView& view() const { return view_; }
  int rounded_axes() const { return rounded_axes_; }

 private:
  void sort(const MeshData& mesh, const Supports& supports, bool own);
  void link(const MeshData& mesh);
  void lay_out(bool motion);

  Primitive kind_;
  std::size_t count_;
  int rounded_axes_ = 0;
  std::vector<int> ids_, vertices_;  // see TreeView
  AlignedArray<float> boxes_;
  TreeView view_{};
};

}  // namespace onset
