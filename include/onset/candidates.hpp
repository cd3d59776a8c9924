// The step of pairs that the caller has chosen: found once, filtered, kept from call to call.
#pragma once

#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>

namespace onset {

// The largest step free of contact, and safe to store, of the pairs listed (counts and statistics of `candidates` are not used),
// in any order. Pairs that are not listed are not looked at: the list must hold every pair that may touch, as
// compute_candidates gives for this motion, or for one that contains it, and the same min_separation or more.
// A pair that comes within the tolerance and never touches may limit this step and not that of the call
// without a list, which does not look at pairs whose boxes are never at one place at one time.
//
// gap_share in [0, 1): every pair keeps this share of its gap at x_t0, as in LineSearch, so that the next step is
// > 0.
//
// Throws as the call without a list, and std::invalid_argument naming the row for an id out of range or a
// pair that shares a vertex.
ONSET_API StepResult compute_collision_free_stepsize(const Mesh& mesh, const Candidates& candidates,
                                                     const Positions& x_t0, const Positions& x_t1,
                                                     const Options& options = {}, double gap_share = 0);

}  // namespace onset
