// What a step, an active set and a yes or no promise about a scene, checked against its exact contacts.
#pragma once

#include <string>

#include "tests/steps/support/calls.hpp"
#include "tests/steps/support/scene_truth.hpp"

namespace onset::tests {

// All functions: empty, or the promise that is broken and by which pair.

// The exact motion keeps all separations on [0, step]; the positions that it rounds to, in any order of
// operations, do so too; parting pairs come no closer than they were.
std::string broken_by_moving(const Asked& asked, const SceneTruth& truth, double step, double rounding);

// A step of 0 where every gap is more than twice the rounding that is told.
std::string stuck(const Asked& asked, const StepResult& r);

// toi, toi_hi, outcome and limiting pair say what is so. Exact times are promised by Call::whole alone; a
// step from close pairs may end before 1 without a pair.
std::string wrong_report(const Asked& asked, const SceneTruth& truth, const StepResult& r,
                         Call call = Call::whole);

// Every contact is in the set up to complete_until, none late, those at the start as such; at
// Exactness::exact without separations no others.
std::string wrong_set(const Asked& asked, const SceneTruth& truth, const ActiveSet& set);

// The three answers of the pipeline agree with each other.
std::string disagreement(const StepResult& r, const ActiveSet& set, bool free);

// A pair that keeps less of its gap than it was to.
std::string share_lost(const Asked& asked, const CallStep& step);

// Everything above, of all calls; d_hat > 0: of the close pairs; keep: the share. What the adapter cannot
// take it is not asked.
std::string broken_promise(const Asked& asked, const Calls& calls, double d_hat,
                           double gap_share = kGapShare);

}  // namespace onset::tests
