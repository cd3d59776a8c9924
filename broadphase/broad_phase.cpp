#include "broadphase/broad_phase.hpp"

#include <stdexcept>

#include "broadphase/brute_force.hpp"
#include "broadphase/bvh.hpp"

namespace onset {

std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseMethod method, const BroadPhaseInput& input) {
  switch (method) {
    case BroadPhaseMethod::brute:
      return make_brute_force(input);
    case BroadPhaseMethod::hash:
      throw std::invalid_argument("broad phase `hash` is not available");
    default:
      return make_bvh(input);
  }
}

}  // namespace onset
