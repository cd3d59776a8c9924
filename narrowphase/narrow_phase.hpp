// Candidate pairs in, time of impact out: culls, advancement, and the inclusion root finder for what they
// leave undecided.
#pragma once

#include <array>
#include <vector>

#include "base/motion.hpp"
#include "base/pair_sink.hpp"
#include "narrowphase/corners.hpp"
#include "narrowphase/exact.hpp"
#include "narrowphase/float_positions.hpp"
#include "narrowphase/kernel.hpp"
#include "onset/options.hpp"

namespace onset {

struct NarrowPhaseInput {
  const MeshData& mesh;
  const Motion& motion;
  double tolerance;  // model length, > 0
  double extent;     // the largest corner difference in the scene, about
  const Options& options;
  double keep =
      0;  // share of each pair's initial gap beyond its separation that it must keep as well, in [0, 1)
  double rounding = 0;       // model length: kept too, up to half of what that share leaves
  bool exact_times = false;  // CertaintyLevel::exact: toi and toi_hi of every contact are adjacent doubles
  bool for_many = false;     // pairs: worth a pass over all vertices first
};

// A pair that is not certified free.
struct PairResult {
  IdPair pair;
  double toi;         // certified apart on [0, toi) (initial outcomes: 0)
  double step_limit;  // how far this pair lets a step go: toi; for initial_separating the next contact, 1 if
                      // none
  double tolerance;   // distance beyond the separation at which it was reported, model length
  Outcome outcome;
  Certainty certainty = Certainty::within_tolerance;
  double toi_hi = INFINITY;                                 // where certain: touches by then
  Certainty limit_certainty = Certainty::within_tolerance;  // of the contact at step_limit
};

struct NarrowPhaseStats {
  std::int64_t candidates = 0, after_culls = 0, inclusion = 0, contacts = 0, budget = 0, checks = 0,
               most_checks = 0;
  IdPair worst{-1, -1};                      // the first pair with most_checks
  std::array<std::int64_t, 16> histogram{};  // of checks: Stats::checks_histogram
  double achieved_tolerance = 0;
  // The least share of its gap, net of `rounding`, that a reported pair is sure to keep, and the pair; < 0:
  // not even its separation. 1 where all keep what was asked for.
  double least_kept = 1;
  IdPair closest{-1, -1};
  void add(const NarrowPhaseStats& other);
  void note_checks(IdPair pair, std::int64_t checks);  // >= 1
  void note_outcome(const PairResult& result);         // budget, achieved_tolerance
};

// What one thread keeps between batches.
struct NarrowPhaseScratch {
  std::vector<int> vertices, survivors;  // 4 ids a pair
  std::vector<double> separation;
  std::vector<KernelResult> results;
  NarrowPhaseStats stats;
};

class NarrowPhase {
 public:
  explicit NarrowPhase(const NarrowPhaseInput& input);
  // Appends the pairs of the batch that are not free (in the batch's order); how many of these are contacts,
  // and their outcomes, is for the caller to count: it may drop some. Pairs certified apart beyond `horizon`
  // may be left out; the rest have the same results for any horizon.
  void process(PairKind kind, const IdPair* pairs, std::size_t count, double horizon,
               NarrowPhaseScratch& scratch, std::vector<PairResult>& out) const;
  // Appends the pairs of the batch that the culls cannot certify as free.
  void cull(PairKind kind, const IdPair* pairs, std::size_t count, NarrowPhaseScratch& scratch,
            std::vector<IdPair>& out) const;
  bool uses_horizon() const;
  bool times_are_exact() const { return in_.exact_times && settles_completely(); }
  // Gives a contact of this pair, found at CertaintyLevel::exact, its exact time: adjacent doubles toi and
  // toi_hi.
  void sharpen(PairKind kind, PairResult& result) const;
  const char* kernel_name() const { return kernels_->name; }

 private:
  struct Case {  // one pair of a batch
    PairKind kind;
    IdPair pair;
    const KernelPairs& input;
    int row;
  };

  KernelPairs prepare(PairKind kind, const IdPair* pairs, std::size_t count, double horizon,
                      NarrowPhaseScratch& scratch) const;
  int cull(PairKind kind, const KernelPairs& input, NarrowPhaseScratch& scratch) const;
  void note_kept(const Case& c, const KernelResult& found, NarrowPhaseStats& stats) const;
  void look_up(PairKind kind, const IdPair* pairs, std::size_t count, NarrowPhaseScratch& scratch) const;
  Corners corners_of(const Case& c) const;
  double distance_at(const Case& c, double t) const;  // scaled upper bound
  KernelResult push_on(const Case& c, const Corners& corners, KernelResult r) const;
  bool settles() const;  // whether exact arithmetic is asked at all
  bool settles_completely() const;
  ExactPair exact_pair(PairKind kind, const int (&vertices)[4]) const;
  ExactAnswer settle(const Case& c, const KernelResult& found, double from) const;
  bool seen_within_separation(const Case& c, const KernelResult& found) const;
  // The pair is apart, or parting, until `from`.
  void finish(const Case& c, const KernelResult& checked, double from, NarrowPhaseStats& stats,
              std::vector<PairResult>& out) const;
  void finish_initial(const Case& c, const Corners& corners, const KernelResult& found,
                      const ExactAnswer& truth, NarrowPhaseStats& stats, std::vector<PairResult>& out) const;

  NarrowPhaseInput in_;
  const KernelTable* kernels_;
  double scale_;
  AlignedArray<float> rounded_;  // for_many: the motion in single precision
};

std::array<int, 4> pair_vertices(const MeshData& mesh, PairKind kind, IdPair pair);

}  // namespace onset
