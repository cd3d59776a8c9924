#include "onset/safe_distance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "onset/step_size.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_source.hpp"
#include "scene/planes.hpp"
#include "scene/primitive_filter.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/pair_list.hpp"
#include "src/start/places.hpp"

namespace onset {
namespace {

// columns: those of a mesh, or 0 where 3 will do as well as 2.
void check_rows(const char* name, const Positions& x, std::ptrdiff_t rows, int columns) {
  const bool fits = columns == 0 ? x.cols() == 3 || x.cols() == 2 : x.cols() == columns;
  if (!fits || x.rows() != rows)
    throw std::invalid_argument(std::string(name) + " has " + std::to_string(x.rows()) + " rows of " +
                                std::to_string(x.cols()) + " coordinates, not " + std::to_string(rows) +
                                " rows of " + std::to_string(columns == 2 ? 2 : 3));
}

void check_close(const Mesh& mesh, const ClosePairs& close) {
  if (close.outcome != Outcome::free)
    throw std::invalid_argument(std::string("the close pairs have the outcome ") + to_string(close.outcome));
  if (!(close.d_hat > 0)) throw std::invalid_argument("the close pairs have no d_hat");
  const auto is_of_mesh = [&](const ClosePair& p) {
    const MeshData& data = mesh.data();
    if (p.kind == PairKind::vertex_plane)
      return p.a >= 0 && p.a < mesh.num_vertices() && p.b >= 0 && std::size_t(p.b) < data.planes.size() &&
             p.vertices == pair_vertices(data, p.kind, {p.a, p.b});
    if (std::find(kStepKinds.begin(), kStepKinds.end(), p.kind) == kStepKinds.end() ||
        !has_kind(data, p.kind))
      return false;
    const std::ptrdiff_t a = std::ptrdiff_t(primitive_count(data, first_primitive(p.kind))),
                         b = std::ptrdiff_t(primitive_count(data, second_primitive(p.kind)));
    return p.a >= 0 && p.a < a && p.b >= 0 && p.b < b &&
           p.vertices == pair_vertices(mesh.data(), p.kind, {p.a, p.b});
  };
  for (std::size_t i = 0; i < close.size(); ++i)
    if (!is_of_mesh(close.pairs[i]))
      throw std::invalid_argument("close pair " + std::to_string(i) + " is not a pair of this mesh");
}

// Returns a little less than a / b, at least 0. 2^-1073 covers both roundings where the quotient is
// subnormal.
double below_quotient(double a, double b) {
  const double q = a / b * (1 - 0x1p-48);
  return std::max(0.0, q < 0x1p-1000 ? q - 0x1p-1073 : q);
}

double length(const Positions& dx, std::ptrdiff_t v) {
  return dx.cols() == 2 ? std::hypot(dx(v, 0), dx(v, 1)) : std::hypot(dx(v, 0), dx(v, 1), dx(v, 2));
}

// docs/theory.md, L49 proves the bound. kStoring (scene/motion/storing.hpp) times the largest coordinate, or
// d_hat if that is more, covers storing; 1 - 2^-48 covers relative errors and makes the bound strict; 2^-1072
// covers half of a subnormal gap.
std::vector<double> distances_by_gaps(const Positions& x, const ClosePairs& close) {
  std::vector<double> r(std::size_t(x.rows()), close.d_hat);
  for (const ClosePair& p : close)
    for (const int v : p.vertices)
      if (v >= 0) r[std::size_t(v)] = std::min(r[std::size_t(v)], p.gap);
  double largest = close.d_hat;
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (int a = 0; a < x.cols(); ++a) largest = std::max(largest, std::fabs(x(v, a)));
  const double rounding = kStoring * largest;  // for any order of operations
  for (double& of_vertex : r)
    of_vertex = std::max(0.0, (0.5 * of_vertex * (1 - 0x1p-48) - rounding) * (1 - 0x1p-52) - 0x1p-1072);
  return r;
}

// Returns the step that docs/theory.md, L49 gives without a look at any pair: distances fall by at most the
// rest of the gap that is not kept. dx is off by a rounding, which the factor in safe_step covers.
double step_by_gaps(const Positions& x_t0, const Positions& x_t1, const ClosePairs& close, double gap_share) {
  std::vector<double> dx;
  for (std::ptrdiff_t v = 0; v < x_t0.rows(); ++v)
    for (int a = 0; a < x_t0.cols(); ++a) dx.push_back(x_t1(v, a) - x_t0(v, a));
  std::vector<double> r = distances_by_gaps(x_t0, close);
  if (gap_share > 0)
    for (double& of_vertex : r)  // 2^-1074 covers a subnormal product
      of_vertex = std::max(0.0, of_vertex * ((1 - gap_share) * (1 - 0x1p-50)) - 0x1p-1074);
  return safe_step(r, Positions(dx.data(), x_t0.rows(), int(x_t0.cols())));
}

// Returns until when unlisted pairs are safe if they have `room`: they are beyond d_hat of their separation,
// and at s no vertex has moved by more than s `moved` (docs/theory.md, L49).
double time_for_others(double room, double moved) {
  return moved > 0 ? below_quotient(std::max(0.0, room), 2 * moved) : INFINITY;
}

double most_moved(const Motion& motion) {
  double moved = 0;
  for (int v = 0; v < motion.num_vertices; ++v) {
    const double *a = motion.t0(v), *b = motion.t1(v);
    moved = std::max(moved, std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
  }
  return moved;
}

// Returns, for a mesh that welds, the first vertex that is where another one is at the start, but not at the
// end; else -1. Pairs that count as one there are in no list of close pairs.
int torn_vertex(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1) {
  if (!mesh.data().weld) return -1;
  int first = -1;
  const Positions start = in_space(mesh.data(), "x_t0", x_t0);
  for (const std::vector<int>& here : shared_places(start))
    for (const int v : here)
      for (int a = 0; a < x_t1.cols(); ++a)
        if (x_t1(v, a) != x_t1(here[0], a) && (first < 0 || v < first)) first = v;
  return first;
}

}  // namespace

std::vector<double> safe_distances(const Mesh& mesh, const Positions& x, const ClosePairs& close) {
  const FloatEnvironment environment;
  check_rows("x", x, mesh.num_vertices(), mesh.dimension());
  check_close(mesh, close);
  return distances_by_gaps(x, close);
}

double safe_step(const std::vector<double>& r, const Positions& dx) {
  const FloatEnvironment environment;
  check_rows("dx", dx, std::ptrdiff_t(r.size()), 0);
  double step = 1;
  for (std::ptrdiff_t v = 0; v < dx.rows(); ++v) {
    const double moved = length(dx, v);
    const double may = r[std::size_t(v)];
    if (!std::isfinite(moved) || !(may >= 0)) return 0;
    if (moved > may) step = std::min(step, below_quotient(may, moved));
  }
  return step;
}

StepResult compute_cfl_stepsize(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                const ClosePairs& close, const Options& options, double gap_share) {
  const FloatEnvironment environment;
  check(options);
  check_gap_share(gap_share);
  StepResult r;
  in_arena(options.threads, [&] {
    const Clock clock;
    Budget budget(options);
    check_close(mesh, close);
    const Motion motion = make_motion(mesh.data(), x_t0, x_t1);
    PairList listed;
    for (const ClosePair& p : close)
      if (p.kind == PairKind::vertex_plane ? may_meet_plane(mesh.data(), p.a, p.b)
                                           : may_meet(mesh.data(), p.kind, p.a, p.b))
        listed.of(p.kind).push_back({p.a, p.b});
    const double moved = most_moved(motion), rounding = rounding_of_distances(motion);
    const double bound = time_for_others((1 - gap_share) * close.d_hat - 2 * rounding, moved);
    r = step_of_pairs(mesh, motion, listed, options, gap_share, budget, std::min(bound, 1.0));
    if (motion.status != Outcome::free) return;
    if (const int torn = torn_vertex(mesh, x_t0, x_t1); torn >= 0) {
      r.step = r.shortest = r.toi = 0;
      r.outcome = Outcome::initial_contact;
      r.limiting.reset();
      r.vertex = torn;
    } else if (budget.outcome() != Outcome::free) {
      r.step = step_by_gaps(x_t0, x_t1, close, gap_share);
      if (r.step == 1) r.outcome = Outcome::free;
      r.toi = r.step == 1 ? INFINITY : r.step;
    } else {
      if (const double contact = time_for_others(close.d_hat - rounding, moved); contact < 1)
        r.toi = std::min(r.toi, contact);
    }
    r.stats.seconds_total = clock.seconds();
  });
  return r;
}

}  // namespace onset
