#include "src/shared/pair_traversal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/assert.hpp"
#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "broadphase/motion_box.hpp"
#include "scene/pair_source.hpp"

namespace onset {
namespace {

// Few where a scene is small, so that many threads can share it.
constexpr std::size_t kLeastBlocksATask = 4, kMostBlocksATask = 16, kTasks = 256;
std::size_t blocks_a_task(std::size_t blocks) {
  return std::clamp(blocks / kTasks, kLeastBlocksATask, kMostBlocksATask);
}

// With a budget of checks, work comes in waves of so many blocks. What a wave does depends only on those
// before it, so that it is the same for any number of threads.
constexpr std::size_t kFirstWave = 16, kLargestWave = 1024;
// A single pair passes between two looks at a budget where kWatchedPairs took longer than this.
constexpr double kSlowSeconds = 0.002;
// Where all are kept, a task hands over its results when it holds so many.
constexpr std::size_t kHeldByATask = 1024;

class PairTraversal {
 public:
  PairTraversal(const PairSource& pairs, const NarrowPhase& narrow, Collect collect, double t_max,
                Budget& budget, std::size_t stride, const TraversalBounds& bounds)
      : pairs_(pairs),
        narrow_(narrow),
        collect_(collect),
        budget_(budget),
        stride_(stride),
        bounds_(bounds),
        first_t_max_(t_max),
        t_max_(t_max),
        wave_t_max_(t_max),
        found_(bounds.most) {
    std::size_t blocks = 0;
    for (const PairKind kind : kStepKinds) blocks += count(kind);
    budget.begin_traversal(blocks);
  }

  void run(TraversalResult& result) {
    if (!budget_.counts_checks()) return run_all(result);
    for (const PairKind kind : kStepKinds) run_in_waves(kind, result.of(kind));
  }

  std::vector<FoundPair> take() { return found_.take(budget_); }
  const Limits& limits() const { return limits_; }

 private:
  // In one loop, so that no thread waits for the last of a kind.
  void run_all(TraversalResult& result) {
    std::size_t blocks = 0;
    for (const PairKind kind : kStepKinds) blocks += count(kind);
    const std::size_t each = stride_ == 1 ? blocks_a_task(blocks) : 1;  // a sample has few blocks
    parallel_ranges(blocks, each, [&](std::size_t first, std::size_t last) {
      std::size_t begin = 0;  // of a kind
      for (const PairKind kind : kStepKinds) {
        const std::size_t end = begin + count(kind);
        const std::size_t from = std::max(first, begin), to = std::min(last, end);
        if (from < to) run_task(kind, from - begin, to - begin, result.of(kind));
        begin = end;
      }
    });
  }

  void run_in_waves(PairKind kind, NarrowPhaseStats& stats) {
    const std::size_t blocks = count(kind);
    for (std::size_t first = 0, wave = kFirstWave; first < blocks;) {
      budget_.look_at_checks();
      if (const auto latest = found_.keep_earliest(budget_.stop())) shrink_to(*latest);
      wave_t_max_ = t_max_.load(std::memory_order_relaxed);
      const std::size_t last = std::min(first + wave, blocks);
      const std::int64_t before = stats.checks;
      parallel_ranges(last - first, kMostBlocksATask, [&](std::size_t from, std::size_t to) {
        run_task(kind, first + from, first + to, stats);
      });
      budget_.add_checks(stats.checks - before);
      first = last;
      wave = std::min(2 * wave, kLargestWave);
    }
  }

  struct Task {
    PairTraversal& traversal;
    PairKind kind;
    NarrowPhaseStats& stats;  // of the whole traversal
    NarrowPhaseScratch scratch;
    std::vector<PairResult> results;  // where all are kept
    Limits limits;

    static bool asked(void* context) { return static_cast<Task*>(context)->traversal.ended(); }
    static void consume(void* context, const IdPair* pairs, std::size_t count) {
      auto& task = *static_cast<Task*>(context);
      if (task.traversal.budget_.is_watched())
        task.process_slowly(pairs, count);
      else if (!task.traversal.ended())
        task.process(pairs, count);
    }
    PairSink sink() {
      const bool asks = traversal.budget_.is_watched() || traversal.collect_ == Collect::any;
      return {this, &Task::consume, asks ? Stop{this, &Task::asked} : Stop{}};
    }
    void process_slowly(const IdPair* pairs, std::size_t count) {
      for (std::size_t i = 0, next; i < count && !traversal.ended(); i = next) {
        const bool slow = traversal.slow_.load(std::memory_order_relaxed);
        next = std::min(i + (slow ? 1 : kWatchedPairs), count);
        const Clock clock;
        process(pairs + i, next - i);
        const bool now = clock.seconds() * double(slow ? kWatchedPairs : 1) > kSlowSeconds;
        if (now != slow) traversal.slow_.store(now, std::memory_order_relaxed);
      }
    }
    void process(const IdPair* pairs, std::size_t count) {
      ONSET_ASSERT(count <= kBatchSize);
      const std::size_t known = results.size();
      traversal.narrow_.process(kind, pairs, count, {traversal.first_t_max_, traversal.t_max()}, scratch,
                                results);
      keep_wanted(known);
      if (results.size() == known) return;
      scratch.stats.contacts += std::int64_t(results.size() - known);
      for (std::size_t i = known; i < results.size(); ++i) scratch.stats.note_outcome(results[i]);
      if (traversal.collect_ == Collect::all)
        traversal.shrink_to_window(results, known);
      else
        traversal.take_limits(*this);
      if (results.size() >= kHeldByATask) traversal.merge(*this);
    }
    void keep_wanted(std::size_t first) {
      const BroadPhaseInput* whole = traversal.bounds_.whole;
      const PairPredicate* only = traversal.bounds_.only;
      if (whole == nullptr && only == nullptr) return;
      const auto is_other = [&](const PairResult& r) {
        return (only != nullptr && !only->holds(only->context, kind, r.pair)) ||
               (whole != nullptr && !is_candidate(*whole, kind, r.pair));
      };
      results.erase(std::remove_if(results.begin() + std::ptrdiff_t(first), results.end(), is_other),
                    results.end());
    }
  };

  std::size_t count(PairKind kind) const { return (pairs_.blocks(kind) + stride_ - 1) / stride_; }

  // Traverses every stride-th block.
  void run_task(PairKind kind, std::size_t first, std::size_t last, NarrowPhaseStats& stats) {
    if (ended()) return;
    Task task{*this, kind, stats, {}, {}, {}};
    if (stride_ == 1)
      pairs_.traverse(kind, first, last, task.sink());
    else
      for (std::size_t i = first; i < last; ++i)
        pairs_.traverse(kind, i * stride_, i * stride_ + 1, task.sink());
    merge(task);
    if (budget_.outcome() == Outcome::free) budget_.advance(last - first);
  }

  bool ended() const {
    return budget_.spent() || (collect_ == Collect::any && found_any_.load(std::memory_order_relaxed));
  }
  double t_max() const {
    return budget_.counts_checks() ? wave_t_max_ : t_max_.load(std::memory_order_relaxed);
  }
  // Results do not depend on how soon t_max falls: it only lets pairs be dropped early.
  void shrink_to(double limit) {
    ONSET_ASSERT(limit >= 0);
    double now = t_max_.load(std::memory_order_relaxed);
    while (limit < now && !t_max_.compare_exchange_weak(now, limit, std::memory_order_relaxed)) {
    }
  }
  void shrink_to_window(const std::vector<PairResult>& results, std::size_t first) {
    for (std::size_t i = first; i < results.size(); ++i) shrink_to(latest_time(results[i]) + bounds_.window);
  }

  void take_limits(Task& task) {
    for (const PairResult& r : task.results) task.limits.add({task.kind, r});
    task.results.clear();
    if (!task.limits.contact) return;
    shrink_to(task.limits.contact->result.step_limit);
    found_any_.store(true, std::memory_order_relaxed);
  }

  // Hands over the results and statistics of a task.
  void merge(Task& task) {
    FoundPairs all(bounds_.most);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      task.stats.add(task.scratch.stats);
      limits_.add(task.limits);
      found_.add(task.kind, std::move(task.results));
      if (found_.too_many() && !dropping_) dropping_ = true, std::swap(all, found_);
    }
    task.scratch.stats = {}, task.limits = {}, task.results = {};
    if (all.too_many()) drop_latest(all);
  }
  // Keeps the earliest, while others add theirs. When that is depends on the order of work: with a budget of
  // checks, t_max falls between waves.
  void drop_latest(FoundPairs& all) {
    const auto latest = all.keep_earliest(budget_.stop());
    if (latest && !budget_.counts_checks()) shrink_to(*latest);
    const std::lock_guard<std::mutex> lock(mutex_);
    found_.add(std::move(all));
    dropping_ = false;
  }

  const PairSource& pairs_;
  const NarrowPhase& narrow_;
  const Collect collect_;
  Budget& budget_;
  const std::size_t stride_;
  const TraversalBounds bounds_;
  const double first_t_max_;
  std::atomic<double> t_max_;
  std::atomic<bool> found_any_{false};
  double wave_t_max_;
  std::atomic<bool> slow_{false};
  std::mutex mutex_;
  Limits limits_;     // unless all are kept
  FoundPairs found_;  // where all are kept
  bool dropping_ = false;
};

}  // namespace

bool limits_before(const FoundPair& x, const FoundPair& y) {
  return x.result.step_limit != y.result.step_limit ? x.result.step_limit < y.result.step_limit
                                                    : before(x, y);
}

namespace {

bool stored_before(const FoundPair& x, const FoundPair& y) {
  return x.result.stored_limit != y.result.stored_limit ? x.result.stored_limit < y.result.stored_limit
                                                        : limits_before(x, y);
}
bool clears_later(const FoundPair& x, const FoundPair& y) {
  return x.result.clear_from != y.result.clear_from ? x.result.clear_from > y.result.clear_from
                                                    : before(x, y);
}
template <class Before>
void keep_first(std::optional<FoundPair>& first, const FoundPair& other, Before&& comes_before) {
  if (!first || comes_before(other, *first)) first = other;
}

}  // namespace

void Limits::add(const FoundPair& f) {
  if (f.result.step_limit <= 1) keep_first(contact, f, limits_before);
  if (f.result.stored_limit <= 1) keep_first(stored, f, stored_before);
  if (f.result.clear_from > 0) keep_first(clear, f, clears_later);
}
void Limits::add(const Limits& other) {
  for (const std::optional<FoundPair>* f : {&other.contact, &other.stored, &other.clear})
    if (*f) add(**f);
}

TraversalResult traverse_pairs(const PairSource& pairs, const NarrowPhase& narrow, Collect collect,
                               double t_max, Budget& budget, std::size_t stride,
                               const TraversalBounds& bounds) {
  TraversalResult result;
  PairTraversal traversal(pairs, narrow, collect, t_max, budget, stride, bounds);
  traversal.run(result);
  if (collect == Collect::all)
    result.found = traversal.take();
  else
    result.limits = traversal.limits();
  return result;
}

NarrowPhaseInput stored_step_input(const MeshData& mesh, const Motion& motion, const Accuracy& accuracy,
                                   const Options& options, double gap_share, double rounding) {
  NarrowPhaseInput r{mesh, motion, accuracy.tolerance, accuracy.extent, options};
  r.stored = true;
  r.gap_share = gap_share;
  r.rounding = rounding;
  r.exact_times = options.exactness == Exactness::exact;
  return r;
}

void copy_counts(const TraversalResult& traversal, Stats& stats) {
  const auto each = [&](std::int64_t NarrowPhaseStats::*field) {
    return PairCounts{traversal.vertex_face.*field, traversal.edge_edge.*field, traversal.vertex_edge.*field,
                      0};
  };
  stats.candidates = each(&NarrowPhaseStats::candidates);
  stats.after_culls = each(&NarrowPhaseStats::after_culls);
  stats.inclusion = each(&NarrowPhaseStats::inclusion);
  stats.contacts = each(&NarrowPhaseStats::contacts);
  stats.gave_up = each(&NarrowPhaseStats::gave_up);
  stats.checks = each(&NarrowPhaseStats::checks).total();
  stats.max_checks_of_a_pair = 0, stats.achieved_tolerance = 0, stats.checks_histogram.fill(0);
  for (const PairKind kind : kStepKinds) {
    const NarrowPhaseStats& here = traversal.of(kind);
    stats.max_checks_of_a_pair = std::max(stats.max_checks_of_a_pair, here.most_checks);
    stats.achieved_tolerance = std::max(stats.achieved_tolerance, here.achieved_tolerance);
    for (std::size_t k = 0; k < stats.checks_histogram.size(); ++k)
      stats.checks_histogram[k] += here.histogram[k];
  }
}

Pair to_pair(const Mesh& mesh, const FoundPair& f) {
  return {f.kind, f.result.pair.a, f.result.pair.b, pair_vertices(mesh.data(), f.kind, f.result.pair)};
}

void note_worst(const Mesh& mesh, const TraversalResult& traversal, Stats& stats) {
  PairKind kind = PairKind::vertex_face;
  for (const PairKind other : kStepKinds)
    if (traversal.of(other).most_checks > traversal.of(kind).most_checks) kind = other;
  const IdPair pair = traversal.of(kind).worst;
  if (pair.a >= 0) stats.worst = Pair{kind, pair.a, pair.b, pair_vertices(mesh.data(), kind, pair)};
}

namespace {

// Returns the outcome of a step that a pair with this one limits.
Outcome outcome_of_step(PairOutcome outcome) {
  switch (outcome) {
    case PairOutcome::initial_contact:
      return Outcome::initial_contact;
    case PairOutcome::max_checks:
      return Outcome::max_checks;
    case PairOutcome::below_rounding:
      return Outcome::below_rounding;
    default:  // one that parts at the start and is met again later limits the step as a contact
      return Outcome::contact;
  }
}

}  // namespace

void limit_step(const Mesh& mesh, const TraversalResult& traversal, const Budget& budget, double upper,
                double t_max, StepResult& r) {
  note_worst(mesh, traversal, r.stats);
  if (budget.outcome() != Outcome::free) {
    r.step = 0;
    r.outcome = budget.outcome();
    r.stats.looked_at = budget.done();
    return;
  }
  if (const FoundPair* limiting = limit_step(traversal.limits, upper, t_max, r))
    r.limiting = to_pair(mesh, *limiting);
}

const FoundPair* limit_step(const Limits& limits, double upper, double t_max, StepResult& r) {
  r.step = upper;
  r.toi = INFINITY;
  if (limits.contact && limits.contact->result.step_limit <= t_max) {
    const PairResult& contact = limits.contact->result;
    r.toi = contact.step_limit;
    r.certainty = contact.limit_certainty;
    if (contact.outcome != PairOutcome::initial_separating) r.toi_hi = contact.toi_hi;
  }
  const FoundPair* limiting = nullptr;
  if (limits.stored &&
      (limits.stored->result.stored_limit < upper || limits.stored->result.stored_limit == 0)) {
    limiting = &*limits.stored;
    r.step = limiting->result.stored_limit;
    r.outcome = outcome_of_step(limiting->result.outcome);
  }
  if (r.step > 0 && limits.clear && limits.clear->result.clear_from > r.step)
    limiting = &*limits.clear, r.step = 0;
  if (r.step > 0 && limits.clear) r.shortest = limits.clear->result.clear_from;
  if (limiting == nullptr) return nullptr;
  // Only rounding holds back at once a pair that starts apart, or parts.
  if (r.step == 0 && limiting->result.outcome != PairOutcome::initial_contact)
    r.outcome = Outcome::below_rounding;
  return limiting;
}

}  // namespace onset
