#include "broadphase/broad_phase.hpp"

#include <utility>

#include "broadphase/brute_force.hpp"
#include "broadphase/bvh/bvh.hpp"
#include "broadphase/hash/spatial_hash.hpp"
#include "broadphase/part_pairs.hpp"

namespace onset {

namespace {

std::unique_ptr<BroadPhase> make(BroadPhaseMethod method, const BroadPhaseInput& input, const Stop& stop) {
  switch (method) {
    case BroadPhaseMethod::brute:
      return make_brute_force(input, stop);
    case BroadPhaseMethod::hash:
      return make_spatial_hash(input, stop);
    default:
      return make_bvh(input, stop);
  }
}

}  // namespace

// The default is the tree: the hash took 1.4 to 3 times as long on every scene measured
// (docs/performance.md).
std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseMethod method, const BroadPhaseInput& input,
                                             const Stop& stop) {
  std::unique_ptr<BroadPhase> made = make(method, input, stop);
  if (!made->ready())
    made.reset();
  else if (input.mesh.whole)
    made = pairs_of_part(std::move(made), input);
  return made;
}

}  // namespace onset
