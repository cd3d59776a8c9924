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

// All rest on one lemma (docs/theory.md, L49): while every vertex stays within r_i of where it was, on any
// path, the distance of a pair falls by at most the largest r_i of the one primitive plus that of the other.

// Computes r_i for every vertex, how far it may move before a check is due (#V values, model length, >= 0).
//
// Guarantee: whatever path each vertex takes, no pair comes as close as its separation while |x_i(t) - x_i|
// <= r_i for all i, nor where x + s dx is stored in any of the orders of operations that docs/steps.md names.
// Half of the least gap of a vertex, or of d_hat, less what storing can change; 0 where a pair touches or has
// no gap beyond that. O(#V + pairs).
//
// x: #V x 3, model length: the positions that `close` was made for.
// close: all close pairs of this mesh, with a d_hat > 0 and the outcome free. Copies of vertices that
// CollisionRules::weld counts as one are taken to stay together.
// Throws std::invalid_argument for a wrong number of rows or columns, another outcome or d_hat, and naming a
// pair that is not of this mesh.
// Safe to call concurrently on one Mesh.
//
// Source: docs/theory.md, L49.
ONSET_API std::vector<double> safe_distances(const Mesh& mesh, const Positions& x, const ClosePairs& close);

// Computes the largest s in [0, 1] with s |dx_i| <= r_i for all i, rounded down.
//
// Guarantee: by the lemma a step of s dx needs no collision check. What is left for the next step without one
// is r_i - s |dx_i|. 0 where dx is not finite, or an r is not a
// number >= 0.
//
// r: as safe_distances gives it, or what is left of it.
// dx: #V x 3, model length, as many rows as r has values, else throws std::invalid_argument.
// Safe to call concurrently.
ONSET_API double safe_step(const std::vector<double>& r, const Positions& dx);

// Computes a step that is free of contact from the close pairs alone, without a broad phase: O(#V + pairs).
//
// The listed pairs are checked for collisions. All others are more than d_hat + separation apart, so that by
// the lemma they stay beyond the separation for s < d_hat / (2 max |dx|), a bound of the
// Courant-Friedrichs-Lewy kind.
//
// Guarantee: no contact of the whole mesh on [0, step], along the exact motion and as stored (StepResult),
// and toi no later than the first one. Outcome `free` with step < 1: the bound ended it, not a pair. Where a
// budget of `options` is spent, the step is that of safe_distances, which looks at no pair: > 0 unless a
// listed one has no gap to speak of. Where copies that a mesh welds (CollisionRules::weld) part in this
// motion, the step is 0 (initial_contact) and `vertex` is one of them.
//
// x_t0, x_t1: #V x 3, model length, the two ends of a linear motion.
// close: all close pairs of this mesh at x_t0, made with the same options.
// gap_share: in [0, 1). Every pair keeps this share of its gap at x_t0 (of d_hat, where it is not listed), as
// in LineSearch, so that the next step is > 0 while gaps are more than twice StepResult::rounding.
// Throws as safe_distances, and std::invalid_argument for options or gap_share out of range, or a static
// vertex that moves.
// Safe to call concurrently on one Mesh.
//
// Source: Courant, Friedrichs, Lewy, "Ueber die partiellen Differenzengleichungen der mathematischen Physik",
// Mathematische Annalen 100, 1928, for the kind of bound; docs/theory.md, L49.
ONSET_API StepResult compute_cfl_stepsize(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                          const ClosePairs& close, const Options& options = {},
                                          double gap_share = 0.2);

}  // namespace onset
