#include "elastic/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace elastic {
namespace {

constexpr double kAccuracy = 0.02;  // of the separation: the largest change at which Newton's method ends
constexpr int kMoves = 30;          // iterations that move vertices by hand, at most

std::vector<std::array<int, 3>> full_faces(const onset::Mesh& surface) {
  std::vector<std::array<int, 3>> faces;
  for (std::ptrdiff_t f = 0; f < surface.num_faces(); ++f) {
    std::array<int, 3> face = surface.face(f);
    for (int& v : face) v = surface.full_vertex(v);
    faces.push_back(face);
  }
  return faces;
}

onset::Mesh make_surface(const Scene& scene) {
  Eigen::MatrixXi T(scene.tetrahedra.size(), 4);
  for (std::size_t t = 0; t < scene.tetrahedra.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i) T(Eigen::Index(t), Eigen::Index(i)) = scene.tetrahedra[t][i];
  const onset::TetrahedraSurface surface =
      onset::surface_of_tetrahedra(T, onset::Positions(scene.rest.data(), scene.rest.size() / 3));
  onset::CollisionRules rules;
  rules.planes = scene.planes;
  for (const int v : surface.full_vertices)
    rules.static_vertices.push_back(scene.is_static[std::size_t(v)] != 0);
  return surface.mesh(rules);
}

// A hundred weights of the heaviest vertex at half of d-hat, about, and what an element shortened by d-hat
// stores.
double barrier_stiffness(const Bodies& bodies, const Scene& scene, const Settings& settings, double d_hat) {
  double mass = 0;
  for (std::size_t v = 0; v < scene.vertices(); ++v)
    if (scene.is_free[v]) mass = std::max(mass, bodies.masses()[v]);
  return 100 * mass * 9.81 * d_hat + 0.5 * settings.material.young * scene.edge * d_hat * d_hat;
}

}  // namespace

// What a time step minimizes.
struct Stepper::Goal {
  Vector start, inertial;  // inertial: where the vertices would go without forces inside
  Friction friction;
  bool has_friction;  // false: it still has to be made from the forces of the first constraints
  Multipliers multipliers;
};

Stepper::Stepper(Scene scene, const Settings& settings, const std::optional<State>& start)
    : scene_(std::move(scene)),
      settings_(settings),
      bodies_(scene_.rest, scene_.tetrahedra, scene_.is_free, settings.material),
      cells_(scene_.tetrahedra),
      surface_(make_surface(scene_)),
      filter_(surface_, on_surface(scene_.x), settings.filter),
      faces_(full_faces(surface_)),
      d_hat_(2 * settings.separation),
      barrier_(barrier_stiffness(bodies_, scene_, settings, d_hat_), d_hat_, scene_.rest),
      state_(start.value_or(State{scene_.x, Vector::Zero(scene_.x.size()), 0, 0})) {
  const Vector x = on_surface(state_.x);
  if (onset::has_intersections(surface_, x, filter_.options()))
    throw std::invalid_argument("the start intersects itself");
  close_ = close_pairs(filter_.close_pairs(x, d_hat_));
}

Vector Stepper::on_surface(const Vector& x) const {
  const std::vector<double> part = surface_.surface_positions(onset::Positions(x.data(), x.size() / 3));
  return Eigen::Map<const Vector>(part.data(), Eigen::Index(part.size()));
}

onset::ClosePairs Stepper::close_pairs(onset::ClosePairs of_surface) const {
  for (onset::ClosePair& p : of_surface.pairs) p.vertices = surface_.full_vertices(p);
  return of_surface;
}

double Stepper::energy(const Goal& goal, const Vector& x, const onset::ClosePairs& close) const {
  const double h = settings_.time_step;
  double sum = bodies_.energy(x) + goal.friction.energy(x);
  if (has_barrier()) sum += barrier_.energy(close, x);
  for (std::size_t v = 0; v < scene_.vertices(); ++v)
    if (scene_.is_free[v])
      sum += bodies_.masses()[v] / (2 * h * h) * (at(x, int(v)) - at(goal.inertial, int(v))).squaredNorm();
  return sum;
}

System Stepper::system(const Goal& goal, const Vector& moved) const {
  const double h = settings_.time_step;
  System system(scene_.is_free, moved);
  bodies_.add_derivatives(state_.x, system);
  if (has_barrier()) barrier_.add_derivatives(close_, scene_.planes, state_.x, system);
  goal.friction.add_derivatives(state_.x, system);
  for (std::size_t v = 0; v < scene_.vertices(); ++v) {
    const double m = bodies_.masses()[v] / (h * h);
    system.add_gradient(int(v), m * (at(state_.x, int(v)) - at(goal.inertial, int(v))));
    system.add_block(int(v), int(v), m * Mat3::Identity());
  }
  return system;
}

ConstrainedDirection Stepper::direction(Goal& goal, const Vector& moved, StepReport& report) const {
  const Timer assembly;
  const System newton = system(goal, moved);
  report.seconds_assembly += assembly.seconds();
  const Timer solve;
  ConstrainedDirection found;
  if (has_barrier())
    found.dx = newton.solve();
  else
    found = constrained_direction(newton, surface_, state_.x, settings_.separation, filter_.options(),
                                  goal.multipliers);
  report.seconds_solve += solve.seconds() - found.seconds_collision;
  report.seconds_collision += found.seconds_collision;
  report.constraints->rows = std::max(report.constraints->rows, found.contacts.size());
  report.constraints->programs += found.programs;
  report.constraints->softened += !found.feasible || !found.complete;
  return found;
}

// One iteration of Newton's method; the result tells whether it changed nothing to speak of.
bool Stepper::iterate(Goal& goal, const Vector& moved, bool descend, StepReport& report) {
  Vector& x = state_.x;
  const ConstrainedDirection found = direction(goal, moved, report);
  // A step may raise the energy where it mends rows: each is worth more than its force (an exact penalty).
  const double worth = found.contacts.empty() ? 0 : 2 * found.multipliers.maxCoeff();
  const double before = descend ? energy(goal, x, close_) + worth * found.violation(x) : INFINITY;
  const Vector from = on_surface(x), along = on_surface(found.dx);
  const auto next = [&](const Trial& trial) {
    Vector there = x + trial.step * found.dx;
    for (std::size_t i = 0; i < trial.cut.size(); ++i)
      there[3 * surface_.full_vertex(std::ptrdiff_t(i / 3)) + Eigen::Index(i % 3)] = trial.cut[i];
    return there;
  };
  const Search taken = search(filter_, from, along, d_hat_, [&](const Trial& trial) {
    if (!descend) return false;
    const Vector there = next(trial);
    const double after = energy(goal, there, has_barrier() ? close_pairs(trial.close) : trial.close);
    return !(after + worth * found.violation(there) <= before);
  });
  report.add(taken);
  if (taken.step == 0 && taken.limit > 0) return true;
  x = next(taken);
  close_ = close_pairs(taken.close);
  ++report.iterations;
  const bool had_friction = goal.has_friction;
  if (!had_friction && descend) {
    std::vector<Friction::Contact> contacts;
    for (std::size_t i = 0; i < found.contacts.size(); ++i) {
      const onset::Contact& c = found.contacts[i];
      const double limit = settings_.friction * found.multipliers[Eigen::Index(i)];
      if (limit > 0)
        contacts.push_back({c.vertices,
                            c.weights,
                            {c.normal[0], c.normal[1], c.normal[2]},
                            between(c.vertices, c.weights, goal.start),
                            limit});
    }
    goal.friction = Friction(1e-3 * settings_.time_step, std::move(contacts));
    goal.has_friction = true;
  }
  return had_friction && found.dx.lpNorm<Eigen::Infinity>() < kAccuracy * settings_.separation;
}

Vector Stepper::left_to_move(double time) const {
  Vector moved = Vector::Zero(state_.x.size());
  if (!scene_.moved_to) return moved;
  for (std::size_t v = 0; v < scene_.vertices(); ++v)
    if (!scene_.is_free[v] && !scene_.is_static[v])
      moved.segment<3>(3 * Eigen::Index(v)) = scene_.moved_to(int(v), time) - at(state_.x, int(v));
  return moved;
}

StepReport Stepper::step() {
  StepReport report;
  report.constraints.emplace();
  const Timer timer;
  const double h = settings_.time_step, time = (state_.step + 1) * h;
  const Vector start = state_.x;
  const bool lagged = has_barrier() || settings_.friction == 0;
  Goal goal{start,
            start + h * state_.velocity,
            lagged && has_barrier()
                ? Friction(settings_.friction, 1e-3 * h, barrier_, close_, scene_.planes, start)
                : Friction(1e-3 * h, {}),
            lagged,
            {}};
  for (std::size_t v = 0; v < scene_.vertices(); ++v)
    goal.inertial.segment<3>(3 * Eigen::Index(v)) += h * h * scene_.gravity;

  Vector moved = left_to_move(time);
  for (int i = 0; i < kMoves && moved.lpNorm<Eigen::Infinity>() > 1e-12; ++i, moved = left_to_move(time))
    iterate(goal, moved, false, report);
  report.behind = moved.lpNorm<Eigen::Infinity>();
  moved.setZero();
  for (int i = 0; i < settings_.iterations && !report.converged; ++i)
    report.converged = iterate(goal, moved, true, report);

  finish(start, report);
  report.seconds += timer.seconds();
  return report;
}

// The next step begins with what a frame holds of this one: the pairs are found anew.
void Stepper::finish(const Vector& before, StepReport& report) {
  state_.velocity = (state_.x - before) / settings_.time_step;
  report.step = ++state_.step;
  const Timer collision;
  close_ = close_pairs(filter_.close_pairs(on_surface(state_.x), d_hat_));
  report.seconds_collision += collision.seconds();
  report.count(close_, d_hat_);
  report.least_volume = bodies_.least_volume(state_.x);
  report.energy = bodies_.energy(state_.x);
  double mass = 0, moment = 0;
  for (std::size_t v = 0; v < scene_.vertices(); ++v) {
    if (!scene_.is_free[v]) continue;
    const double m = bodies_.masses()[v];
    const Vec3 p = at(state_.x, int(v));
    mass += m, moment += m * p.z();
    report.energy += 0.5 * m * at(state_.velocity, int(v)).squaredNorm() - m * scene_.gravity.dot(p);
  }
  report.height = moment / mass;
}

}  // namespace elastic
