#include "src/pass.hpp"

#include <algorithm>
#include <cstdint>

#include "base/parallel.hpp"

namespace onset {
namespace {

constexpr std::size_t kBlocksATask = 16;

// Ids are not negative: one number orders a kind's pairs as (a, b) does.
std::uint64_t order(const FoundPair& f) {
  return std::uint64_t(f.kind == PairKind::edge_edge) << 63 | std::uint64_t(f.result.pair.a) << 32 |
         std::uint64_t(f.result.pair.b);
}

class Pass {
 public:
  Pass(const PairSource& pairs, const NarrowPhase& narrow, Keep keep, double horizon)
      : pairs_(pairs), narrow_(narrow), keep_(keep), horizon_(horizon) {}

  // Every stride-th block.
  void run(PairKind kind, std::size_t stride, NarrowPhaseStats& stats) {
    const std::size_t blocks = (pairs_.blocks(kind) + stride - 1) / stride;
    parallel_ranges(blocks, kBlocksATask, [&](std::size_t first, std::size_t last) {
      if (ended()) return;
      Task task{*this, kind, {}, {}};
      if (stride == 1)
        pairs_.traverse(kind, first, last, {&task, &Task::consume});
      else
        for (std::size_t i = first; i < last; ++i)
          pairs_.traverse(kind, i * stride, i * stride + 1, {&task, &Task::consume});
      merge(kind, task, stats);
    });
  }

  std::vector<FoundPair> take() {
    if (keep_ == Keep::all)
      parallel_sort(found_.begin(), found_.end(),
                    [](const FoundPair& x, const FoundPair& y) { return order(x) < order(y); });
    return std::move(found_);
  }

 private:
  struct Task {
    Pass& pass;
    PairKind kind;
    NarrowPhaseScratch scratch;
    std::vector<PairResult> results;

    static void consume(void* context, const IdPair* pairs, std::size_t count) {
      auto& task = *static_cast<Task*>(context);
      if (task.pass.ended()) return;
      task.pass.narrow_.process(task.kind, pairs, count, task.pass.horizon_.load(std::memory_order_relaxed),
                                task.scratch, task.results);
      if (task.pass.keep_ != Keep::all) task.pass.shrink_horizon(task);
    }
  };

  bool ended() const { return keep_ == Keep::any && horizon_.load(std::memory_order_relaxed) < 1; }

  // Keeps the task's first limiting pair only. The horizon is only ever an early-out: results do not depend
  // on it.
  void shrink_horizon(Task& task) {
    if (task.results.empty()) return;
    std::size_t best = 0;
    const auto as_found = [&](std::size_t i) { return FoundPair{task.kind, task.results[i]}; };
    for (std::size_t i = 1; i < task.results.size(); ++i)
      if (limits_before(as_found(i), as_found(best))) best = i;
    task.results[0] = task.results[best];
    task.results.resize(1);
    const double limit = task.results[0].step_limit;
    double now = horizon_.load(std::memory_order_relaxed);
    while (limit < now && !horizon_.compare_exchange_weak(now, limit, std::memory_order_relaxed)) {
    }
  }

  void merge(PairKind kind, const Task& task, NarrowPhaseStats& stats) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stats.add(task.scratch.stats);
    for (const PairResult& r : task.results) {
      const FoundPair f{kind, r};
      if (keep_ == Keep::all || found_.empty())
        found_.push_back(f);
      else if (limits_before(f, found_[0]))
        found_[0] = f;
    }
  }

  const PairSource& pairs_;
  const NarrowPhase& narrow_;
  const Keep keep_;
  std::atomic<double> horizon_;
  std::mutex mutex_;
  std::vector<FoundPair> found_;
};

}  // namespace

bool before(const FoundPair& x, const FoundPair& y) { return order(x) < order(y); }

bool limits_before(const FoundPair& x, const FoundPair& y) {
  return x.result.step_limit != y.result.step_limit ? x.result.step_limit < y.result.step_limit
                                                    : before(x, y);
}

PassResult run_pass(const PairSource& pairs, const NarrowPhase& narrow, Keep keep, double horizon,
                    std::size_t stride) {
  PassResult result;
  Pass pass(pairs, narrow, keep, horizon);
  pass.run(PairKind::vertex_face, stride, result.vertex_face);
  pass.run(PairKind::edge_edge, stride, result.edge_edge);
  result.found = pass.take();
  return result;
}

void copy_counts(const PassResult& pass, Stats& stats) {
  const auto both = [&](std::int64_t NarrowPhaseStats::*field) {
    return PairCounts{pass.vertex_face.*field, pass.edge_edge.*field};
  };
  stats.candidates = both(&NarrowPhaseStats::candidates);
  stats.after_culls = both(&NarrowPhaseStats::after_culls);
  stats.inclusion = both(&NarrowPhaseStats::inclusion);
  stats.contacts = both(&NarrowPhaseStats::contacts);
  stats.budget = both(&NarrowPhaseStats::budget);
  stats.checks = both(&NarrowPhaseStats::checks).total();
  stats.max_checks_of_a_pair = std::max(pass.vertex_face.most_checks, pass.edge_edge.most_checks);
  stats.achieved_tolerance = std::max(pass.vertex_face.achieved_tolerance, pass.edge_edge.achieved_tolerance);
}

Pair to_pair(const Mesh& mesh, const FoundPair& f) {
  return {f.kind, f.result.pair.a, f.result.pair.b, pair_vertices(mesh.data(), f.kind, f.result.pair)};
}

void limit_step(const Mesh& mesh, const PassResult& pass, StepResult& r) {
  r.step = 1;
  if (pass.found.empty() || pass.found[0].result.step_limit >= 1) return;
  const PairResult& limiting = pass.found[0].result;
  r.step = limiting.step_limit;
  // A pair that parts at the start and is met again later limits the step as a contact.
  r.outcome = limiting.outcome == Outcome::initial_separating ? Outcome::contact : limiting.outcome;
  r.limiting = to_pair(mesh, pass.found[0]);
  r.certainty = limiting.limit_certainty;
  if (limiting.outcome != Outcome::initial_separating) r.toi_hi = limiting.toi_hi;
}

}  // namespace onset
