#include "src/planes/plane_contacts.hpp"

#include <mutex>

#include "src/planes/plane_blocks.hpp"

namespace onset {
namespace {

// A vertex that may limit a step.
struct Survivor {
  int vertex;
  double contact_from, stored_from;
};

class PlaneTraversal {
 public:
  PlaneTraversal(const PlaneInput& input, Budget& budget)
      : in_(input),
        budget_(budget),
        blocks_(input.mesh, input.motion.axes, input.options.norm),
        maximum_norm_(input.options.norm == Norm::maximum) {}

  // Keeps all contacts, or the earliest `most`.
  void find_all(std::size_t most) {
    FoundPairs found(most);
    budget_.begin_traversal(blocks_.size());
    blocks_.visit(budget_, [&](std::size_t, const PlaneBlock& block) {
      std::vector<PairResult> results;
      NarrowPhaseStats stats;
      PlaneWatch watch(budget_);
      for_survivors(block, 0, [&](int v, double, const PlaneSpan&) {
        ++stats.after_culls;
        if (const auto r = decide(block, v, stats)) results.push_back(*r);
        return !watch.ended();
      });
      stats.candidates = std::int64_t(block.last - block.first);
      stats.contacts = std::int64_t(results.size());
      keep(std::move(results), stats, most, found);
    });
    all.found = found.take(budget_);
  }

  // Decides those alone that may be the first by a bound: no other can be, whatever it is.
  void find_first() {
    std::vector<std::vector<Survivor>> survivors(blocks_.size());
    double contact_by = INFINITY, stored_by = INFINITY;
    budget_.begin_traversal(2 * blocks_.size());
    const double kept = in_.ask.stored ? in_.ask.gap_share : 0;
    blocks_.visit(budget_, [&](std::size_t i, const PlaneBlock& block) {
      double contact = INFINITY, stored = INFINITY;
      for_survivors(block, kept, [&](int v, double separation, const PlaneSpan& span) {
        const PlaneTimes times(span, *block.plane, separation, kept);
        contact = std::min(contact, times.contact_by), stored = std::min(stored, times.stored_by);
        survivors[i].push_back({v, times.contact_from, in_.ask.stored ? times.stored_from : INFINITY});
        return true;
      });
      const std::lock_guard<std::mutex> lock(mutex_);
      contact_by = std::min(contact_by, contact), stored_by = std::min(stored_by, stored);
      all.stats.candidates += std::int64_t(block.last - block.first);
      all.stats.after_culls += std::int64_t(survivors[i].size());
    });
    blocks_.visit(budget_, [&](std::size_t i, const PlaneBlock& block) {
      Limits limits;
      NarrowPhaseStats stats;
      PlaneWatch watch(budget_);
      for (const Survivor& s : survivors[i]) {
        if (s.contact_from > std::min(contact_by, 1.0) && s.stored_from > std::min(stored_by, 1.0)) continue;
        if (watch.ended()) return;
        add_limit(decide(block, s.vertex, stats), limits, stats);
      }
      merge(limits, stats);
    });
  }

  void find_listed(const std::vector<IdPair>& pairs) {
    Limits limits;
    NarrowPhaseStats stats;
    PlaneWatch watch(budget_);
    for (const IdPair& p : pairs) {
      if (watch.ended()) break;
      const OrientedPlane& plane = blocks_.planes()[std::size_t(p.b)];
      add_limit(decide({&plane, p.b, nullptr, 0, 0}, p.a, stats), limits, stats);
    }
    stats.candidates = stats.after_culls = std::int64_t(pairs.size());
    merge(limits, stats);
  }

  PlaneContacts all;

 private:
  // Adds what was found to the rest. Where that is too much, the earliest are kept while others add theirs.
  void keep(std::vector<PairResult>&& results, const NarrowPhaseStats& stats, std::size_t most,
            FoundPairs& found) {
    FoundPairs many(most);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      all.stats.add(stats);
      found.add(PairKind::vertex_plane, std::move(results));
      if (!found.too_many() || dropping_) return;
      dropping_ = true;
      std::swap(many, found);
    }
    many.keep_earliest(budget_.stop());
    const std::lock_guard<std::mutex> lock(mutex_);
    found.add(std::move(many));
    dropping_ = false;
  }
  // Calls f(vertex, separation, span) for those that the cheap test leaves, until it returns false.
  template <class F>
  void for_survivors(const PlaneBlock& block, double kept, F&& f) const {
    double separation = in_.options.min_separation;
    const bool thick = !in_.mesh.thickness.empty();
    for (std::size_t i = block.first; i < block.last; ++i) {
      const int v = block.vertex(i);
      const PlaneSpan span(*block.plane, in_.motion.t0(v), in_.motion.t1(v));
      if (thick) separation = separation_from_planes(in_.mesh, in_.options, v);
      if (span.stays_beyond(*block.plane, separation, kept)) continue;
      if (!f(v, separation, span)) return;
    }
  }
  std::optional<PairResult> decide(const PlaneBlock& block, int v, NarrowPhaseStats& stats) const {
    const PlaneQuestion question =
        question_of(*block.plane, in_.motion.t0(v), in_.motion.t1(v),
                    separation_from_planes(in_.mesh, in_.options, v), maximum_norm_);
    return decide_plane(*block.plane, question, in_.ask, {v, block.row}, stats);
  }
  static void add_limit(const std::optional<PairResult>& r, Limits& limits, NarrowPhaseStats& stats) {
    if (!r) return;
    ++stats.contacts;
    limits.add({PairKind::vertex_plane, *r});
  }
  void merge(const Limits& limits, const NarrowPhaseStats& stats) {
    const std::lock_guard<std::mutex> lock(mutex_);
    all.limits.add(limits);
    all.stats.add(stats);
  }

  const PlaneInput& in_;
  Budget& budget_;
  const PlaneBlocks blocks_;
  const bool maximum_norm_;
  std::mutex mutex_;
  bool dropping_ = false;
};

}  // namespace

PlaneContacts find_plane_contacts(const PlaneInput& input, Collect collect, Budget& budget,
                                  std::size_t most) {
  if (!input.mesh.mesh_planes) return {};
  PlaneTraversal traversal(input, budget);
  if (collect == Collect::all)
    traversal.find_all(most);
  else
    traversal.find_first();
  return std::move(traversal.all);
}

PlaneContacts limits_of_listed(const PlaneInput& input, const std::vector<IdPair>& pairs, Budget& budget) {
  if (pairs.empty()) return {};
  PlaneTraversal traversal(input, budget);
  traversal.find_listed(pairs);
  return std::move(traversal.all);
}

void add_counts(const PlaneContacts& planes, Stats& stats) {
  stats.candidates.vertex_plane = planes.stats.candidates;
  stats.after_culls.vertex_plane = planes.stats.after_culls;
  stats.contacts.vertex_plane = planes.stats.contacts;
}

}  // namespace onset
