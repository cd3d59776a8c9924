// Boxes in, candidate pairs out: the interface that the BVH, the spatial hash and brute force share.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "broadphase/box_test.hpp"
#include "onset/options.hpp"
#include "scene/mesh_data.hpp"
#include "scene/motion/motion.hpp"
#include "scene/pair_source.hpp"
#include "scene/primitive.hpp"

namespace onset {

struct BroadPhaseInput {
  const MeshData& mesh;
  const Motion& motion;
  double inflation =
      0;  // every primitive is widened by this, plus the largest thickness of its vertices, rounded outward
  double t_max = 1;  // only the motion on [0, t_max] matters; t_max 1 means the exact end positions
  BoxTest test = BoxTest::both_ends;
  InstructionSet instruction_set = InstructionSet::automatic;
  // For primitives all of whose vertices are static, in place of `inflation`; < 0: the same. Their boxes are
  // kept with the mesh from call to call as long as this stays what it was.
  double static_inflation = -1;
  // The pairs wanted are of kEdgeFace alone, by the swept test; else of both kinds that a step has.
  bool edges_against_faces = false;
};

inline std::vector<PairKind> wanted_kinds(const BroadPhaseInput& input) {
  if (input.edges_against_faces) return {kEdgeFace};
  return {PairKind::vertex_face, PairKind::edge_edge};
}
inline bool is_wanted(const BroadPhaseInput& input, Primitive kind) {
  return kind != Primitive::vertex || !input.edges_against_faces;
}

// Emits each pair that the mesh lets meet (may_meet in scene/primitive_filter.hpp) and that passes the test,
// exactly once.
class BroadPhase : public PairSource {
 public:
  virtual const char* name() const = 0;
  // New boxes in the memory and the order already there: another motion, t_max, inflation or test over the
  // same mesh (the same MeshData object) and kinds of pairs. Afterwards as if made from `input`, up to the
  // order of pairs.
  virtual void refit(const BroadPhaseInput& input) = 0;
  // Whether the order already there is about as good for this motion as it was for the one that it was made
  // for: a broad phase that an earlier call used is then worth a refit.
  virtual bool suits(const Motion&) const { return false; }
  // Whether boxes of static primitives were made, not taken from an earlier call.
  virtual bool made_static_boxes() const { return false; }
};

// `input.mesh` and `input.motion` must outlive the result, or its use up to the next refit.
std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseMethod method, const BroadPhaseInput& input);

}  // namespace onset
