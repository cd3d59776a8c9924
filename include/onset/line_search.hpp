// One broad phase for a whole line search, and steps that leave the next one room to move.
#pragma once

#include <memory>
#include <onset/close_pairs.hpp>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <onset/step_size.hpp>
#include <optional>

namespace onset {

class PartOfLineSearch;  // src/part/part_of_line_search.hpp

struct LineSearchOptions : Options {
  LineSearchOptions() = default;
  // NOLINTNEXTLINE: implicit by design, for who needs no more.
  LineSearchOptions(const Options& options) : Options(options) {}

  // In [0, 1): every pair keeps at least this share of its gap at x_t0 (its distance less its separation), or
  // all but what is beyond the larger of d_hat and the tolerance, so that steps along one direction approach
  // a contact as a sequence t_i < t_i+1 and never reach it. From every result the next step is > 0 as long as
  // every gap is more than twice StepResult::rounding: a solver that pushes on below that, against no
  // barrier, takes ever smaller steps and then none.
  double gap_share = 0.2;
  // Model length, >= 0. > 0: close_pairs can be asked for; 0: it cannot, and nothing is held for it.
  double d_hat = 0;
};

// `step` is the largest safe one.
struct LineSearchStep : StepResult {
  // The share of its gap that every pair is sure to keep, or all but what LineSearchOptions::gap_share says,
  // once positions are rounded to stored doubles: the one asked for unless gap_share_reduced. A gap of less
  // than 2 rounding / (1 - gap_share) may not keep it all: the share is cut, and `closest` names the pair.
  double gap_share = 0;
  bool gap_share_reduced = false;
  // About this step: false where a gap has no room for rounding at all, so that the step is 0
  // (Outcome::below_rounding); raise min_separation.
  bool assured = true;
  std::optional<Pair> closest;
};

// Answers all questions of a line search along one direction from one broad phase, whose candidates it holds.
//
// Guarantee: as compute_collision_free_stepsize, for every step size asked.
// Memory: 8 bytes a pair that single precision could not certify as free of contact for the whole direction;
// with a d_hat, 8 more a pair that it could not certify as staying beyond d_hat, and 24 a vertex.
// Planes are looked at anew for each step, and nothing is held for them.
// Const calls are safe from several threads.
//
// Source: Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, "A Large-Scale Benchmark and an Inclusion-Based
// Algorithm for Continuous Collision Detection", ACM Transactions on Graphics 40(5), 2021, section 7.2 and
// Algorithm 4: d = p d_i, with p = gap_share. d_hat: Li et al. 2020 (onset/close_pairs.hpp).
class ONSET_API LineSearch {
 public:
  // Holds nothing: its calls throw std::logic_error.
  LineSearch() noexcept;
  // x_t0, dx: #V x 3 (or flat), model length; x_t1 = x_t0 + dx is formed here.
  // The budgets and progress of the options (time_limit and so on) are those of one call: of this
  // constructor, and again of each later call. Where they end the constructor it does not throw; the line
  // search then holds no pairs, and largest_step and close_pairs return that outcome at once (a step of 0, no
  // pairs), as they do for positions that are not finite. Where memory_limit leaves no room for the pairs it
  // is no outcome of the constructor: each call finds them again; what rest_positions needs must fit. Throws
  // as compute_collision_free_stepsize, and std::invalid_argument for gap_share or d_hat out of range.
  LineSearch(const Mesh& mesh, const Positions& x_t0, const Positions& dx,
             const LineSearchOptions& options = {});
  ~LineSearch();
  LineSearch(LineSearch&&) noexcept;
  LineSearch& operator=(LineSearch&&) noexcept;

  // Computes the largest step in [0, upper] that is free of contact, in exact motion and once rounded to
  // stored doubles. StepResult::toi is infinite where there is no contact up to `upper`.
  // upper: in [0, 1], else throws std::invalid_argument.
  LineSearchStep largest_step(double upper = 1) const;

  // Finds every pair whose distance at x_t0 + step dx is below d_hat plus its separation, in exact arithmetic
  // or as any of the orders of operations that docs/steps.md names stores it; a pair beyond by no more than
  // twice StepResult::rounding may be listed as well. Weights and distances are those of the stored
  // x_t0(v, a) + step * dx(v, a).
  // step: in [0, 1], also one that largest_step did not allow.
  // Throws std::invalid_argument for another step, and where there is no d_hat.
  ClosePairs close_pairs(double step) const;

  // Pairs held for largest_step and for close_pairs.
  PairCounts candidates() const;
  PairCounts close_candidates() const;

 private:
  friend class PartOfLineSearch;
  struct Impl;
  const Impl& impl() const;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onset
