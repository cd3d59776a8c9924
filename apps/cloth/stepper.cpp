#include "cloth/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulation/search.hpp"

namespace cloth {
namespace {

constexpr double kReach = 0.1;      // d-hat, of an edge
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

Stepper::Stepper(Scene scene, const Settings& settings)
    : scene_(std::move(scene)),
      settings_(settings),
      mesh_(scene_.x.size() / 3, matrix(scene_.faces), rules_of(scene_)),
      elastic_(scene_.rest, first(scene_.faces, scene_.cloth_faces), settings.material),
      d_hat_(kReach * scene_.edge),
      barrier_(barrier_stiffness(elastic_, settings.material, d_hat_), d_hat_),
      x_(scene_.x),
      velocity_(Vector::Zero(x_.size())),
      close_(onset::close_pairs(mesh_, x_, d_hat_, settings.options)) {}

double Stepper::energy(const Goal& goal, const Vector& x, const onset::ClosePairs& close) const {
  const double h = settings_.time_step;
  double sum = elastic_.energy(x) + barrier_.energy(close) + goal.friction.energy(x);
  for (std::size_t v = 0; v < scene_.is_free.size(); ++v)
    if (scene_.is_free[v])
      sum += elastic_.masses()[v] / (2 * h * h) * (at(x, int(v)) - at(goal.inertial, int(v))).squaredNorm();
  return sum;
}

Vector Stepper::direction(const Goal& goal, const Vector& moved) const {
  const double h = settings_.time_step;
  System system(scene_.is_free, moved);
  elastic_.add_derivatives(x_, system);
  barrier_.add_derivatives(close_, scene_.planes, x_, system);
  goal.friction.add_derivatives(x_, system);
  for (std::size_t v = 0; v < scene_.is_free.size(); ++v) {
    const double m = elastic_.masses()[v] / (h * h);
    system.add_gradient(int(v), m * (at(x_, int(v)) - at(goal.inertial, int(v))));
    system.add_block(int(v), int(v), m * Mat3::Identity());
  }
  return system.solve();
}

// One iteration of Newton's method; the result tells whether it changed nothing to speak of.
bool Stepper::iterate(const Goal& goal, const Vector& moved, bool descend, StepReport& report) {
  const Vector dx = direction(goal, moved);
  const double before = descend ? energy(goal, x_, close_) : INFINITY;
  Search found =
      search(mesh_, x_, dx, d_hat_, settings_.options, [&](double step, const onset::ClosePairs& close) {
        return descend && !(energy(goal, x_ + step * dx, close) <= before);
      });
  report.smallest_step = std::min(report.smallest_step, found.limit);
  if (found.contact) report.toi = std::min(report.toi, found.limit);
  report.seconds_collision += found.seconds_collision;
  if (found.step == 0 && found.limit > 0) return true;
  x_ += found.step * dx;
  close_ = std::move(found.close);
  ++report.iterations;
  return dx.lpNorm<Eigen::Infinity>() < kAccuracy * d_hat_;
}

// How far the vertices of the body that turns have to go.
Vector Stepper::left_to_turn() const {
  Vector moved = Vector::Zero(x_.size());
  const Turning& body = *scene_.turning;
  const double angle = body.rate.norm() * (time_ - turned_until_);
  const Eigen::AngleAxisd rotation(angle, body.rate.normalized());
  for (int v = body.first; v < int(scene_.is_free.size()); ++v)
    moved.segment<3>(3 * v) = body.centre + rotation * (at(x_, v) - body.centre) - at(x_, v);
  return moved;
}

// Turns the body to where it should be, or as far as the cloth lets it, which goes along linearly.
void Stepper::turn(const Goal& goal, StepReport& report) {
  const Turning& body = *scene_.turning;
  for (int i = 0; i < kMoves && turned_until_ < time_; ++i) {
    const double left = time_ - turned_until_;
    const Vector dx = direction(goal, left_to_turn());
    Timer collision;
    const std::ptrdiff_t count = x_.size() / 3;
    const Vector x_t1 = x_ + dx;
    onset::RigidTrajectory motion({x_.data(), count}, {x_t1.data(), count});
    motion.add_body(body.first, count, left * body.rate, Vec3::Zero(), body.centre);
    const onset::StepResult limit = onset::compute_collision_free_stepsize(mesh_, motion, settings_.options);
    if (limit.outcome != onset::Outcome::free && limit.outcome != onset::Outcome::contact)
      throw std::runtime_error(std::string("the turning body's step ended with ") +
                               onset::to_string(limit.outcome));
    const bool cut = limit.outcome == onset::Outcome::contact;
    const double step = cut ? std::max(kKept * limit.step, limit.shortest) : limit.step;
    report.smallest_step = std::min(report.smallest_step, step);
    if (cut) report.toi = std::min(report.toi, limit.step);
    const auto next = motion.at(step);
    x_ = Eigen::Map<const Vector>(next.data(), x_.size());
    close_ = onset::close_pairs(mesh_, x_, d_hat_, settings_.options);
    report.seconds_collision += collision.seconds();
    turned_until_ = cut ? turned_until_ + step * left : time_;
    ++report.iterations;
  }
  report.behind = std::max(report.behind, left_to_turn().lpNorm<Eigen::Infinity>());
}

Vector Stepper::left_to_move() const {
  Vector moved = Vector::Zero(x_.size());
  if (!scene_.moved_to) return moved;
  for (int v = 0; v < int(scene_.is_free.size()); ++v)
    if (!scene_.is_free[std::size_t(v)]) moved.segment<3>(3 * v) = scene_.moved_to(v, time_) - at(x_, v);
  return moved;
}

StepReport Stepper::step() {
  StepReport report;
  const Timer timer;
  const double h = settings_.time_step;
  const Vector start = x_;
  time_ += h;
  Goal goal{x_ + h * velocity_, Friction(settings_.friction, 1e-3 * h, barrier_, close_, scene_.planes, x_)};
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

  velocity_ = (x_ - start) / h;
  report.contacts = close_.size();
  report.closest = d_hat_;
  for (const onset::ClosePair& p : close_) report.closest = std::min(report.closest, p.distance);
  report.seconds = timer.seconds();
  return report;
}

}  // namespace cloth
