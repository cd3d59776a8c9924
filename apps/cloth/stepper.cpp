#include "cloth/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cloth {
namespace {

constexpr double kAccuracy = 0.02;  // of d-hat: the largest change at which Newton's method ends
constexpr int kMoves = 30;          // iterations that move vertices by hand, or turn a body, at most
constexpr double kKept = 0.9;       // share of the way to a contact that a body turns

Eigen::MatrixXi matrix(const std::vector<std::array<int, 3>>& faces) {
  Eigen::MatrixXi F(faces.size(), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    F.row(Eigen::Index(f)) << faces[f][0], faces[f][1], faces[f][2];
  return F;
}

std::vector<std::array<int, 3>> first(const std::vector<std::array<int, 3>>& faces, std::size_t count) {
  return {faces.begin(), faces.begin() + std::ptrdiff_t(count)};
}

// Ten weights of a vertex at half of d-hat, about, and a tenth of what a spring shortened by d-hat stores.
double barrier_stiffness(const Elastic& elastic, const Material& material, double d_hat) {
  const double mass = *std::max_element(elastic.masses().begin(), elastic.masses().end());
  return 10 * mass * 9.81 * d_hat + 0.1 * material.stretch * d_hat * d_hat;
}

onset::CollisionRules rules_of(const Scene& scene) {
  onset::CollisionRules rules;
  rules.planes = scene.planes;
  return rules;
}

}  // namespace

// What a time step minimizes.
struct Stepper::Goal {
  Vector inertial;  // where the vertices would go without forces inside
  Friction friction;
};

Stepper::Stepper(Scene scene, const Settings& settings, const std::optional<State>& start)
    : scene_(std::move(scene)),
      settings_(settings),
      cells_(scene_.faces),
      mesh_(scene_.x.size() / 3, matrix(scene_.faces), rules_of(scene_)),
      filter_(mesh_, scene_.x, settings.filter),
      elastic_(scene_.rest, first(scene_.faces, scene_.cloth_faces), settings.material),
      d_hat_(settings.reach * scene_.edge),
      barrier_(barrier_stiffness(elastic_, settings.material, d_hat_), d_hat_),
      state_(start.value_or(State{scene_.x, Vector::Zero(scene_.x.size()), 0, 0})),
      close_(filter_.close_pairs(state_.x, d_hat_)) {}

double Stepper::energy(const Goal& goal, const Vector& x, const onset::ClosePairs& close) const {
  const double h = settings_.time_step;
  double sum = elastic_.energy(x) + barrier_.energy(close) + goal.friction.energy(x);
  for (std::size_t v = 0; v < scene_.is_free.size(); ++v)
    if (scene_.is_free[v])
      sum += elastic_.masses()[v] / (2 * h * h) * (at(x, int(v)) - at(goal.inertial, int(v))).squaredNorm();
  return sum;
}

Vector Stepper::direction(const Goal& goal, const Vector& moved, StepReport& report) const {
  const double h = settings_.time_step;
  const Vector& x = state_.x;
  const Timer assembly;
  System system(scene_.is_free, moved);
  elastic_.add_derivatives(x, system);
  barrier_.add_derivatives(close_, scene_.planes, x, system);
  goal.friction.add_derivatives(x, system);
  for (std::size_t v = 0; v < scene_.is_free.size(); ++v) {
    const double m = elastic_.masses()[v] / (h * h);
    system.add_gradient(int(v), m * (at(x, int(v)) - at(goal.inertial, int(v))));
    system.add_block(int(v), int(v), m * Mat3::Identity());
  }
  report.seconds_assembly += assembly.seconds();
  const Timer solution;
  Vector dx = system.solve();
  report.seconds_solve += solution.seconds();
  return dx;
}

// One iteration of Newton's method; the result tells whether it changed nothing to speak of.
bool Stepper::iterate(const Goal& goal, const Vector& moved, bool descend, StepReport& report) {
  Vector& x = state_.x;
  const Vector dx = direction(goal, moved, report);
  const double before = descend ? energy(goal, x, close_) : INFINITY;
  const auto next = [&](const Trial& trial) {
    return trial.cut.empty() ? Vector(x + trial.step * dx)
                             : Vector(Eigen::Map<const Vector>(trial.cut.data(), x.size()));
  };
  Search found = search(filter_, x, dx, d_hat_, [&](const Trial& trial) {
    return descend && !(energy(goal, next(trial), trial.close) <= before);
  });
  report.add(found);
  if (found.step == 0 && found.limit > 0) return true;
  x = next(found);
  close_ = std::move(found.close);
  ++report.iterations;
  return dx.lpNorm<Eigen::Infinity>() < kAccuracy * d_hat_;
}

// How far the vertices of the body that turns have to go.
Vector Stepper::left_to_turn() const {
  const Vector& x = state_.x;
  Vector moved = Vector::Zero(x.size());
  const Turning& body = *scene_.turning;
  const double angle = body.rate.norm() * (time() - state_.turned_until);
  const Eigen::AngleAxisd rotation(angle, body.rate.normalized());
  for (int v = body.first; v < int(scene_.is_free.size()); ++v)
    moved.segment<3>(3 * v) = body.centre + rotation * (at(x, v) - body.centre) - at(x, v);
  return moved;
}

// Turns the body to where it should be, or as far as the cloth lets it, which goes along linearly.
void Stepper::turn(const Goal& goal, StepReport& report) {
  const Turning& body = *scene_.turning;
  Vector& x = state_.x;
  for (int i = 0; i < kMoves && state_.turned_until < time(); ++i) {
    const double left = time() - state_.turned_until;
    const Vector dx = direction(goal, left_to_turn(), report);
    const Timer collision;
    const std::ptrdiff_t count = x.size() / 3;
    const Vector x_t1 = x + dx;
    onset::RigidTrajectory motion({x.data(), count}, {x_t1.data(), count});
    motion.add_body(body.first, count, left * body.rate, Vec3::Zero(), body.centre);
    const onset::StepResult limit = onset::compute_collision_free_stepsize(mesh_, motion, filter_.options());
    if (limit.outcome != onset::Outcome::free && limit.outcome != onset::Outcome::contact)
      throw std::runtime_error(std::string("the turning body's step ended with ") +
                               onset::to_string(limit.outcome));
    Search found;
    found.contact = limit.outcome == onset::Outcome::contact;
    found.limit = found.contact ? std::max(kKept * limit.step, limit.shortest) : limit.step;
    const auto next = motion.at(found.limit);
    x = Eigen::Map<const Vector>(next.data(), x.size());
    close_ = filter_.close_pairs(x, d_hat_);
    found.seconds_collision = collision.seconds();
    report.add(found);
    state_.turned_until = found.contact ? state_.turned_until + found.limit * left : time();
    ++report.iterations;
  }
  report.behind = std::max(report.behind, left_to_turn().lpNorm<Eigen::Infinity>());
}

Vector Stepper::left_to_move() const {
  Vector moved = Vector::Zero(state_.x.size());
  if (!scene_.moved_to) return moved;
  for (int v = 0; v < int(scene_.is_free.size()); ++v)
    if (!scene_.is_free[std::size_t(v)])
      moved.segment<3>(3 * v) = scene_.moved_to(v, time()) - at(state_.x, v);
  return moved;
}

StepReport Stepper::step() {
  StepReport report;
  const Timer timer;
  const double h = settings_.time_step;
  const Vector start = state_.x;
  Goal goal{start + h * state_.velocity,
            Friction(settings_.friction, 1e-3 * h, barrier_, close_, scene_.planes, start)};
  for (std::size_t v = 0; v < scene_.is_free.size(); ++v)
    goal.inertial.segment<3>(3 * Eigen::Index(v)) += h * h * scene_.gravity;

  Vector moved = left_to_move();
  for (int i = 0; i < kMoves && moved.lpNorm<Eigen::Infinity>() > 1e-12; ++i, moved = left_to_move())
    iterate(goal, moved, false, report);
  report.behind = moved.lpNorm<Eigen::Infinity>();
  if (scene_.turning) turn(goal, report);
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
  close_ = filter_.close_pairs(state_.x, d_hat_);
  report.seconds_collision += collision.seconds();
  report.count(close_, d_hat_);
  report.energy = elastic_.energy(state_.x);
  double mass = 0, moment = 0;
  for (std::size_t v = 0; v < scene_.is_free.size(); ++v) {
    if (!scene_.is_free[v]) continue;
    const double m = elastic_.masses()[v];
    const Vec3 p = at(state_.x, int(v));
    mass += m, moment += m * p.z();
    report.energy += 0.5 * m * at(state_.velocity, int(v)).squaredNorm() - m * scene_.gravity.dot(p);
  }
  report.height = moment / mass;
}

}  // namespace cloth
