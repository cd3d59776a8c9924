#include "tests/soak/cloth.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/oracle/edge_face.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/soak/process.hpp"

namespace onset::tests {
namespace {

constexpr double kDHat = 0.02;
constexpr int kUpper = 9, kLower = 6;  // vertices a side

Eigen::RowVector3d noise(scenes::Random& random, double size) {
  const Point p = scenes::point(random, size);
  return {p[0], p[1], p[2]};
}

}  // namespace

const char* name(Asked asked) {
  constexpr const char* kNames[] = {"step",       "line search", "listed step",   "cfl step", "close pairs",
                                    "active set", "free",        "intersections", "check"};
  return kNames[int(asked)];
}

template <class F>
auto Cloth::ask(Asked asked, const F& f) {
  const double before = cpu_seconds();
  auto answer = f();
  timed_(asked, cpu_seconds() - before);
  return answer;
}

Cloth::Cloth(std::uint64_t seed, const Timed& timed) : random_(seed), timed_(timed) {
  const scenes::Scene both = scenes::joined(
      scenes::translated(scenes::cloth(kUpper, kUpper), {0.02, 0.03, 0.1}), scenes::cloth(kLower, kLower));
  rest_ = x_ = both.x_t0;
  faces_ = both.faces;
  CollisionRules rules;
  for (int v = 0; v < x_.rows(); ++v) rules.bodies.push_back(v < kUpper * kUpper ? 0 : 1);
  Mesh made(x_, faces_, rules);
  mesh_ = made;  // a copy, that is changed on its own
  change_rules({});
}

// The lower sheet lies still, or its corners, or nothing does; what is too close to have a thickness has
// none.
void Cloth::change_rules(const ClosePairs& close) {
  CollisionRules rules = mesh_.rules();
  rules.static_vertices.assign(std::size_t(x_.rows()), false);
  const int held = scenes::integer(random_, 0, 2), first = kUpper * kUpper;
  for (int v = first; v < x_.rows(); ++v) {
    const int row = (v - first) / kLower, col = (v - first) % kLower;
    const bool corner = (row == 0 || row == kLower - 1) && (col == 0 || col == kLower - 1);
    rules.static_vertices[std::size_t(v)] = held == 2 || (held == 1 && corner);
  }
  double least = kDHat;
  for (const ClosePair& p : close) least = std::min(least, p.distance);
  rules.thickness.clear();
  if (scenes::coin(random_)) rules.thickness.assign(std::size_t(x_.rows()), 0.1 * least);
  rules.groups.assign(std::size_t(x_.rows()), 1), rules.masks.assign(std::size_t(x_.rows()), 3);
  mesh_.set_rules(rules);
}

// Half of the time towards a point, half of the time back to the sheets at rest, with waves and noise; pairs
// that are close are pushed apart.
Eigen::MatrixXd Cloth::direction(const ClosePairs& close) {
  const bool folds = at_ % kLife < kLife / 2;
  const Eigen::RowVector3d centre{0.5, 0.5, 0.05};
  Eigen::MatrixXd dx(x_.rows(), 3);
  for (int v = 0; v < x_.rows(); ++v) {
    const Eigen::RowVector3d x = x_.row(v), goal = folds ? centre : Eigen::RowVector3d(rest_.row(v));
    const Eigen::RowVector3d wave{std::sin(9 * x[1] + 0.3 * at_), std::sin(7 * x[2] + 0.2 * at_),
                                  std::sin(8 * x[0] + 0.1 * at_)};
    dx.row(v) = 0.04 * (goal - x) + 0.02 * wave + noise(random_, 0.01);
  }
  for (const ClosePair& p : close) {
    Eigen::RowVector3d apart = Eigen::RowVector3d::Zero();
    for (std::size_t i = 0; i < 4; ++i) apart += p.weights[i] * x_.row(p.vertices[i]);
    const double length = apart.norm();
    if (!(length > 0)) continue;
    for (std::size_t i = 0; i < 4; ++i)
      dx.row(p.vertices[i]) += (0.5 * kDHat / length) * p.weights[i] * apart;
  }
  const std::vector<bool>& still = mesh_.rules().static_vertices;
  for (int v = 0; v < x_.rows(); ++v)
    if (still[std::size_t(v)]) dx.row(v).setZero();
  return dx;
}

// By another call each time.
double Cloth::safe_step(const Eigen::MatrixXd& x_t1, const Eigen::MatrixXd& dx, const ClosePairs& close,
                        const Options& options, Answer& answer) {
  StepResult r;
  switch (at_ % 4) {
    case 0:
      r = ask(Asked::step, [&] { return compute_collision_free_stepsize(mesh_, x_, x_t1, options); });
      break;
    case 1:
      r = ask(Asked::line_search, [&] {
        LineSearchOptions search = options;
        search.d_hat = kDHat;
        LineSearch made(mesh_, x_, dx, search);
        const LineSearch line = std::move(made);
        const LineSearchStep step = line.largest_step();
        answer.add(line.close_pairs(0.5 * step.step), step);
        return step;
      });
      break;
    case 2:
      r = ask(Asked::listed_step, [&] {
        return compute_collision_free_stepsize(mesh_, compute_candidates(mesh_, x_, x_t1, options), x_, x_t1,
                                               options, 0.1);
      });
      break;
    default:
      r = ask(Asked::cfl_step, [&] { return compute_cfl_stepsize(mesh_, x_, x_t1, close, options); });
  }
  answer.add(r);
  tally_.limited += r.step < 1;
  return r.step;
}

// Calls that say more of the step, less often.
void Cloth::look(const Eigen::MatrixXd& x_t1, const Options& options, Answer& answer) {
  if (at_ % 5 == 2) {
    const ActiveSet set =
        ask(Asked::active_set, [&] { return construct_active_set(mesh_, x_, x_t1, options); });
    answer.add(set, assemble_constraints(set, 1e-3));
    tally_.contacts += std::int64_t(set.size());
  }
  if (at_ % 5 == 3)
    answer.add(ask(Asked::free, [&] { return is_step_collision_free(mesh_, x_, x_t1, options); }));
  if (at_ % 10 == 7) answer.add(ask(Asked::check, [&] { return check(mesh_, x_, options); }));
  if (at_ % 40 == 39) mesh_.release_memory();
}

void Cloth::step(int threads, Answer& answer) {
  Options options;
  options.threads = threads;
  options.progress = [](double) { return true; };
  const ClosePairs close = ask(Asked::close_pairs, [&] { return close_pairs(mesh_, x_, kDHat, options); });
  answer.add(close);
  tally_.close_pairs += std::int64_t(close.size());
  if (at_ % 20 == 19) change_rules(close);
  const Eigen::MatrixXd dx = direction(close), x_t1 = x_ + dx;
  // Rules that have changed have other close pairs.
  const double s =
      safe_step(x_t1, dx, at_ % 20 == 19 ? close_pairs(mesh_, x_, kDHat, options) : close, options, answer);
  look(x_t1, options, answer);
  x_ += at_ % 4 == 1 ? Eigen::MatrixXd(s * dx) : Eigen::MatrixXd(s * (x_t1 - x_));
  const Intersections found = ask(Asked::intersections, [&] { return intersections(mesh_, x_, options); });
  answer.add(found, x_);
  tally_.intersecting += !found.empty();
  ++tally_.steps, tally_.moved += s > 0;
  ++at_;
}

int Cloth::exact_intersections() const {
  using Rational = oracle::Rational;
  const auto at = [&](int v) {
    return oracle::Vector<Rational>{Rational(x_(v, 0)), Rational(x_(v, 1)), Rational(x_(v, 2))};
  };
  const auto apart = [&](const std::array<int, 2>& e, const Eigen::RowVector3i& f) {
    for (int a = 0; a < 3; ++a) {
      const auto edge = std::minmax(x_(e[0], a), x_(e[1], a));
      const auto face = std::minmax({x_(f[0], a), x_(f[1], a), x_(f[2], a)});
      if (edge.second < face.first || face.second < edge.first) return true;
    }
    return false;
  };
  std::set<std::array<int, 2>> edges;
  for (int f = 0; f < faces_.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({faces_(f, k), faces_(f, (k + 1) % 3)});
      edges.insert({low, high});
    }
  int count = 0;
  for (const auto& e : edges)
    for (int f = 0; f < faces_.rows(); ++f) {
      const Eigen::RowVector3i face = faces_.row(f);
      if ((face.array() == e[0]).any() || (face.array() == e[1]).any() || apart(e, face)) continue;
      count += oracle::edge_face<Rational>({at(e[0]), at(e[1])}, {at(face[0]), at(face[1]), at(face[2])})
                   .has_value();
    }
  return count;
}

}  // namespace onset::tests
