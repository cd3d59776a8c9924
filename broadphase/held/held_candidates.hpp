// Pairs that a tree found once with wider boxes, and that later calls test again with their own.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "base/aligned.hpp"
#include "base/free_list.hpp"
#include "broadphase/broad_phase.hpp"
#include "broadphase/bvh/float_boxes.hpp"
#include "broadphase/diagonals/records.hpp"
#include "broadphase/held/kernel.hpp"

namespace onset {

// The positions that pairs were found from, at both ends, of all vertices that static_part does not hold.
struct HeldPositions {
  std::array<int, 3> axes{};
  AlignedArray<double> rows;
  // The largest magnitude of a coordinate.
  double largest = 0;
  std::shared_ptr<const StaticMotion> static_part;

  HeldPositions() = default;
  explicit HeldPositions(const BroadPhaseInput& input);
  // Returns how far a coordinate of one of them is at most from where it was, at either end:
  // infinite where that cannot be said. Sets `magnitude` to the largest magnitude of one, then or now.
  double moved(const BroadPhaseInput& input, double& magnitude) const;
};

// Guarantee: streams exactly the pairs that a fresh tree would find, in the blocks of the tree that it was
// made from (docs/theory.md, L50). Pairs that were put to diagonals when they were taken serve such
// calls alone.
class HeldCandidates {
 public:
  // Holds the pairs of a tree that was made from `input`, whose inflation has room for change. Returns false,
  // and holds nothing, where these are `most` or more, or it was stopped.
  bool take(const BroadPhase& tree, const BroadPhaseInput& input, std::size_t most, const Stop& stop);
  void clear();
  bool empty() const { return !held_; }

  // Says whether no pair of `input` can be missing, if positions are `moved` from those of take() and of this
  // magnitude at most, and it lets so many be held.
  bool cover(const BroadPhaseInput& input, double moved, double magnitude) const;
  // Makes the boxes of `input`, which must be covered and outlive their use.
  void fit(const BroadPhaseInput& input, double magnitude, const Stop& stop);

  std::size_t blocks(PairKind kind) const;
  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const;

  // The least by which an inflation has to be larger for anything to be covered.
  static double least_slack(const BroadPhaseInput& input, double magnitude);

 private:
  // The pairs of one kind, block after block; ends[i] is where block i ends.
  struct List {
    AlignedArray<IdPair> pairs;
    std::vector<std::size_t> ends;
    // By block: whether the primitives of a side are static; of two edges the first are not.
    std::vector<std::array<bool, 2>> is_static;
  };
  bool fill(const BroadPhase& tree, const BroadPhaseInput& input, PairKind kind, std::size_t most,
            const Stop& stop, List& list);
  void list_vertices(const BroadPhaseInput& input);

  bool held_ = false;
  std::size_t size_ = 0;
  BoxTest test_ = BoxTest::both_ends;
  double inflation_ = 0, static_inflation_ = 0;
  DiagonalTest tested_by_;  // what the pairs have passed beside the boxes
  std::array<List, kPairKinds> lists_;
  // Of what may move and of what is static: the vertices with a record, and the records by id.
  std::array<std::vector<int>, 2> vertices_;
  std::array<AlignedArray<float>, 2> records_;
  std::array<DiagonalRecords, 2> diagonals_;
  std::optional<BroadPhaseInput> input_;
  std::optional<FloatMap> map_;  // of the positions then: those that are covered are near them
  int rounded_axes_ = 0;
  bool linear_ = false;
  mutable FreeList<TraversalMemory> memory_;
};

}  // namespace onset
