// One pair that is not certified free: is it a contact, when, and how far does it let a step go?
#pragma once

#include <optional>

#include "narrowphase/corners.hpp"
#include "narrowphase/exact/exact.hpp"
#include "narrowphase/initial.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "narrowphase/vec.hpp"

namespace onset {

// Share of the tolerance: to look so sharply costs about one check more, and tells most pairs that pass
// within the tolerance from contacts.
constexpr double kSharpness = 0.0625;
// Share of the pair's size that is given away at most: hand-made near misses have gaps of 1e-11 of it.
constexpr double kSharpest = 0x1p-38;

// 16 E7, of rho: advancement tells no less (docs/theory.md, (9.2)).
constexpr double kLeastTolerance = 116 * 0x1p-53;

// Of rho: a certificate of a start sees no smaller gap.
constexpr double kStartNoise = 16 * 0x1p-53;

// Returns the same pairs, asked of the exact motion only.
KernelPairs without_storing(KernelPairs pairs, double t_max);

// Row `row` of a batch of one kind.
struct PairQuestion {
  const NarrowPhaseInput& in;
  const KernelsOfKind& kernels;
  const KernelPairs& pairs;
  int row;
  PairKind kind;
  IdPair pair;
};

class PairDecision {
 public:
  PairDecision(const PairQuestion& question, NarrowPhaseStats& stats)
      : in_(question.in),
        kernels_(question.kernels),
        pairs_(question.pairs),
        row_(question.row),
        kind_(question.kind),
        pair_(question.pair),
        stats_(stats) {}

  // Finds the contact of the exact motion. Advancement left the pair as `checked`, apart or parting until
  // `from`. The stages, each of which may end it, are exact first, push on, search, prove, report
  // (docs/architecture.md, "A pair's way").
  std::optional<PairResult> contact(const KernelResult& checked, double from = 0);

  // Finds how far the pair lets a stored step go, and the contact of its exact motion.
  std::optional<PairResult> stored_step(const KernelResult& checked);

  // Gives a contact found at Exactness::exact its exact time: adjacent doubles toi and toi_hi.
  void sharpen(PairResult& result) const;

 private:
  // The scaled distance is in [lower, upper]; along w, of length 1, all corners are beyond about `lower`.
  struct Bounds {
    double lower, upper;
    Vec w;
  };

  // Asks the same of the same row of another batch.
  PairDecision of(const KernelPairs& pairs) const {
    return PairDecision({in_, kernels_, pairs, row_, kind_, pair_}, stats_);
  }
  const int (&vertices() const)[4] { return pairs_.vertices[row_]; }
  double separation() const { return pairs_.separation[row_]; }  // model length
  const Corners& corners() const;
  double distance_at(double t) const;  // scaled upper bound
  void advance(const KernelResume* resume, KernelResult& result) const;

  KernelResult push_on(KernelResult r) const;
  KernelResult search(KernelResult found);
  // Pushes on and searches. `searched`: the inclusion root finder bounds the distance.
  KernelResult carry_on(const KernelResult& checked, bool& searched);
  PairResult report(KernelResult found, const ExactAnswer& exact, double from, bool searched) const;
  PairResult contact_at_start(const Bounds& start, const KernelResult& found, const ExactAnswer& exact);
  void add_contact_after_parting(const KernelResult& found, const Parting& parting, PairResult& r);

  // Exact arithmetic (decide_exactly.cpp).
  bool uses_exact() const;  // whether it is asked at all
  bool decides_completely() const;
  ExactPair exact_pair_of_this() const;
  ExactAnswer decide_exactly(const KernelResult& found, double from) const;
  bool touches_at_start() const;
  bool seen_within_separation(const KernelResult& found) const;
  double distance_before_touching(const DoubleBracket& time) const;  // scaled, at time.lo

  // The start (pair_start.cpp).
  bool is_welded() const;
  Bounds bounds_at(double t) const;
  Parting find_parting_of(const Bounds& start, double separation, bool touching) const;
  KernelResult advance_from(const Bounds& at, double t, double kept) const;

  // Steps that are stored (stored_step.cpp).
  struct StoredLimit;
  double storing_rounding() const;  // scaled
  std::optional<PairResult> from_scratch();
  std::optional<PairResult> exact_motion();
  StoredLimit limit_from_start(std::optional<PairResult>& contact);
  StoredLimit limit_of_small_gap(const std::optional<PairResult>& contact);
  StoredLimit limit_after_parting(const Bounds& start);
  KernelResult limit_from(const Bounds& at, double t, double kept);
  double clear_time(double wanted) const;
  void note_kept(double share);

  const NarrowPhaseInput& in_;
  const KernelsOfKind& kernels_;
  const KernelPairs& pairs_;
  const int row_;
  const PairKind kind_;
  const IdPair pair_;
  NarrowPhaseStats& stats_;
  mutable std::optional<Corners> corners_;
};

}  // namespace onset
