// The interface of the broad phases (tree, spatial hash, brute force): boxes in, candidate pairs out.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/stop.hpp"
#include "broadphase/box_test.hpp"
#include "onset/options.hpp"
#include "scene/mesh_data.hpp"
#include "scene/motion/motion.hpp"
#include "scene/pair_source.hpp"
#include "scene/primitive.hpp"

namespace onset {

// Which of the pairs a call will look at: all, all up to the earliest contact, or until there is one.
enum class Looks { at_all, at_earliest, at_any };

// Whether pairs that pass the test of boxes are put to that of broadphase/diagonals.hpp, too, and by how much
// more than their inflations they then have to be apart, in which norm, to be dropped.
struct DiagonalTest {
  bool used = false;
  Norm norm = Norm::euclidean;
  double margin = 0;
};

// What a broad phase is made from.
struct BroadPhaseInput {
  const MeshData& mesh;
  const Motion& motion;
  // Every primitive is widened by this and the largest thickness of its vertices, rounded outward.
  double inflation = 0;
  // Only the motion on [0, t_max] matters; 1 means the exact end positions.
  double t_max = 1;
  BoxTest test = BoxTest::both_ends;
  InstructionSet instruction_set = InstructionSet::automatic;
  // The inflation of static primitives; < 0: the same. The mesh keeps their boxes while this does not change.
  double static_inflation = -1;
  // Whether only pairs of intersection_kind are wanted, by the swept test; else all kinds that a step has.
  bool intersections = false;
  Looks looks = Looks::at_any;
  // The most pairs that may be held for later calls (broadphase/held/).
  std::size_t most_held = 0;
  // Never with the swept test.
  DiagonalTest diagonals = {};
};

inline std::vector<PairKind> wanted_kinds(const BroadPhaseInput& input) {
  if (input.intersections) return {intersection_kind(input.mesh)};
  if (input.mesh.dimension == 2) return {PairKind::vertex_edge};
  return {PairKind::vertex_face, PairKind::edge_edge};
}
inline bool is_wanted(const BroadPhaseInput& input, Primitive kind) {
  return kind != Primitive::vertex || !input.intersections;
}

// Streams exactly once each pair that may meet (may_meet in scene/primitive_filter.hpp) and passes the test.
class BroadPhase : public PairSource {
 public:
  virtual const char* name() const = 0;
  // Makes new boxes in the memory and order already there, as if made from `input` up to the order of pairs.
  // The MeshData object and the kinds of pairs must be the same. Where it was stopped, it is not ready().
  virtual void refit(const BroadPhaseInput& input, const Stop& stop) = 0;
  void refit(const BroadPhaseInput& input) { refit(input, Stop()); }
  // Otherwise it has no blocks, and may be refit again.
  bool ready() const { return ready_; }
  // Says whether the order there is about as good for this motion as for its own, so that a refit is worth
  // it.
  virtual bool suits(const Motion&) const { return false; }
  // Says whether boxes of static primitives were made, not taken from an earlier call.
  virtual bool made_static_boxes() const { return false; }

 protected:
  bool ready_ = false;
};

// `input.mesh` and `input.motion` must outlive the result, or its use up to the next refit. Null where it was
// stopped.
std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseMethod method, const BroadPhaseInput& input,
                                             const Stop& stop = {});

}  // namespace onset
