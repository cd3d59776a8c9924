// Candidate pairs in, times of impact out.
#pragma once

#include <array>
#include <vector>

#include "narrowphase/kernel/float_positions.hpp"
#include "narrowphase/kernel/kernel.hpp"
#include "onset/options.hpp"
#include "scene/motion/motion.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_sink.hpp"
#include "scene/pairs/separation.hpp"

namespace onset {

// Which pairs the exact motion is asked about, where steps look at more.
struct PairPredicate {
  const void* context;
  bool (*holds)(const void* context, PairKind kind, IdPair pair);
};

// How far the vertices stray from the motion. The separation of a pair is widened by the largest of each
// primitive, beside their thickness.
struct Straying {
  const std::vector<double>& thickness;  // in place of the mesh's; empty: none
  const std::vector<double>& bounds;     // of each vertex, model length
};

struct NarrowPhaseInput {
  const MeshData& mesh;
  const Motion& motion;
  double tolerance;  // model length, > 0
  double extent;     // about the largest corner in the scene
  const Options& options;
  // At Exactness::exact toi and toi_hi of every contact are adjacent doubles.
  bool exact_times = false;
  // There are enough pairs for a pass over all vertices first.
  bool for_many = false;
  // The step's end is stored: results have a stored_limit, and each pair keeps `gap_share`, in [0, 1), of its
  // initial gap. `rounding` is rounding_of_distances(motion).
  bool stored = false;
  double gap_share = 0, rounding = 0;
  // Other pairs have no toi; null: all may have one.
  const PairPredicate* contacts = nullptr;
  // What the shape at rest leaves of separations; null: all.
  const RestLimits* rest = nullptr;
  // null: vertices do not stray. Other rules than thickness have no separations then.
  const Straying* straying = nullptr;
  // Separations are Options::min_separation and thickness, whatever the bodies.
  bool ignores_bodies = false;

  bool times_are_exact() const { return exact_times && options.exactness == Exactness::exact; }
  bool inclusion_only() const { return options.narrow_phase == NarrowPhaseMethod::inclusion; }
};

// Returns how far beyond what it must keep a pair may be reported, model length, unless its checks are spent.
double reported_within(double tolerance, double extent);

// A pair that is not certified free.
struct PairResult {
  IdPair pair;
  // Certified apart on [0, toi); 0 for initial outcomes, infinite where only stored_limit is not.
  double toi;
  // How far it lets the exact motion go: toi, or for initial_separating the next contact, infinite if there
  // is none.
  double step_limit;
  // Distance beyond the separation at which it was reported, model length.
  double tolerance;
  PairOutcome outcome;
  Certainty certainty = Certainty::within_tolerance;
  // Where certain: the pair touches by then.
  double toi_hi = INFINITY;
  // The certainty of the contact at step_limit.
  Certainty limit_certainty = Certainty::within_tolerance;
  // A step whose end is stored may be 0, or anything in [clear_from, stored_limit].
  double stored_limit = INFINITY, clear_from = 0;
};

struct NarrowPhaseStats {
  std::int64_t candidates = 0, after_culls = 0, inclusion = 0, contacts = 0, gave_up = 0, checks = 0,
               most_checks = 0;
  IdPair worst{-1, -1};                      // the first pair with most_checks
  std::array<std::int64_t, 16> histogram{};  // of checks
  double achieved_tolerance = 0;
  // The least share of its gap that a pair is sure to keep once stored: 0 where its step is 0, 1 where all
  // keep what was asked for.
  double least_share = 1;
  IdPair closest{-1, -1};
  void add(const NarrowPhaseStats& other);
  void note_checks(IdPair pair, std::int64_t checks);  // >= 1
  void note_outcome(const PairResult& result);         // gave_up, achieved_tolerance
};

// What one thread keeps between batches.
struct NarrowPhaseScratch {
  std::vector<int> vertices, survivors;  // 4 ids a pair
  std::vector<double> separation;
  std::vector<KernelResult> results;
  // Where steps are stored: the rows that the exact motion is asked about, their places, and whether they
  // touch.
  std::vector<KernelResult> exact_results;
  std::vector<int> asked, places;
  std::vector<char> touches;
  NarrowPhaseStats stats;
};

class NarrowPhase {
 public:
  explicit NarrowPhase(const NarrowPhaseInput& input);

  // Pairs certified apart beyond these may be left out; no other result depends on them.
  struct TMax {
    double culls = 1, advancement = 1;
  };
  // Appends the pairs that are not free, in the batch's order; callers count contacts, as they may drop some.
  void process(PairKind kind, const IdPair* pairs, std::size_t count, TMax t_max, NarrowPhaseScratch& scratch,
               std::vector<PairResult>& out) const;
  // Appends the pairs that the culls leave.
  void cull(PairKind kind, const IdPair* pairs, std::size_t count, NarrowPhaseScratch& scratch,
            std::vector<IdPair>& out) const;
  bool uses_t_max() const;
  // Gives a contact found at Exactness::exact its exact time: adjacent doubles toi and toi_hi.
  void sharpen(PairKind kind, PairResult& result) const;
  bool times_are_exact() const { return in_.times_are_exact(); }
  const char* to_string() const { return kernels_->name; }

 private:
  KernelPairs prepare(PairKind kind, const IdPair* pairs, std::size_t count, TMax t_max,
                      NarrowPhaseScratch& scratch) const;
  int cull(PairKind kind, const KernelPairs& input, NarrowPhaseScratch& scratch) const;
  void advance_exactly(PairKind kind, const KernelPairs& input, int survivors,
                       NarrowPhaseScratch& scratch) const;
  void gather(PairKind kind, const IdPair* pairs, std::size_t count, NarrowPhaseScratch& scratch) const;
  void gather_separations(PairKind kind, const IdPair* pairs, std::size_t count,
                          NarrowPhaseScratch& scratch) const;

  NarrowPhaseInput in_;
  const KernelTable* kernels_;
  double scale_;
  AlignedArray<float> rounded_;  // for_many: the motion in single precision
};

}  // namespace onset
