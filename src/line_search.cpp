#include "onset/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include "base/parallel.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "src/checked_options.hpp"
#include "src/pass.hpp"
#include "src/scene.hpp"

namespace onset {
namespace {

// Pairs found once, streamed again for every step size: a source that only remembers.
class HeldPairs final : public PairSource {
 public:
  std::size_t blocks(PairKind kind) const override { return (of(kind).size() + kBatchSize - 1) / kBatchSize; }
  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    for (std::size_t block = first; block < last; ++block) {
      const std::size_t begin = block * kBatchSize, end = std::min(begin + kBatchSize, of(kind).size());
      sink(of(kind).data() + begin, end - begin);
    }
  }
  const std::vector<IdPair>& of(PairKind kind) const {
    return kind == PairKind::vertex_face ? vertex_face_ : edge_edge_;
  }

  // Keeps what the culls of `narrow` cannot certify, in the order of ids.
  void fill(const BroadPhase& broad, const NarrowPhase& narrow) {
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      std::vector<IdPair>& held = kind == PairKind::vertex_face ? vertex_face_ : edge_edge_;
      std::mutex mutex;
      parallel_ranges(broad.blocks(kind), 16, [&](std::size_t first, std::size_t last) {
        Task task{narrow, kind, {}, {}};
        broad.traverse(kind, first, last, {&task, &Task::consume});
        const std::lock_guard<std::mutex> lock(mutex);
        held.insert(held.end(), task.kept.begin(), task.kept.end());
      });
      parallel_sort(held.begin(), held.end(),
                    [](const IdPair& p, const IdPair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
      held.shrink_to_fit();
    }
  }

 private:
  struct Task {
    const NarrowPhase& narrow;
    PairKind kind;
    NarrowPhaseScratch scratch;
    std::vector<IdPair> kept;
    static void consume(void* context, const IdPair* pairs, std::size_t count) {
      auto& task = *static_cast<Task*>(context);
      task.narrow.cull(task.kind, pairs, count, task.scratch, task.kept);
    }
  };
  std::vector<IdPair> vertex_face_, edge_edge_;
};

std::vector<double> sum(const Positions& x, const Positions& dx) {
  if (x.rows() != dx.rows() || dx.cols() != 3) {
    std::ostringstream s;
    s << "dx has " << dx.rows() << " rows of " << dx.cols() << " coordinates; x_t0 has " << x.rows()
      << " rows of 3";
    throw std::invalid_argument(s.str());
  }
  std::vector<double> r(std::size_t(3 * x.rows()));
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (std::ptrdiff_t a = 0; a < 3; ++a) r[std::size_t(3 * v + a)] = x(v, a) + dx(v, a);
  return r;
}

// Storing x_t0 + step dx rounds: fl(x + fl(s dx)) errs per coordinate by u |s dx| + u |x_new|, and x_t1 =
// fl(x + dx), on which the certificates stand, by u |x_t1|: below 4u M in all with M the largest coordinate
// (|dx| <= 2M). A distance changes by at most sqrt(3) times that at each of its two points: 8 sqrt(3) u M <
// 14u M.
double rounding_of_distances(const Motion& motion) {
  double largest = 0;
  for (int v = 0; v < motion.num_vertices; ++v)
    for (const double* x : {motion.t0(v), motion.t1(v)})
      for (int a = 0; a < 3; ++a) largest = std::max(largest, std::fabs(x[a]));
  return 14 * 0x1p-53 * largest;
}

}  // namespace

struct LineSearch::Held {
  Mesh mesh;
  Options options;
  double keep, rounding = 0;
  std::unique_ptr<Scene> scene;  // its motion; the tree goes once the pairs are held
  StepResult start;              // statistics of the broad phase; outcome and vertex of an unusable motion
  HeldPairs pairs;

  NarrowPhaseInput input() const {
    return {mesh.data(), scene->motion, start.stats.tolerance, start.stats.extent, options, keep, rounding};
  }
};

LineSearch::LineSearch(const Mesh& mesh, const Positions& x_t0, const Positions& dx, const Options& options,
                       double keep)
    : held_(new Held{mesh, options, keep, 0, {}, {}, {}}) {
  check(options);
  if (!(keep >= 0 && keep < 1))
    throw std::invalid_argument("keep is " + std::to_string(keep) + "; it must be in [0, 1)");
  const std::vector<double> x_t1 = sum(x_t0, dx);
  Held& h = *held_;
  in_arena(options.threads, [&] {
    const Positions end(x_t1.data(), x_t0.rows());
    h.scene = std::make_unique<Scene>(h.mesh, x_t0, end, h.options, BoxTest::motion, h.start.stats);
    h.start.outcome = h.scene->motion.status;
    h.start.vertex = h.scene->motion.bad_vertex;
    if (h.start.outcome != Outcome::free) return;
    h.rounding = rounding_of_distances(h.scene->motion);
    h.pairs.fill(*h.scene->broad, NarrowPhase(h.input()));
    h.scene->broad.reset();
  });
}
LineSearch::~LineSearch() = default;
LineSearch::LineSearch(LineSearch&&) noexcept = default;
LineSearch& LineSearch::operator=(LineSearch&&) noexcept = default;

PairCounts LineSearch::candidates() const {
  return {std::int64_t(held_->pairs.of(PairKind::vertex_face).size()),
          std::int64_t(held_->pairs.of(PairKind::edge_edge).size())};
}

LineSearchStep LineSearch::largest_step(double upper) const {
  if (!(upper >= 0 && upper <= 1))
    throw std::invalid_argument("upper is " + std::to_string(upper) + "; it must be in [0, 1]");
  const Held& h = *held_;
  LineSearchStep r;
  r.result = h.start;
  r.keep = h.keep;
  r.rounding = h.rounding;
  if (h.start.outcome != Outcome::free) return r;
  in_arena(h.options.threads, [&] {
    const Clock clock;
    const PassResult pass = run_pass(h.pairs, NarrowPhase(h.input()), Keep::limiting, upper);
    copy_counts(pass, r.result.stats);
    limit_step(h.mesh, pass, r.result);
    r.result.stats.seconds_narrow = r.result.stats.seconds_total = clock.seconds();
    for (const auto& [kind, stats] :
         {std::pair{PairKind::vertex_face, pass.vertex_face}, {PairKind::edge_edge, pass.edge_edge}}) {
      if (stats.least_kept >= r.keep) continue;
      r.keep = std::max(stats.least_kept, 0.0);
      r.keep_reduced = true;
      r.assured = stats.least_kept >= 0;
      r.closest = to_pair(h.mesh, {kind, {stats.closest, 0, 0, 0, Outcome::free}});
    }
  });
  if (r.result.step >= upper) {
    r.result.step = upper;
    r.result.outcome = Outcome::free;
    r.result.limiting = Pair{};
  }
  return r;
}

}  // namespace onset
