// The tree over primitives of one kind: eight boxes a node, in an order along a space-filling curve.
#pragma once

#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh/float_boxes.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "broadphase/bvh/vertex_order.hpp"

namespace onset {

// The entry points of broadphase/bvh/kernel.hpp for one instruction set.
struct BvhKernel {
  decltype(&bvh_scalar::fit_leaves) fit_leaves;
  decltype(&bvh_scalar::fit_level) fit_level;
  decltype(&bvh_scalar::write_vertices) write_vertices;
  decltype(&bvh_scalar::traverse) traverse;
};
// Returns the kernel of an instruction set, which it resolves.
const BvhKernel& bvh_kernel(InstructionSet kernel);

Sides sides_of(PairKind kind);

class BoxTree {
 public:
  // Takes the primitives listed, whose vertices must all have a rank. A tree that is traversed with one of
  // another `order` must not be `alone`: its vertices then go by ids, which all orders share. Where this, or
  // a fit, was stopped, the tree is not to be used.
  BoxTree(const MeshData& mesh, Primitive kind, const IdList& list, const VertexOrder& order, bool alone,
          const Stop& stop = {});

  // Makes the boxes, widened by `inflation` and thickness. `vertices` are the supports by rank, widened
  // alike, which suffice where there is no thickness.
  void fit(const BroadPhaseInput& input, double inflation, const FloatMap& map, const Supports& vertices,
           const Stop& stop = {});

  // Says whether the unions of all boxes of two fitted trees are apart.
  bool apart(const BoxTree& other, bool motion) const;
  // Returns the number of units of traversal: blocks at level 1.
  std::size_t units() const { return (blocks() + kBlock - 1) / kBlock; }
  const TreeView& view() const { return view_; }
  int rounded_axes() const { return rounded_axes_; }
  // Says whether these are motion boxes through a map that was linear, but for rounding to float.
  bool linear() const { return linear_; }

 private:
  std::size_t blocks() const { return ids_.size() / kBlock; }
  float reach(int row) const;  // a support of the union of all boxes
  void lay_out(bool motion);
  void make_keys(const MeshData& mesh, const Stop& stop);

  Primitive kind_;
  std::size_t count_;
  int rounded_axes_ = 0;
  bool linear_ = false;
  AlignedArray<int> ids_, vertices_;        // see TreeView; vertices_ are ranks
  std::vector<int> names_, bodies_, keys_;  // names_: vertices_ as ids, empty for an `alone` tree
  AlignedArray<float> boxes_;
  TreeView view_{};
};

}  // namespace onset
