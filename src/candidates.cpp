#include "onset/candidates.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include "scene/pair_source.hpp"
#include "src/planes/plane_blocks.hpp"
#include "src/planes/plane_contacts.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/found_pairs.hpp"
#include "src/shared/step_setup.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {
namespace {

// What is done with the candidates of a step besides counting them.
struct Use {
  const CandidateVisitor* visitor = nullptr;
  bool list = false;
};

// Counts, lists or hands on the candidates of one setup.
class CandidateList {
 public:
  CandidateList(const MeshData& mesh, const StepSetup& setup, const Use& use, const Options& options,
                Budget& budget, Candidates& result)
      : mesh_(mesh),
        setup_(setup),
        use_(use),
        budget_(budget),
        result_(result),
        room_(use.list ? options.memory_limit / std::int64_t(sizeof(IdPair)) : 0) {}

  void take(PairKind kind) {
    std::int64_t& count = count_of(kind, result_.counts);
    const auto visit = [&](Task& task, const IdPair* pairs, std::size_t n) { take(kind, pairs, n, task); };
    const auto merge = [&](Task& task) {
      count += task.count;
      parts_[std::size_t(kind)].add(task.ids);
    };
    visit_pairs(*setup_.broad, kind, kBlocksATask, Task{}, budget_, visit, merge, [] { return false; });
    if (too_many() || budget_.outcome() != Outcome::free)
      for (Parts<IdRow>& of_kind : parts_) of_kind.clear();
  }
  // Those of planes: whom the cheap test does not keep beyond its separation.
  void take_planes(const Options& options) {
    const PlaneBlocks blocks(mesh_, setup_.motion.axes, options.norm);
    std::atomic<std::int64_t> count{0};
    const auto add = [&](const PlaneBlock& block, int v, std::vector<IdRow>& found) {
      const PlaneSpan span(*block.plane, setup_.motion.t0(v), setup_.motion.t1(v));
      if (!span.stays_beyond(*block.plane, separation_from_planes(mesh_, options, v), 0))
        ++count, found.push_back({v, block.row});
    };
    if (use_.list) {
      Gathered<IdRow> all;
      const auto ids_of = [](const IdRow& ids) { return IdPair{ids[0], ids[1]}; };
      gather_planes(blocks, std::size_t(std::max<std::int64_t>(room_, 0)), budget_, add, ids_of, all);
      if (all.too_many) room_ = -1;
      result_.vertex_plane = std::move(all.found);
    } else {
      visit_planes<IdRow>(blocks, budget_, add,
                          [&](std::vector<IdRow>& found) { hand_on(PairKind::vertex_plane, found); });
    }
    result_.counts.vertex_plane = count;
  }
  // Puts what was listed in order, unless the budget ends that.
  void sort() {
    const Stop stop = budget_.stop();
    const auto key = [](const IdRow& ids) { return std::uint64_t(ids[0]) << 32 | std::uint64_t(ids[1]); };
    if (stop.requested()) return;
    std::vector<IdRow>* const lists[] = {&result_.vertex_face, &result_.edge_edge, &result_.vertex_edge};
    for (std::size_t k = 0; k < parts_.size(); ++k)
      if (!parts_[k].sort_into(*lists[k], key, stop)) return;
  }
  // Says whether the list would not fit; nothing more is then listed.
  bool too_many() const { return room_ < 0; }

 private:
  static constexpr std::size_t kBlocksATask = 64;
  using IdRow = std::array<int, 2>;
  struct Task {
    std::int64_t count = 0;
    std::vector<IdRow> ids;  // listed, or about to be visited
  };

  void take(PairKind kind, const IdPair* pairs, std::size_t n, Task& task) {
    std::vector<IdRow>& out = task.ids;
    const std::size_t before = out.size();
    const bool lists = use_.list ? room_ >= 0 : use_.visitor != nullptr;
    for (std::size_t i = 0; i < n; ++i) {
      if (mesh_.weld && is_seam(setup_.motion, kind, pair_vertices(mesh_, kind, pairs[i]))) continue;
      ++task.count;
      if (lists) out.push_back({pairs[i].a, pairs[i].b});
    }
    if (use_.list && (room_ -= std::int64_t(out.size() - before)) < 0) out.clear();
    if (out.size() >= Parts<IdRow>::kPart) parts_[std::size_t(kind)].add(out);
    if (use_.visitor != nullptr) hand_on(kind, out);
  }
  // Hands pairs on to the visitor, if there is one, and drops them.
  void hand_on(PairKind kind, std::vector<IdRow>& pairs) {
    try {
      if (use_.visitor != nullptr && !pairs.empty())
        call_host([&] { (*use_.visitor)(kind, pairs.data(), pairs.size()); });
    } catch (...) {
      budget_.abandon();
      throw;
    }
    pairs.clear();
  }

  const MeshData& mesh_;
  const StepSetup& setup_;
  const Use use_;
  Budget& budget_;
  Candidates& result_;
  std::atomic<std::int64_t> room_;
  std::array<Parts<IdRow>, kStepKinds.size()> parts_;
};

Candidates candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options,
                      const Use& use) {
  check(options);
  Candidates c;
  in_arena(options.threads, [&] {
    Budget budget(options);
    StepSetup setup(mesh, x_t0, x_t1, options, StepSetup::Use::candidates, c.stats, budget);
    c.outcome = setup.motion.status;
    c.vertex = setup.motion.bad_vertex;
    if (c.outcome != Outcome::free) return;
    CandidateList list(mesh.data(), setup, use, options, budget, c);
    if (setup.broad) {
      budget.begin_traversal(all_blocks(*setup.broad));
      for (const PairKind kind : kStepKinds)
        if (has_kind(mesh.data(), kind)) list.take(kind);
      list.take_planes(options);
    }
    if (!list.too_many()) list.sort();
    c.outcome = list.too_many() ? Outcome::out_of_memory : budget.outcome();
    if (c.outcome != Outcome::free) c.vertex_face = c.edge_edge = c.vertex_edge = c.vertex_plane = {};
    if (budget.outcome() != Outcome::free) c.stats.looked_at = budget.done();
    c.stats.swept = c.counts;
    c.stats.seconds_broad = c.stats.seconds_total = setup.clock.seconds();
  });
  return c;
}

}  // namespace

Candidates compute_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                              const Options& options) {
  return candidates(mesh, x_t0, x_t1, options, {nullptr, true});
}
Candidates count_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                            const Options& options) {
  return candidates(mesh, x_t0, x_t1, options, {});
}
Candidates visit_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                            const CandidateVisitor& visit, const Options& options) {
  if (!visit) throw std::invalid_argument("visit is empty");
  return candidates(mesh, x_t0, x_t1, options, {&visit, false});
}

}  // namespace onset
