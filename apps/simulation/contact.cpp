#include "simulation/contact.hpp"

#include <cmath>

namespace simulation {
namespace {

// The direction from the second to the first: of a plane its normal, of others that of `w`.
Vec3 direction(const onset::ClosePair& p, const std::vector<onset::Plane>& planes, const Vec3& w) {
  if (p.kind != onset::PairKind::vertex_plane) return w.normalized();
  const auto& n = planes[std::size_t(p.b)].normal;
  return {n[0], n[1], n[2]};
}

// gradient = slope n weights_i, Hessian block = curvature weights_i weights_j.
void add_pair(const std::array<int, 4>& vertices, const std::array<double, 4>& weights, const Vec3& gradient,
              const Mat3& curvature, System& system) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (weights[i] == 0) continue;
    system.add_gradient(vertices[i], weights[i] * gradient);
    for (std::size_t j = 0; j < 4; ++j)
      if (weights[j] != 0) system.add_block(vertices[i], vertices[j], weights[i] * weights[j] * curvature);
  }
}

// Negative curvatures become 0.
void add_projected(const Barrier::Mollified& m, const std::array<int, 4>& vertices, System& system) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>> eigen(m.hessian);
  const Eigen::Matrix<double, 12, 12> H =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
  for (int i = 0; i < 4; ++i) {
    system.add_gradient(vertices[std::size_t(i)], m.gradient.segment<3>(3 * i));
    for (int j = 0; j < 4; ++j)
      system.add_block(vertices[std::size_t(i)], vertices[std::size_t(j)], H.block<3, 3>(3 * i, 3 * j));
  }
}

}  // namespace

Vec3 between(const std::array<int, 4>& vertices, const std::array<double, 4>& weights, const Vector& x) {
  Vec3 w = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    if (weights[i] != 0) w += weights[i] * at(x, vertices[i]);
  return w;
}

double Barrier::energy(const onset::ClosePairs& close) const {
  double sum = 0;
  for (const onset::ClosePair& p : close) {
    const double s = p.distance * p.distance / (d_hat_ * d_hat_);
    if (s < 1) sum -= kappa_ * (s - 1) * (s - 1) * std::log(s);
  }
  return sum;
}

double Barrier::energy(const onset::ClosePairs& close, const Vector& x) const {
  double sum = 0;
  for (const onset::ClosePair& p : close) {
    const double s = p.distance * p.distance / (d_hat_ * d_hat_);
    if (!(s < 1)) continue;
    sum += is_mollified(p, x) ? mollified(p, x).energy : -kappa_ * (s - 1) * (s - 1) * std::log(s);
  }
  return sum;
}

double Barrier::force(double d) const {
  const double s = d * d / (d_hat_ * d_hat_);
  return s < 1 ? kappa_ * (2 * (s - 1) * std::log(s) + (s - 1) * (s - 1) / s) * 2 * d / (d_hat_ * d_hat_) : 0;
}

// As a function of the distance the barrier is convex; the curvature of the distance itself, which it
// multiplies with a negative slope, is left out: what remains is positive semidefinite.
void Barrier::add_derivatives(const onset::ClosePairs& close, const std::vector<onset::Plane>& planes,
                              const Vector& x, System& system) const {
  const double D = d_hat_ * d_hat_;
  for (const onset::ClosePair& p : close) {
    const Vec3 w = between(p.vertices, p.weights, x);
    const double d = p.kind == onset::PairKind::vertex_plane ? p.distance : w.norm(), s = d * d / D;
    if (!(s < 1)) continue;
    if (is_mollified(p, x)) {
      add_projected(mollified(p, x), p.vertices, system);
      continue;
    }
    const Vec3 n = direction(p, planes, w);
    const double slope = -(2 * (s - 1) * std::log(s) + (s - 1) * (s - 1) / s);               // db / ds
    const double bend = -(2 * std::log(s) + 4 * (s - 1) / s - (s - 1) * (s - 1) / (s * s));  // d2b / ds2
    const double second = kappa_ * (bend * 4 * d * d / (D * D) + slope * 2 / D);             // d2 / dd2
    add_pair(p.vertices, p.weights, -force(d) * n, std::max(second, 0.0) * n * n.transpose(), system);
  }
}

Friction::Friction(double coefficient, double slip, const Barrier& barrier, const onset::ClosePairs& close,
                   const std::vector<onset::Plane>& planes, const Vector& x)
    : slip_(slip) {
  if (coefficient == 0) return;
  for (const onset::ClosePair& p : close) {
    const Vec3 w = between(p.vertices, p.weights, x);
    const double limit = coefficient * barrier.force(p.distance);
    if (limit > 0) contacts_.push_back({p.vertices, p.weights, direction(p, planes, w), w, limit});
  }
}

Vec3 Friction::slid(const Contact& c, const Vector& x) const {
  const Vec3 u = between(c.vertices, c.weights, x) - c.start;
  return u - c.normal.dot(u) * c.normal;
}

double Friction::energy(const Vector& x) const {
  double sum = 0;
  for (const Contact& c : contacts_) {
    const double y = slid(c, x).norm();
    sum += c.limit * (y < slip_ ? y * y / slip_ * (1 - y / (3 * slip_)) + slip_ / 3 : y);
  }
  return sum;
}

// The slope over the length falls with the length, so slope / length times the projection bounds the Hessian.
void Friction::add_derivatives(const Vector& x, System& system) const {
  for (const Contact& c : contacts_) {
    const Vec3 u = slid(c, x);
    const double y = u.norm(), ratio = c.limit * (y < slip_ ? (2 - y / slip_) / slip_ : 1 / y);
    add_pair(c.vertices, c.weights, ratio * u, ratio * (Mat3::Identity() - c.normal * c.normal.transpose()),
             system);
  }
}

}  // namespace simulation
