#include "src/shared/pair_list.hpp"

#include <algorithm>
#include <atomic>

#include "base/assert.hpp"
#include "base/clock.hpp"
#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "scene/motion/extents.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_source.hpp"
#include "src/planes/plane_contacts.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/pair_traversal.hpp"
#include "src/shared/rest/rest_limits.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {

namespace {

constexpr std::size_t kBlocksATask = 16;

}  // namespace

std::size_t PairList::blocks(PairKind kind) const { return (of(kind).size() + kBatchSize - 1) / kBatchSize; }

void PairList::traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const {
  ONSET_ASSERT(last <= blocks(kind));
  for (std::size_t block = first; block < last; ++block) {
    const std::size_t begin = block * kBatchSize, end = std::min(begin + kBatchSize, of(kind).size());
    sink(of(kind).data() + begin, end - begin);
  }
}

bool cull_into(const PairSource& broad, const std::vector<CulledList>& lists, std::int64_t most,
               Budget& budget) {
  struct Task {
    NarrowPhaseScratch scratch;
    std::vector<std::vector<IdPair>> kept;
  };
  const Task initial{{}, std::vector<std::vector<IdPair>>(lists.size())};
  const auto key = [](const IdPair& p) { return std::uint64_t(p.a) << 32 | std::uint64_t(p.b); };
  std::atomic<std::int64_t> room{most};
  const auto ended = [&] { return room < 0; };
  budget.begin_traversal(all_blocks(broad));
  for (const PairKind kind : kStepKinds) {
    std::vector<Parts<IdPair>> parts(lists.size());
    const auto cull = [&](Task& task, const IdPair* pairs, std::size_t count) {
      for (std::size_t i = 0; i < lists.size(); ++i) {
        std::vector<IdPair>& kept = task.kept[i];
        const std::size_t before = kept.size();
        lists[i].narrow.cull(kind, pairs, count, task.scratch, kept);
        room -= std::int64_t(kept.size() - before);
        if (kept.size() >= Parts<IdPair>::kPart) parts[i].add(kept);
      }
    };
    const auto merge = [&](Task& task) {
      for (std::size_t i = 0; i < lists.size(); ++i) parts[i].add(task.kept[i]);
    };
    visit_pairs(broad, kind, kBlocksATask, initial, budget, cull, merge, ended);
    for (std::size_t i = 0; i < lists.size() && room >= 0 && !budget.spent(); ++i)
      parts[i].sort_into(lists[i].list.of(kind), key, budget.stop());
  }
  if (room >= 0 && budget.outcome() == Outcome::free) return true;
  for (const CulledList& culled : lists) culled.list = PairList();
  return false;
}

StepResult step_of_pairs(const Mesh& mesh, const Motion& motion, const PairList& pairs,
                         const Options& options, double gap_share, Budget& budget, double upper) {
  StepResult r;
  const Clock clock;
  const MeshData& data = mesh.data();
  r.outcome = motion.status;
  r.vertex = motion.bad_vertex;
  r.stats.threads = current_threads();
  r.stats.instruction_set = to_string(resolve_instruction_set(options.instruction_set));
  r.stats.broad_phase = "listed";
  if (r.outcome != Outcome::free) return r;
  const Accuracy accuracy = accuracy_of(data, motion, options);
  note(accuracy, r.stats);
  const double rounding = rounding_of_distances(motion);
  const std::shared_ptr<const RestLimits> rest = rest_limits(data, options, budget);
  NarrowPhaseInput input = stored_step_input(data, motion, accuracy, options, gap_share, rounding);
  input.rest = rest.get();
  const NarrowPhase narrow(input);
  const PlaneContacts planes =
      limits_of_listed({data, motion, options, {true, gap_share, options.touching_may_pass_through}},
                       pairs.of(PairKind::vertex_plane), budget);
  TraversalResult traversal = traverse_pairs(pairs, narrow, Collect::first, 1, budget);
  traversal.limits.add(planes.limits);
  copy_counts(traversal, r.stats);
  add_counts(planes, r.stats);
  limit_step(mesh, traversal, budget, upper, 1, r);
  r.rounding = reported_rounding(rounding);
  r.stats.seconds_narrow = clock.seconds();
  return r;
}

}  // namespace onset
