// The search for the pairs whose separation the shape at rest lowers.
#pragma once

#include <memory>

#include "onset/mesh.hpp"
#include "onset/options.hpp"
#include "scene/pairs/rest_limits.hpp"
#include "src/shared/budget.hpp"

namespace onset {

// Returns the limits of all pairs that may keep less than a call with these options asks of them, found now
// or by an earlier call. Null where the mesh has no shape at rest, where no separation is asked for, or where
// the budget ends, for want of Options::memory_limit too: nothing may then be said of any pair.
std::shared_ptr<const RestLimits> rest_limits(const MeshData& mesh, const Options& options, Budget& budget);

}  // namespace onset
