// How far vertices may move before a collision check is due: bounds for those who skip it in some steps.
#pragma once

#include <onset/close_pairs.hpp>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <onset/step_size.hpp>
#include <vector>

namespace onset {

// The lemma. A point of a primitive is a convex combination of its vertices, so while every vertex stays
// within r_i of where it was, the point made of the same weights stays within the largest r_i of the
// primitive. The distance of a pair (A, B) therefore falls by at most max_A r_i + max_B r_i, on any path,
// straight or not.

// r_i for every vertex (#V, model length, >= 0): whatever path each vertex takes, no pair comes as close as
// its separation while |x_i(t) - x_i| <= r_i for all i. Pairs not listed in `close` were d_hat + separation
// apart, so r_i < d_hat / 2 keeps them beyond; listed pairs were separation + gap apart, so r_i < gap / 2 for
// their vertices does. Both are lowered by what storing x + s dx in doubles can add.
//
// x: the positions `close` was made for, with the same mesh. Throws std::invalid_argument where `close` has
// an outcome, or pairs that are not of this mesh. 0 for the vertices of a pair that touches, or whose gap is no more than
// storing can change it. Copies that CollisionRules::weld counts as one are taken to stay together. O(#V + pairs).
ONSET_API std::vector<double> safe_distances(const Mesh& mesh, const Positions& x, const ClosePairs& close);

// The largest s in [0, 1] with s |dx_i| <= r_i for all i (dx: #V x 3 as many rows as r has values, else
// throws std::invalid_argument); 0 where dx is not finite. By the lemma the step s dx needs no collision
// check. What is left for the next step without one is r_i - s |dx_i|.
ONSET_API double safe_step(const std::vector<double>& r, const Positions& dx);

// A step by collision checks of the pairs in `close` alone (made for x_t0 with the same options) and, for all
// others, by a bound of the Courant-Friedrichs-Lewy kind: they are d_hat + separation apart, no vertex moves
// farther than s max |dx|, so by the lemma with r_i = s max |dx| they stay beyond for s < d_hat / (2 max
// |dx|). No broad phase: O(#V + pairs). Never later than the exact first contact of the whole mesh; outcome
// `free` with step < 1 means that the bound ended it, not a pair; toi is no later than either says. Where a budget of `options` is spent, the
// step is that of safe_distances, which looks at no pair: > 0 unless a listed one has no gap to speak of. Where a mesh
// welds (CollisionRules::weld) and copies part in this motion, the step is 0 and `vertex` one of them. Throws as
// safe_distances.
//
// gap_share in [0, 1): every pair, listed or not, keeps this share of its gap at x_t0 (of d_hat, where it is not listed), as in
// LineSearch, so that the next step is > 0.
ONSET_API StepResult compute_cfl_stepsize(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                          const ClosePairs& close, const Options& options = {}, double gap_share = 0.2);

}  // namespace onset
