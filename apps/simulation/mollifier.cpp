// The barrier of two edges that are nearly parallel.
#include <Eigen/Geometry>
#include <cmath>

#include "simulation/contact.hpp"

namespace simulation {
namespace {

using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

struct Derivatives {
  double value;
  Vec12 gradient;
  Mat12 hessian;
};

Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// |a x b|^2 = |a|^2 |b|^2 - (a . b)^2, with a = x1 - x0 and b = x3 - x2.
Derivatives squared_cross(const Vec3& a, const Vec3& b) {
  const double aa = a.dot(a), bb = b.dot(b), ab = a.dot(b);
  Eigen::Matrix<double, 6, 1> g;
  g << 2 * (bb * a - ab * b), 2 * (aa * b - ab * a);
  Eigen::Matrix<double, 6, 6> H;
  const Mat3 one = Mat3::Identity(), mixed = 4 * a * b.transpose() - 2 * b * a.transpose() - 2 * ab * one;
  H << 2 * bb * one - 2 * b * b.transpose(), mixed, mixed.transpose(), 2 * aa * one - 2 * a * a.transpose();
  Eigen::Matrix<double, 6, 12> J = Eigen::Matrix<double, 6, 12>::Zero();
  for (int i = 0; i < 2; ++i) {
    J.block<3, 3>(3 * i, 6 * i) = -one;
    J.block<3, 3>(3 * i, 6 * i + 3) = one;
  }
  return {(skew(a) * b).squaredNorm(), J.transpose() * g, J.transpose() * H * J};
}

// The distance squared, f(x, s) = |p|^2 at the s that makes it least, where s are the parameters of the edges
// whose closest point is no end: f_xx - f_xs f_ss^-1 f_sx.
Derivatives squared_distance(const std::array<double, 4>& weights, const Vec3& a, const Vec3& b,
                             const Vec3& p) {
  Eigen::Matrix<double, 3, 12> W, Wa = Eigen::Matrix<double, 3, 12>::Zero(), Wb = Wa;  // p = W x
  for (int i = 0; i < 4; ++i) W.block<3, 3>(0, 3 * i) = weights[std::size_t(i)] * Mat3::Identity();
  Wa.block<3, 3>(0, 0) = -Mat3::Identity(), Wa.block<3, 3>(0, 3) = Mat3::Identity();
  Wb.block<3, 3>(0, 6) = Mat3::Identity(), Wb.block<3, 3>(0, 9) = -Mat3::Identity();
  Derivatives d{p.squaredNorm(), 2 * W.transpose() * p, 2 * W.transpose() * W};
  const bool in_a = weights[0] != 0 && weights[1] != 0, in_b = weights[2] != 0 && weights[3] != 0;
  Eigen::Matrix<double, 12, 2> mixed;
  mixed.col(0) = 2 * (Wa.transpose() * p + W.transpose() * a);
  mixed.col(1) = 2 * (Wb.transpose() * p - W.transpose() * b);
  Eigen::Matrix2d second;
  second << 2 * a.dot(a), -2 * a.dot(b), -2 * a.dot(b), 2 * b.dot(b);
  if (in_a && in_b)
    d.hessian -= mixed * second.inverse() * mixed.transpose();
  else if (in_a)
    d.hessian -= mixed.col(0) * mixed.col(0).transpose() / second(0, 0);
  else if (in_b)
    d.hessian -= mixed.col(1) * mixed.col(1).transpose() / second(1, 1);
  return d;
}

}  // namespace

double Barrier::threshold(const onset::ClosePair& p) const {
  const Vec3 a = at(rest_, p.vertices[1]) - at(rest_, p.vertices[0]),
             b = at(rest_, p.vertices[3]) - at(rest_, p.vertices[2]);
  return 1e-3 * a.squaredNorm() * b.squaredNorm();
}

bool Barrier::is_mollified(const onset::ClosePair& p, const Vector& x) const {
  if (rest_.size() == 0 || p.kind != onset::PairKind::edge_edge) return false;
  const Vec3 a = at(x, p.vertices[1]) - at(x, p.vertices[0]), b = at(x, p.vertices[3]) - at(x, p.vertices[2]);
  return a.cross(b).squaredNorm() < threshold(p);
}

Barrier::Slopes Barrier::slopes(double squared) const {
  const double D = d_hat_ * d_hat_, s = squared / D;
  if (!(s < 1)) return {0, 0, 0};
  return {-kappa_ * (s - 1) * (s - 1) * std::log(s),
          -kappa_ * (2 * (s - 1) * std::log(s) + (s - 1) * (s - 1) / s) / D,
          -kappa_ * (2 * std::log(s) + 4 * (s - 1) / s - (s - 1) * (s - 1) / (s * s)) / (D * D)};
}

Barrier::Mollified Barrier::mollified(const onset::ClosePair& pair, const Vector& x) const {
  const Vec3 a = at(x, pair.vertices[1]) - at(x, pair.vertices[0]),
             b = at(x, pair.vertices[3]) - at(x, pair.vertices[2]);
  const double e = threshold(pair);
  const Derivatives c = squared_cross(a, b),
                    d = squared_distance(pair.weights, a, b, between(pair.vertices, pair.weights, x));
  const Slopes barrier = slopes(d.value);
  const double m = (2 - c.value / e) * c.value / e, first = 2 * (1 - c.value / e) / e, second = -2 / (e * e);
  const Mat12 both = c.gradient * d.gradient.transpose();
  return {m * barrier.value, first * barrier.value * c.gradient + m * barrier.first * d.gradient,
          barrier.value * (second * c.gradient * c.gradient.transpose() + first * c.hessian) +
              first * barrier.first * (both + both.transpose()) +
              m * (barrier.second * d.gradient * d.gradient.transpose() + barrier.first * d.hessian)};
}

}  // namespace simulation
