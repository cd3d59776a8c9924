#include "elastic/active_constraints.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

#include "elastic/quadratic_program.hpp"
#include "simulation/timer.hpp"

namespace elastic {
namespace {

constexpr int kRounds = 12;         // in which contacts are added to one direction
constexpr double kAccuracy = 1e-6;  // of eta, that rows may be violated by
constexpr double kSoftness = 1e-3;  // of eta: what rows that contradict each other give way for the largest
                                    // force of the direction without them

// Full ids of the surface's vertices.
std::vector<int> full_ids(const onset::Mesh& surface) {
  std::vector<int> ids(std::size_t(surface.num_vertices()));
  for (std::size_t v = 0; v < ids.size(); ++v) ids[v] = surface.full_vertex(std::ptrdiff_t(v));
  return ids;
}

std::vector<double> on_surface(const onset::Mesh& surface, const Vector& x) {
  return surface.surface_positions(onset::Positions(x.data(), x.size() / 3));
}

void append(onset::Constraints& to, const onset::Constraints& more) {
  const int first = int(to.rows());
  for (const int r : more.row) to.row.push_back(first + r);
  to.dof.insert(to.dof.end(), more.dof.begin(), more.dof.end());
  to.value.insert(to.value.end(), more.value.begin(), more.value.end());
  to.bound.insert(to.bound.end(), more.bound.begin(), more.bound.end());
}

Multipliers::key_type key(const onset::Pair& p) { return {p.kind, p.a, p.b}; }

// The free part of a direction.
Vector of_free(const System& system, const Vector& dx) {
  Vector part(system.rhs().size());
  for (int v = 0; v < int(dx.size() / 3); ++v)
    if (system.row(v) >= 0) part.segment<3>(system.row(v)) = at(dx, v);
  return part;
}

// A x of each row.
Vector product(const onset::Constraints& rows, const Vector& x) {
  Vector sum = Vector::Zero(rows.rows());
  for (std::size_t k = 0; k < rows.value.size(); ++k) sum[rows.row[k]] += rows.value[k] * x[rows.dof[k]];
  return sum;
}

// The rows for the free part of a direction from x, along which the others move by `moved`.
QuadraticProgram program_of(const System& system, const onset::Constraints& rows, const Vector& x,
                            const Vector& moved) {
  QuadraticProgram program{system.lower(),
                           system.rhs(),
                           {rows.rows(), system.rhs().size()},
                           Eigen::Map<const Vector>(rows.bound.data(), rows.rows()) - product(rows, x),
                           {},
                           {}};
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < rows.value.size(); ++k) {
    const int first = system.row(rows.dof[k] / 3);
    if (first >= 0)
      entries.emplace_back(rows.row[k], first + rows.dof[k] % 3, rows.value[k]);
    else
      program.bound[rows.row[k]] -= rows.value[k] * moved[rows.dof[k]];
  }
  program.A.setFromTriplets(entries.begin(), entries.end());
  return program;
}

}  // namespace

double ConstrainedDirection::violation(const Vector& x) const {
  const Vector Ax = product(rows, x);
  double sum = 0;
  for (Eigen::Index r = 0; r < Ax.size(); ++r) sum += std::max(0.0, rows.bound[std::size_t(r)] - Ax[r]);
  return sum;
}

ConstrainedDirection constrained_direction(const System& system, const onset::Mesh& surface, const Vector& x,
                                           double eta, const onset::Options& options, Multipliers& latest) {
  onset::Options within = options;
  within.min_separation = eta;
  const std::vector<int> full = full_ids(surface);
  const std::vector<double> start = on_surface(surface, x);
  const Vector moved = system.of_all(Vector::Zero(system.rhs().size()));
  std::set<Multipliers::key_type> known;
  ConstrainedDirection found;
  found.dx = system.solve();
  const double penalty = (system.rhs().lpNorm<Eigen::Infinity>() + 1) / (kSoftness * eta);
  for (int round = 0;; ++round) {
    const Timer collision;
    const std::vector<double> end = on_surface(surface, x + found.dx);
    const onset::ActiveSet set = onset::construct_active_set(surface, {start.data(), surface.num_vertices()},
                                                             {end.data(), surface.num_vertices()}, within);
    found.seconds_collision += collision.seconds();
    if (set.outcome != onset::Outcome::free && set.outcome != onset::Outcome::contact)
      throw std::runtime_error(std::string("the active set ended with ") + onset::to_string(set.outcome));
    onset::ActiveSet added = set;
    added.contacts.clear();
    for (const onset::Contact& c : set)
      if (known.insert(key(c)).second) added.contacts.push_back(c);
    found.complete = added.empty();
    if (found.complete || round == kRounds) return found;
    append(found.rows, onset::assemble_constraints(added, eta, full));
    for (onset::Contact c : added) {
      c.vertices = surface.full_vertices(c);
      found.contacts.push_back(c);
    }
    QuadraticProgram program = program_of(system, found.rows, x, moved);
    program.x_guess = of_free(system, found.dx);
    program.multipliers_guess = Vector::Zero(found.rows.rows());
    for (std::size_t i = 0; i < found.contacts.size(); ++i)
      program.multipliers_guess[Eigen::Index(i)] = latest[key(found.contacts[i])];
    const QuadraticSolution solution = solve(program, kAccuracy * eta, penalty);
    for (std::size_t i = 0; i < found.contacts.size(); ++i)
      latest[key(found.contacts[i])] = solution.multipliers[Eigen::Index(i)];
    found.dx = system.of_all(solution.x);
    found.multipliers = solution.multipliers;
    found.feasible = solution.feasible;
    ++found.programs;
  }
}

}  // namespace elastic
