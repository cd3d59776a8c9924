// The tree over primitives of one kind: eight boxes a node, in an order along a space-filling curve.
#pragma once

#include <vector>

#include "base/aligned.hpp"
#include "broadphase/bvh/float_boxes.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "broadphase/bvh/vertex_order.hpp"
#include "broadphase/diagonals/records.hpp"

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
  // The same of primitives that are in order: `slots` has their ids, eight a block, and -1 in unused lanes.
  BoxTree(const MeshData& mesh, Primitive kind, AlignedArray<int> slots, const VertexOrder& order, bool alone,
          const Stop& stop = {});

  // Makes the boxes, widened by `inflation` and thickness. `vertices` are the supports by rank, widened
  // alike, which suffice where there is no thickness. `diagonals`, by rank, must outlive the use of the tree;
  // null: there are none.
  void fit(const BroadPhaseInput& input, double inflation, const FloatMap& map, const Supports& vertices,
           const DiagonalRecords* diagonals, const Stop& stop = {});

  // Says whether the unions of all boxes of two fitted trees are apart.
  bool apart(const BoxTree& other, bool motion) const;
  // Returns the number of units of traversal: blocks at level 1.
  std::size_t units() const { return (blocks() + kBlock - 1) / kBlock; }
  const TreeView& view() const { return view_; }
  int rounded_axes() const { return rounded_axes_; }
  // Says whether these are motion boxes through a map that was linear, but for rounding to float.
  bool linear() const { return linear_; }
  // What the last fit was given.
  double inflation() const { return inflation_; }
  const DiagonalRecords* diagonals() const { return diagonals_; }

 private:
  std::size_t blocks() const { return ids_.size() / kBlock; }
  float reach(int row) const;  // a support of the union of all boxes
  void lay_out(bool motion);
  void list_vertices(const MeshData& mesh, const VertexOrder& order, bool alone, const Stop& stop);
  void make_keys(const MeshData& mesh, const Stop& stop);
  // Lists the ids in use, and for each slot the place of its id in that list, or its end.
  void list_used(std::vector<int>& ids, std::vector<int>& places, const Stop& stop) const;

  Primitive kind_;
  int rounded_axes_ = 0;
  bool linear_ = false;
  double inflation_ = 0;
  const DiagonalRecords* diagonals_ = nullptr;
  AlignedArray<int> ids_, vertices_;        // see TreeView; vertices_ are ranks
  std::vector<int> names_, bodies_, keys_;  // names_: vertices_ as ids, empty for an `alone` tree
  AlignedArray<float> boxes_;
  TreeView view_{};
};

// What kernels ask about a pair of primitives, and by what they test diagonals.
struct TreePairDecision : OverlapDecision {
  DiagonalLimits limits{};
  TreePairDecision(const BroadPhaseInput& input, PairKind kind, const BoxTree& query, const BoxTree& other);
  static bool excluded(const void* context, int a, int b) {
    const TreePairDecision& d = *static_cast<const TreePairDecision*>(context);
    return onset::excluded(d.input.mesh, d.kind, a, b);
  }
};

// Fills in all but the range, the list and the memory. `decide` and `sink` must outlive the traversal.
TraverseArguments traverse_arguments(const BoxTree& query, const BoxTree& other,
                                     const TreePairDecision& decide, const PairSink& sink);

}  // namespace onset
