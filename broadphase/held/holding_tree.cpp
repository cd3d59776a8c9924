#include "broadphase/held/holding_tree.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "broadphase/bvh/bvh.hpp"
#include "broadphase/held/held_candidates.hpp"

namespace onset {
namespace {

// How much more than positions changed by a call boxes are widened: so many calls may follow like it.
constexpr double kSlackOfChange = 2;
// Beyond this share of the usual edge more pairs are held than holding spares.
constexpr double kMostSlack = 0.05;
// Held pairs beyond this many a candidate cost more to test than a tree to traverse.
constexpr std::size_t kMostHeldACandidate = 4, kFew = 4096;
// Of what passes the boxes, diagonals leave about one in so many.
constexpr std::size_t kBoxesACandidate = 3;
// Pairs are put to diagonals before they are held if the last so many calls all asked for them: steps do
// not, and the calls of a loop that asks for both are served by one list.
constexpr int kCallsAlike = 4;
// After pairs were held that served no call, so many times as many calls pass before pairs are held again.
constexpr int kLongestPause = 64;
constexpr int kMostServed = 1 << 20;  // counted

// A median of some edges, in the maximum norm, at the start.
double usual_edge(const BroadPhaseInput& input) {
  constexpr std::size_t kSamples = 256;
  const auto& edges = input.mesh.edges;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < edges.size(); i += std::max<std::size_t>(1, edges.size() / kSamples)) {
    const double *x = input.motion.t0(edges[i][0]), *y = input.motion.t0(edges[i][1]);
    sizes.push_back(std::max({std::fabs(x[0] - y[0]), std::fabs(x[1] - y[1]), std::fabs(x[2] - y[2])}));
  }
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

class HoldingTree final : public BroadPhase {
 public:
  HoldingTree(const BroadPhaseInput& input, const Stop& stop) : tree_(make_bvh(input, stop)) {
    ready_ = tree_->ready();
    made_static_ = tree_->made_static_boxes();
    count_alike(input);
    if (ready_) note_plain(input);
  }

  const char* name() const override { return uses_held_ ? "held" : tree_->name(); }
  bool made_static_boxes() const override { return made_static_; }
  bool suits(const Motion& motion) const override { return tree_->suits(motion); }

  void refit(const BroadPhaseInput& input, const Stop& stop) override {
    ready_ = uses_held_ = made_static_ = false;
    whole_ = input.t_max == 1;
    count_alike(input);
    double magnitude = 0;
    const double moved = eligible(input) ? positions_.moved(input, magnitude) : INFINITY;
    if (held_.cover(input, moved, magnitude)) {
      if (input.t_max == 1) served_ = std::min(served_ + 1, kMostServed);
      return use_held(input, magnitude, stop);
    }
    if (input.t_max != 1) {  // of the call before
      ended_early_ = true;
      refit_tree(input, stop);
      ready_ = tree_->ready();
      return;
    }
    if (!held_.empty()) note_service();
    if (pays(input, moved, magnitude) && hold(input, moved, magnitude, stop))
      return use_held(input, magnitude, stop);
    if (stop.requested()) return;
    refit_tree(input, stop);
    ready_ = tree_->ready();
    if (ready_) note_plain(input);
  }

  std::size_t blocks(PairKind kind) const override {
    if (!ready_) return 0;
    return uses_held_ ? held_.blocks(kind) : tree_->blocks(kind);
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    if (uses_held_) return held_.traverse(kind, first, last, sink);
    if (!whole_) return tree_->traverse(kind, first, last, sink);
    struct Counting {
      const PairSink& sink;
      std::size_t count;
      static void consume(void* context, const IdPair* pairs, std::size_t n) {
        auto& c = *static_cast<Counting*>(context);
        c.count += n;
        c.sink(pairs, n);
      }
    } counting{sink, 0};
    tree_->traverse(kind, first, last, {&counting, &Counting::consume, sink.stop});
    seen_pairs_.fetch_add(counting.count, std::memory_order_relaxed);
    seen_blocks_.fetch_add(last - first, std::memory_order_relaxed);
  }

 private:
  static bool eligible(const BroadPhaseInput& input) {
    return input.motion.status == Outcome::free && input.test != BoxTest::swept && !input.intersections &&
           input.mesh.thickness.empty() && input.most_held > 0;
  }

  void count_alike(const BroadPhaseInput& input) {
    if (!input.diagonals.used)
      calls_alike_ = 0;
    else if (input.t_max == 1)
      calls_alike_ = std::min(calls_alike_ + 1, kCallsAlike);
  }

  // Later calls are compared with the positions of this one.
  void note_plain(const BroadPhaseInput& input) {
    held_.clear();
    served_ = 0;
    seen_pairs_ = seen_blocks_ = 0;
    positions_ = eligible(input) ? HeldPositions(input) : HeldPositions();
    if (input.looks == Looks::at_earliest) ended_early_ = false;
  }

  // What was held is of no more use.
  void note_service() {
    pause_length_ = served_ > 1 ? 1 : std::min(2 * pause_length_, kLongestPause);
    pause_ = served_ > 1 ? 0 : pause_length_;
  }

  double slack(const BroadPhaseInput& input, double moved, double magnitude) const {
    return std::max(kSlackOfChange * moved / (served_ + 1),
                    2 * HeldCandidates::least_slack(input, magnitude));
  }

  bool pays(const BroadPhaseInput& input, double moved, double magnitude) {
    if (!(moved < INFINITY) || input.looks == Looks::at_any) return false;
    if (pause_ > 0) return --pause_, false;
    if (input.looks == Looks::at_earliest && ended_early_) return false;
    return slack(input, moved, magnitude) <= kMostSlack * usual_edge(input);
  }

  // Holds the pairs of this call for those that follow.
  bool hold(const BroadPhaseInput& input, double moved, double magnitude, const Stop& stop) {
    BroadPhaseInput wide = input;
    const double by = slack(input, moved, magnitude);
    wide.inflation += by, wide.diagonals.margin += by;
    wide.diagonals.used = input.diagonals.used && calls_alike_ == kCallsAlike;
    refit_tree(wide, stop);
    if (!tree_->ready()) return false;
    std::size_t most = input.most_held;
    if (seen_blocks_ > 0) {
      std::size_t blocks = 0;
      for (const PairKind kind : wanted_kinds(input)) blocks += tree_->blocks(kind);
      const bool leaves_them = input.diagonals.used && !wide.diagonals.used;
      const double passed = double(seen_pairs_) * (leaves_them ? double(kBoxesACandidate) : 1);
      const double seen = passed / double(seen_blocks_) * double(blocks);
      most = std::min(most, std::size_t(kMostHeldACandidate * seen) + kFew);
    }
    HeldPositions from(input);
    if (!held_.take(*tree_, wide, most, stop)) {
      pause_ = pause_length_ = std::min(2 * pause_length_, kLongestPause);
      return false;
    }
    positions_ = std::move(from);
    served_ = 0;
    if (input.looks == Looks::at_earliest) ended_early_ = false;
    return true;
  }

  void use_held(const BroadPhaseInput& input, double magnitude, const Stop& stop) {
    held_.fit(input, magnitude, stop);
    uses_held_ = ready_ = !stop.requested();
  }
  void refit_tree(const BroadPhaseInput& input, const Stop& stop) {
    tree_->refit(input, stop);
    made_static_ |= tree_->made_static_boxes();
  }

  std::unique_ptr<BroadPhase> tree_;
  HeldCandidates held_;
  HeldPositions positions_;  // of the call that held pairs, or of the last one
  bool uses_held_ = false, made_static_ = false;
  bool whole_ = true;         // whether the boxes are those of the whole step
  bool ended_early_ = false;  // whether the last call that looked at the earliest contact made its boxes anew
  int calls_alike_ = kCallsAlike;  // in a row, that put pairs to diagonals
  int served_ = 0;                 // calls by what is held
  int pause_ = 0, pause_length_ = 1;
  mutable std::atomic<std::size_t> seen_pairs_{0}, seen_blocks_{0};
};

}  // namespace

std::unique_ptr<BroadPhase> make_holding_tree(const BroadPhaseInput& input, const Stop& stop) {
  std::unique_ptr<BroadPhase> made = std::make_unique<HoldingTree>(input, stop);
  if (!made->ready()) made.reset();
  return made;
}

}  // namespace onset
