#include "onset/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/parallel.hpp"
#include "base/text_stream.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_source.hpp"
#include "src/part/part_of_line_search.hpp"
#include "src/planes/plane_contacts.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/close_set.hpp"
#include "src/shared/pair_list.hpp"
#include "src/shared/pair_traversal.hpp"
#include "src/shared/step_setup.hpp"

namespace onset {
namespace {

std::vector<double> sum(const Positions& x, const Positions& dx, int columns) {
  if (x.rows() != dx.rows() || x.cols() != columns || dx.cols() != columns) {
    TextStream s;
    s << "x_t0 has " << x.rows() << " rows of " << x.cols() << " coordinates, dx has " << dx.rows() << " of "
      << dx.cols() << "; both need one row of " << columns << " for each vertex";
    throw std::invalid_argument(s.str());
  }
  std::vector<double> r;
  r.reserve(std::size_t(columns * x.rows()));
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (std::ptrdiff_t a = 0; a < columns; ++a) r.push_back(x(v, a) + dx(v, a));
  return r;
}

void check_step(const char* name, double step) {
  if (!(step >= 0 && step <= 1))
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(step) + "; it must be in [0, 1]");
}

}  // namespace

struct LineSearch::Impl {
  Mesh mesh;
  LineSearchOptions options;
  double rounding = 0;
  // Whether there is a d_hat: not asked where a host may take subnormal numbers for 0.
  bool lists_close = false;
  std::unique_ptr<StepSetup> setup;  // keeps its tree only where the lists do not fit
  std::vector<double> dx;            // as the caller gave it, 3 a vertex; empty without a distance set
  StepResult start;      // statistics of the broad phase; outcome and vertex of an unusable motion
  PairList pairs, near;  // may limit a step; may come within d_hat on the way

  NarrowPhaseInput input() const {
    NarrowPhaseInput r =
        stored_step_input(mesh.data(), setup->motion, setup->accuracy, options, options.gap_share, rounding);
    r.rest = setup->rest.get();
    return r;
  }
  bool fill(Budget& budget);
  const PairSource& source(const PairList& list) const {
    return setup->broad ? static_cast<const PairSource&>(*setup->broad) : list;
  }
  std::vector<double> at(double step) const;
  FoundOnLine find(double upper, Budget& budget) const;
};

// Fills the lists; returns false where they would be too long. A pair that stays beyond euclidean_reach in
// exact motion is beyond d_hat wherever the line search stops, in stored doubles too.
bool LineSearch::Impl::fill(Budget& budget) {
  const std::int64_t most = options.memory_limit / std::int64_t(sizeof(IdPair));
  const NarrowPhase narrow(input());
  std::vector<CulledList> lists{{narrow, pairs}};
  if (options.d_hat == 0) return cull_into(*setup->broad, lists, most, budget);
  Options beyond = static_cast<const Options&>(options);
  beyond.min_separation = euclidean_reach(mesh.data(), options, options.d_hat, rounding);
  beyond.norm = Norm::euclidean;
  NarrowPhaseInput wide{mesh.data(), setup->motion, setup->accuracy.tolerance, setup->accuracy.extent,
                        beyond};
  wide.ignores_bodies = true;  // the largest of their separations is in the reach
  const NarrowPhase far(wide);
  lists.push_back({far, near});
  return cull_into(*setup->broad, lists, most, budget);
}

// Returns the positions x_t0 + step dx, rounded: 4 doubles a vertex, in the motion's order of axes.
std::vector<double> LineSearch::Impl::at(double step) const {
  const Motion& m = setup->motion;
  std::vector<double> x(std::size_t(m.num_vertices) * 4);
  for (int v = 0; v < m.num_vertices; ++v)
    for (std::size_t a = 0; a < 3; ++a)
      x[4 * std::size_t(v) + a] = m.t0(v)[a] + step * dx[3 * std::size_t(v) + std::size_t(m.axes[a])];
  return x;
}

LineSearch::LineSearch() noexcept = default;

LineSearch::LineSearch(const Mesh& mesh, const Positions& x_t0, const Positions& dx,
                       const LineSearchOptions& options)
    : impl_(new Impl{mesh, options, 0, false, {}, {}, {}, {}, {}}) {
  check(options);
  check_d_hat(options.d_hat, true);
  check_gap_share(options.gap_share);
  const int columns = mesh.dimension();
  const std::vector<double> x_t1 = in_float_environment(sum, x_t0, dx, columns);
  Impl& h = *impl_;
  in_arena(options.threads, [&] {
    h.lists_close = options.d_hat > 0;
    for (std::ptrdiff_t i = 0; h.lists_close && i < 3 * dx.rows(); ++i)
      h.dx.push_back(i % 3 < columns ? dx(i / 3, i % 3) : 0);
    const Positions end(x_t1.data(), x_t0.rows(), columns);
    Budget budget(h.options);
    h.setup = std::make_unique<StepSetup>(h.mesh, x_t0, end, h.options, StepSetup::Use::stored_step,
                                          h.start.stats, budget, options.d_hat);
    h.start.outcome = h.setup->motion.status;
    h.start.vertex = h.setup->motion.bad_vertex;
    if (h.start.outcome != Outcome::free) return;
    h.rounding = h.setup->rounding;
    h.start.rounding = reported_rounding(h.rounding);
    const bool fits = h.setup->broad && h.fill(budget);
    h.start.outcome = budget.outcome();
    if (h.start.outcome != Outcome::free) h.start.stats.looked_at = budget.done();
    if (fits || h.start.outcome != Outcome::free) h.setup->give_back_broad();
  });
}
LineSearch::~LineSearch() = default;
LineSearch::LineSearch(LineSearch&&) noexcept = default;
LineSearch& LineSearch::operator=(LineSearch&&) noexcept = default;

const LineSearch::Impl& LineSearch::impl() const {
  if (!impl_) throw std::logic_error("a line search that was made without a mesh, or moved from");
  return *impl_;
}

PairCounts LineSearch::candidates() const { return impl().pairs.counts(); }
PairCounts LineSearch::close_candidates() const { return impl().near.counts(); }

// Finds what limits the line search, and fills the statistics of a step but for the seconds.
FoundOnLine LineSearch::Impl::find(double upper, Budget& budget) const {
  FoundOnLine r;
  const PlaneAsk ask{true, options.gap_share, options.touching_may_pass_through};
  const PlaneContacts planes =
      find_plane_contacts({mesh.data(), setup->motion, options, ask}, Collect::first, budget);
  r.traversal = traverse_pairs(source(pairs), NarrowPhase(input()), Collect::first, upper, budget);
  r.traversal.limits.add(planes.limits);
  r.stats = start.stats;
  copy_counts(r.traversal, r.stats);
  add_counts(planes, r.stats);
  for (const PairKind kind : kStepKinds)
    r.least[std::size_t(kind)] = {r.traversal.of(kind).least_share, r.traversal.of(kind).closest};
  r.least[std::size_t(PairKind::vertex_plane)] = {planes.stats.least_share, planes.stats.closest};
  return r;
}

std::optional<std::pair<PairKind, IdPair>> put_shares(const LeastShares& least, LineSearchStep& r) {
  std::optional<std::pair<PairKind, IdPair>> closest;
  for (std::size_t kind = 0; kind < least.size(); ++kind) {
    if (least[kind].share >= r.gap_share) continue;
    r.gap_share = std::max(least[kind].share, 0.0);
    r.gap_share_reduced = true;
    closest = {PairKind(kind), least[kind].pair};
  }
  r.assured = r.outcome != Outcome::below_rounding || r.step > 0;
  return closest;
}

const StepResult& PartOfLineSearch::start(const LineSearch& search) { return search.impl().start; }

FoundOnLine PartOfLineSearch::find(const LineSearch& search, double upper) {
  const LineSearch::Impl& h = search.impl();
  FoundOnLine r;
  in_arena(h.options.threads, [&] {
    const Clock clock;
    Budget budget(h.options);
    r = h.find(upper, budget);
    r.outcome = budget.outcome();
    if (r.outcome != Outcome::free) r.stats.looked_at = budget.done();
    r.stats.seconds_narrow = r.stats.seconds_total = clock.seconds();
  });
  return r;
}

LineSearchStep LineSearch::largest_step(double upper) const {
  in_float_environment(check_step, "upper", upper);
  const Impl& h = impl();
  LineSearchStep r;
  static_cast<StepResult&>(r) = h.start;
  r.gap_share = h.options.gap_share;
  if (h.start.outcome != Outcome::free) return r;
  in_arena(h.options.threads, [&] {
    const Clock clock;
    Budget budget(h.options);
    const FoundOnLine found = h.find(upper, budget);
    r.stats = found.stats;
    limit_step(h.mesh, found.traversal, budget, upper, upper, r);
    r.stats.seconds_narrow = r.stats.seconds_total = clock.seconds();
    if (const auto closest = put_shares(found.least, r))
      r.closest = to_pair(h.mesh, {closest->first, {closest->second, 0, 0, 0, PairOutcome::free}});
  });
  return r;
}

ClosePairs LineSearch::close_pairs(double step) const {
  in_float_environment(check_step, "step", step);
  const Impl& h = impl();
  if (!h.lists_close) throw std::invalid_argument("close_pairs of a line search that was given no d_hat");
  ClosePairs r;
  r.d_hat = h.options.d_hat;
  r.outcome = h.start.outcome;
  r.vertex = h.start.vertex;
  if (r.outcome != Outcome::free) return r;
  in_arena(h.options.threads, [&] {
    const Clock clock;
    const std::vector<double> x = h.at(step);
    Budget budget(h.options);
    auto close = find_close(
        h.source(h.near),
        {h.mesh, x.data(), h.options.d_hat, h.rounding, h.options, h.setup->motion.axes, h.setup->rest.get()},
        budget);
    r.pairs = std::move(close.found);
    r.outcome = close.too_many ? Outcome::out_of_memory : budget.outcome();
    r.seconds = clock.seconds();
  });
  return r;
}

}  // namespace onset
