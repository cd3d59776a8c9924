#include "onset/mpi/line_search.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

#include "base/float_environment.hpp"
#include "mpi/results.hpp"
#include "scene/pair_source.hpp"
#include "src/part/part_of_line_search.hpp"
#include "src/part/part_of_step.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/close_set.hpp"

namespace onset::mpi {
namespace {

void check_line(const LineSearchOptions& options) {
  check_d_hat(options.d_hat, true);
  check_gap_share(options.gap_share);
}

void check_step(const char* name, double step) {
  if (!(step >= 0 && step <= 1))
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(step) + "; it must be in [0, 1]");
}

template <class Impl>
const Impl& of(const std::unique_ptr<Impl>& impl) {
  if (!impl) throw std::logic_error("this line search was moved from");
  return *impl;
}

// The sums x + dx of the rows that are read, as onset::LineSearch forms them; row by row, `columns` each.
std::vector<double> sum(const Mesh::Impl& m, const Positions& x, const Positions& dx) {
  if (x.rows() != dx.rows() || x.cols() != dx.cols())
    throw std::invalid_argument("x_t0 has " + std::to_string(x.rows()) + " rows of " +
                                std::to_string(x.cols()) + " coordinates, dx has " +
                                std::to_string(dx.rows()) + " of " + std::to_string(dx.cols()));
  std::vector<double> r;
  for (std::ptrdiff_t v = 0; v < std::min(x.rows(), std::ptrdiff_t(m.rows)); ++v)
    for (std::ptrdiff_t a = 0; a < x.cols(); ++a) r.push_back(x(v, a) + dx(v, a));
  return r;
}

// (c) Returns the least shares of the scene, with its ids, and the vertices of each pair.
struct SceneShares {
  LeastShares least;
  std::array<std::array<int, 4>, std::tuple_size_v<LeastShares>> vertices;
};
void keep_less(SceneShares& into, const SceneShares& from) {
  const auto order = [](const LeastShare& s) { return std::tuple(s.share, s.pair.a, s.pair.b); };
  for (std::size_t kind = 0; kind < into.least.size(); ++kind)
    if (order(from.least[kind]) < order(into.least[kind]))
      into.least[kind] = from.least[kind], into.vertices[kind] = from.vertices[kind];
}
SceneShares reduce(const Communicator& comm, const Part& part, const LeastShares& least) {
  SceneShares all{least, {}};
  for (std::size_t kind = 0; kind < least.size(); ++kind) {
    if (least[kind].pair.a < 0) continue;
    Pair pair{PairKind(kind), least[kind].pair.a, least[kind].pair.b,
              pair_vertices(part.mesh.data(), PairKind(kind), least[kind].pair)};
    part.rename(pair);
    all.least[kind].pair = {pair.a, pair.b}, all.vertices[kind] = pair.vertices;
  }
  comm.reduce(all, keep_less);
  return all;
}

}  // namespace

struct LineSearch::Impl {
  const Mesh::Impl& mesh;
  LineSearchOptions options;
  std::pair<Outcome, int> status{Outcome::free, -1};
  Part part;
  onset::LineSearch search;
};

LineSearch::LineSearch(const Mesh& mesh, const Positions& x_t0, const Positions& dx,
                       const LineSearchOptions& options) {
  const FloatEnvironment environment;
  const Mesh::Impl& m = mesh.impl();
  const auto prepare = [&] {
    check_line(options);
    impl_ = std::make_unique<Impl>(Impl{m, options, {Outcome::free, -1}, {}, {}});
  };
  begin_call(m, "line search", options, {options.d_hat, options.gap_share}, FunctionRef<>(prepare));
  std::vector<double> x_t1;
  m.comm.agreed([&] { x_t1 = sum(m, x_t0, dx); });
  OwnMotion own = take_motion(m, x_t0, Positions(x_t1.data(), x_t0.rows(), int(x_t0.cols())));
  impl_->status = {own.motion.status, own.motion.bad_vertex};
  end_call(m, 0);
  if (own.motion.status != Outcome::free) return;
  double inflation = 0;
  m.comm.agreed([&] {
    inflation =
        largest_inflation(reach_data(m, own.whole), options, StepSetup::Use::stored_step, options.d_hat);
  });
  take_direction(m, dx, own);
  impl_->part = make_part(m, std::move(own), inflation);
  m.comm.agreed([&] {
    Part& part = impl_->part;
    impl_->search = onset::LineSearch(part.mesh, part.start(), part.end(), options);
    part.x_t0 = {}, part.x_t1 = {};
  });
  const StepResult& start = PartOfLineSearch::start(impl_->search);
  impl_->status.first = agreed_outcome(m.comm, start.outcome);
  end_call(m, impl_->search.candidates().total());
}

LineSearch::~LineSearch() = default;
LineSearch::LineSearch(LineSearch&&) noexcept = default;
LineSearch& LineSearch::operator=(LineSearch&&) noexcept = default;

LineSearchStep LineSearch::largest_step(double upper) const {
  const FloatEnvironment environment;
  const Impl& h = of(impl_);
  const Communicator& comm = h.mesh.comm;
  const auto check = [&] { check_step("upper", upper); };
  begin_call(h.mesh, "largest step", h.options, {upper}, FunctionRef<>(check));
  LineSearchStep r;
  r.gap_share = h.options.gap_share;
  r.outcome = h.status.first, r.vertex = h.status.second;
  if (r.outcome != Outcome::free) return r;
  FoundOnLine found;
  comm.agreed([&] { found = PartOfLineSearch::find(h.search, upper); });
  end_call(h.mesh, found.stats.candidates.total());
  r.stats = found.stats;
  const double rounding = PartOfLineSearch::start(h.search).rounding;
  r.rounding = rounding;
  r.outcome = agreed_outcome(comm, found.outcome);
  reduce(comm, r.stats);
  const SceneLimits limits = reduce(comm, h.part, found.traversal.limits);
  const SceneShares shares = reduce(comm, h.part, found.least);
  if (r.outcome == Outcome::free) limit_step(limits, upper, r);
  if (const auto closest = put_shares(shares.least, r))
    r.closest = Pair{closest->first, closest->second.a, closest->second.b,
                     shares.vertices[std::size_t(closest->first)]};
  return r;
}

ClosePairs LineSearch::close_pairs(double step) const {
  const FloatEnvironment environment;
  const Impl& h = of(impl_);
  const Communicator& comm = h.mesh.comm;
  const auto check = [&] {
    check_step("step", step);
    if (h.options.d_hat == 0)
      throw std::invalid_argument("close_pairs of a line search that was given no d_hat");
  };
  begin_call(h.mesh, "close pairs of a line search", h.options, {step}, FunctionRef<>(check));
  ClosePairs r;
  r.d_hat = h.options.d_hat;
  r.outcome = h.status.first, r.vertex = h.status.second;
  if (r.outcome != Outcome::free) return r;
  comm.agreed([&] {
    static_cast<onset::ClosePairs&>(r) = h.search.close_pairs(step);
    r.owners = rename_all(h.part, r.pairs);
  });
  end_call(h.mesh, 0);
  r.outcome = agreed_outcome(comm, r.outcome);
  comm.maximum(&r.seconds, 1);
  if (r.outcome != Outcome::free) r.pairs.clear(), r.owners.clear();
  return r;
}

}  // namespace onset::mpi
