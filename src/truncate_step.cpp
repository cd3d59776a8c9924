#include "onset/truncate_step.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "narrowphase/distance/precise_differences.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/close_set.hpp"
#include "src/shared/found_pairs.hpp"
#include "src/shared/rest/rest_limits.hpp"
#include "src/shared/step_setup.hpp"
#include "src/truncate/cut_motion.hpp"

namespace onset {
namespace {

// The same for axes in another order, and without overflow.
double length(const double (&d)[3]) {
  double m[3] = {std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])};
  std::sort(m, m + 3);
  const double scale = inverse_unit(m[2]);
  for (double& x : m) x *= scale;
  return std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) / scale;
}

// The motion that d_hat leaves of each vertex: the nearer ends, and the shares. Vertices that go together
// have one share: of a rigid body, and copies of its vertices elsewhere.
struct Ball {
  std::vector<double> ends, share;

  Ball(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1, double d_hat, const Stop& stop)
      : share(std::size_t(x_t0.rows()), 1.0) {
    for (std::ptrdiff_t v = 0; v < x_t0.rows(); ++v)
      share[std::size_t(v)] = share_of(mesh, x_t0, x_t1, v, d_hat);
    // Without rigid bodies, what goes together goes as far.
    if (!mesh.rigid.empty() && is_finite(x_t0)) share_alike(VertexGroups(mesh, x_t0, x_t1, stop));
    for (std::size_t v = 0; v < share.size(); ++v) {
      const double s = share[v];
      for (int a = 0; a < 3; ++a) {
        const double from = x_t0(std::ptrdiff_t(v), a), to = x_t1(std::ptrdiff_t(v), a);
        ends.push_back(s < 1 ? from + s * (to - from) : to);
      }
    }
  }

 private:
  static bool is_finite(const Positions& x) {
    for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
      for (int a = 0; a < 3; ++a)
        if (!std::isfinite(x(v, a))) return false;
    return true;
  }
  void share_alike(const VertexGroups& groups) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
      double least = 1;
      for (const int* v = groups.begin(g); v != groups.end(g); ++v)
        least = std::min(least, share[std::size_t(*v)]);
      for (const int* v = groups.begin(g); v != groups.end(g); ++v) share[std::size_t(*v)] = least;
    }
  }
  // 1 for what is not usable, or static and moves: that is for the motion to name.
  static double share_of(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1, std::ptrdiff_t v,
                         double d_hat) {
    if (!mesh.is_static.empty() && mesh.is_static[std::size_t(v)]) return 1;
    const double radius = 0.5 * d_hat;
    double dx[3];
    for (int a = 0; a < 3; ++a) {
      if (!(std::fabs(x_t1(v, a)) <= kMaxCoordinate)) return 1;
      dx[a] = x_t1(v, a) - x_t0(v, a);
    }
    const double way = length(dx);
    return way > radius && way < INFINITY ? radius / way * (1 - 0x1p-50) : 1;
  }
};

class Truncation {
 public:
  Truncation(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const TruncateOptions& options,
             TruncatedStep& result)
      : mesh_(mesh), x_t0_(x_t0), x_t1_(x_t1), options_(options), r_(result), budget_(options) {}

  void run() {
    const bool shaped = x_t0_.cols() == 3 && x_t1_.cols() == 3 && x_t0_.rows() == mesh_.num_vertices() &&
                        x_t1_.rows() == mesh_.num_vertices();
    std::optional<Ball> ball;
    if (options_.d_hat && shaped) ball.emplace(mesh_.data(), x_t0_, x_t1_, *options_.d_hat, budget_.stop());
    const Positions ends = ball ? Positions(ball->ends.data(), x_t0_.rows()) : x_t1_;
    std::vector<double> start_in_plane, ends_in_plane;
    const StepSetup setup(mesh_, of_mesh(x_t0_, start_in_plane), of_mesh(ends, ends_in_plane), options_,
                          StepSetup::Use::candidates, r_.stats, budget_);
    r_.outcome = setup.motion.status;
    r_.vertex = setup.motion.bad_vertex;
    stay();
    if (r_.outcome == Outcome::free && setup.broad) move(setup);
    if (r_.outcome == Outcome::free) r_.outcome = budget_.outcome();
    if (r_.outcome != Outcome::free) stay();
    if (r_.outcome == Outcome::free) conclude(ball ? &ball->share : nullptr);
    r_.stats.seconds_total = setup.clock.seconds();
  }

 private:
  // Positions as the mesh has them: in the plane those of two columns, which `kept` holds.
  Positions of_mesh(const Positions& x, std::vector<double>& kept) const {
    if (mesh_.dimension() == 3) return x;
    for (std::ptrdiff_t v = 0; v < x.rows(); ++v) kept.insert(kept.end(), {x(v, 0), x(v, 1)});
    return {kept.data(), x.rows(), 2};
  }
  void stay() {
    const std::size_t count = std::size_t(mesh_.num_vertices());
    r_.positions.clear();
    for (std::ptrdiff_t v = 0; v < mesh_.num_vertices(); ++v)
      for (int a = 0; a < 3; ++a) r_.positions.push_back(x_t0_(v, a));
    r_.displacements.assign(3 * count, 0.0);
    r_.share.assign(count, 0.0);
    r_.limited_by.assign(count, -1);
    r_.kept = 0;
  }

  // Leaves rows of `limits_` in limited_by.
  void move(const StepSetup& setup) {
    const auto rest = rest_limits(mesh_.data(), options_, budget_);
    if (budget_.spent()) return;
    auto found = find_limits(mesh_, setup.motion, *setup.broad, options_, rest.get(), budget_);
    const PlaneLimits planes(mesh_.data(), setup.motion, options_);
    const auto most = std::size_t(options_.memory_limit / std::int64_t(sizeof(MotionLimit)));
    if (budget_.outcome() == Outcome::free) planes.add(most, budget_, found);
    if (found.too_many) r_.outcome = Outcome::out_of_memory;
    if (found.too_many || budget_.spent()) return;
    limits_ = std::move(found.found);
    const VertexGroups groups(mesh_.data(), setup.motion, x_t0_, budget_.stop());
    if (budget_.spent()) return;
    const LimitsOfGroups of_groups(groups, limits_, budget_.stop());
    if (budget_.spent()) return;
    constexpr std::size_t kGrain = 256;
    parallel_ranges(groups.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (; first < last; ++first) {
        if (first % 16 == 0 && budget_.spent()) return;
        const Cut cut =
            cut_group(setup.motion, limits_, planes, of_groups.begin(first), of_groups.end(first));
        for (const int* v = groups.begin(first); v != groups.end(first); ++v) put(setup.motion, *v, cut);
      }
    });
  }

  void put(const Motion& motion, int v, const Cut& cut) {
    const StoredVertex at = moved(motion, v, cut.share);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t place = 3 * std::size_t(v) + std::size_t(motion.axes[i]);
      if (cut.share > 0) r_.positions[place] = at.position[i], r_.displacements[place] = at.displacement[i];
    }
    r_.share[std::size_t(v)] = cut.share;
    r_.limited_by[std::size_t(v)] = cut.limit;
  }

  void conclude(const std::vector<double>* of_ball) {
    if (of_ball != nullptr)
      for (std::size_t v = 0; v < r_.share.size(); ++v) r_.share[v] *= (*of_ball)[v];
    r_.kept = share_of_all();
    int least = -1;  // vertex
    std::vector<int> row(limits_.size(), -1);
    for (std::size_t v = 0; v < r_.share.size(); ++v) {
      if (r_.limited_by[v] < 0) continue;
      row[std::size_t(r_.limited_by[v])] = 0;
      if (least < 0 || r_.share[v] < r_.share[std::size_t(least)]) least = int(v);
    }
    if (least >= 0) end(Outcome::contact, limits_[std::size_t(r_.limited_by[std::size_t(least)])].pair);
    name_first(Outcome::below_rounding, [](const MotionLimit& l) { return !l.has_plane; });
    name_first(Outcome::initial_contact, [](const MotionLimit& l) { return l.touches; });
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      if (row[i] < 0) continue;
      row[i] = int(r_.pairs.size());
      r_.pairs.push_back(limits_[i].pair);
      ++count_of(limits_[i].pair.kind, r_.stats.contacts);
    }
    for (int& by : r_.limited_by)
      if (by >= 0) by = row[std::size_t(by)];
  }
  void end(Outcome outcome, const Pair& pair) { r_.outcome = outcome, r_.limiting = pair; }
  template <class Is>
  void name_first(Outcome outcome, Is&& is) {
    const auto first = std::find_if(limits_.begin(), limits_.end(), is);
    if (first != limits_.end()) end(outcome, first->pair);
  }

  double share_of_all() const {
    double longest = 0, all = 0, kept = 0;
    const auto way = [&](std::ptrdiff_t v) {
      const double dx[3] = {x_t1_(v, 0) - x_t0_(v, 0), x_t1_(v, 1) - x_t0_(v, 1), x_t1_(v, 2) - x_t0_(v, 2)};
      return length(dx);
    };
    for (std::ptrdiff_t v = 0; v < x_t0_.rows(); ++v) longest = std::max(longest, way(v));
    const double scale = inverse_unit(longest);
    for (std::ptrdiff_t v = 0; v < x_t0_.rows(); ++v) {
      const double part = way(v) * scale;
      all += part, kept += r_.share[std::size_t(v)] * part;
    }
    return all > 0 ? std::min(1.0, kept / all) : 1;
  }

  const Mesh& mesh_;
  const Positions &x_t0_, &x_t1_;
  const TruncateOptions& options_;
  TruncatedStep& r_;
  Budget budget_;
  std::vector<MotionLimit> limits_;
};

void drop_z(std::vector<double>& x) {
  for (std::size_t v = 0; 3 * v < x.size(); ++v) x[2 * v] = x[3 * v], x[2 * v + 1] = x[3 * v + 1];
  x.resize(x.size() / 3 * 2);
}

}  // namespace

TruncatedStep truncate_step(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                            const TruncateOptions& options) {
  check(options);
  check_gap_share(options.gap_share);
  if (options.d_hat) check_d_hat(*options.d_hat, false);
  TruncatedStep r;
  const int columns = mesh.dimension();
  if (columns == 3) {
    in_arena(options.threads, [&] { Truncation(mesh, x_t0, x_t1, options, r).run(); });
    return r;
  }
  const Positions at_t0 = in_space(mesh.data(), "x_t0", x_t0), at_t1 = in_space(mesh.data(), "x_t1", x_t1);
  in_arena(options.threads, [&] { Truncation(mesh, at_t0, at_t1, options, r).run(); });
  drop_z(r.positions), drop_z(r.displacements);
  return r;
}

}  // namespace onset
