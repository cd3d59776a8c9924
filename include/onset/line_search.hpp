// One broad phase for a whole line search, and steps that leave the next one room to move.
#pragma once

#include <memory>
#include <onset/close_pairs.hpp>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>

namespace onset {

struct LineSearchStep {
  StepResult result;  // result.step: the largest safe step
  // The share of its gap that every pair is sure to keep, once positions are rounded to stored doubles: the one
  // asked for unless gap_share_reduced. A gap of less than 2 rounding / (1 - gap_share) may not keep it all: the share is
  // cut, and `closest` names the pair. assured: false where a gap has no room for rounding at all, so that the
  // step is 0 (Outcome::below_rounding); raise min_separation.
  double gap_share = 0;
  bool gap_share_reduced = false, assured = true;
  Pair closest;
  double rounding = 0;  // StepResult::rounding
};

// Holds the candidate pairs of x_t0 -> x_t0 + dx (paper, Algorithm 4). Const calls are safe from several
// threads. Memory: 8 bytes a pair that single precision could not certify as free of contact for the whole
// direction; with a d_hat, 8 more a pair that it could not certify as staying beyond d_hat, and 24 a vertex.
class ONSET_API LineSearch {
 public:
  // dx: #V x 3 (or flat), model length: x_t1 = x_t0 + dx is formed here. Throws as
  // compute_collision_free_stepsize.
  //
  // gap_share in [0, 1): every pair keeps at least this share of its gap at x_t0 (its distance less its
  // separation), or all but what is beyond the larger of d_hat and the tolerance, so that steps along one
  // direction approach a contact as a sequence t_i < t_i+1 and never reach it, and from every result the next
  // step is > 0 (paper, section 7.2: d = p d_i, with p = gap_share).
  //
  // d_hat > 0 (model length): close_pairs can be asked for; 0: it cannot, and nothing is held for it.
  LineSearch(const Mesh& mesh, const Positions& x_t0, const Positions& dx, const Options& options = {},
             double gap_share = 0.2, double d_hat = 0);
  ~LineSearch();
  LineSearch(LineSearch&&) noexcept;
  LineSearch& operator=(LineSearch&&) noexcept;

  // The largest step in [0, upper] that is free of contact, in exact motion and once rounded to stored
  // doubles. StepResult::toi is infinite where there is no contact up to `upper`.
  LineSearchStep largest_step(double upper = 1) const;

  // Every pair whose exact distance at x_t0 + step dx, step in [0, 1], is below d_hat plus its separation,
  // both in exact arithmetic and as any order of rounding stores it; a pair beyond by no more than twice
  // LineSearchStep::rounding may be listed as well. Weights and distances are those of the stored
  // x_t0(v, a) + step * dx(v, a). A step that largest_step did not allow may be asked about too.
  ClosePairs close_pairs(double step) const;

  // Pairs held for largest_step and for close_pairs.
  PairCounts candidates() const;
  PairCounts close_candidates() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onset
