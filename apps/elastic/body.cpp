#include "elastic/body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace elastic {
namespace {

using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// The gradient of det F.
Mat3 cofactor(const Mat3& F) {
  Mat3 C;
  C << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
  return C;
}

}  // namespace

// Of Smith et al., section 3.4: mu and lambda as they must be for the logarithm to leave Hooke's law.
NeoHookean::NeoHookean(const Material& m) {
  const double mu = m.young / (2 * (1 + m.poisson)),
               lambda = m.young * m.poisson / ((1 + m.poisson) * (1 - 2 * m.poisson));
  mu_ = 4.0 / 3 * mu;
  lambda_ = lambda + 5.0 / 6 * mu;
  alpha_ = 1 + 0.75 * mu_ / lambda_;
}

double NeoHookean::energy(const Mat3& F) const {
  const double squared = F.squaredNorm(), swell = F.determinant() - alpha_;
  return 0.5 * (mu_ * (squared - 3 - std::log(squared + 1)) + lambda_ * swell * swell);
}

Mat3 NeoHookean::stress(const Mat3& F) const {
  return mu_ * (1 - 1 / (F.squaredNorm() + 1)) * F + lambda_ * (F.determinant() - alpha_) * cofactor(F);
}

Mat9 NeoHookean::stiffness(const Mat3& F) const {
  const double below = F.squaredNorm() + 1;
  const Mat3 C = cofactor(F);
  const Vec9 f = Eigen::Map<const Vec9>(F.data()), c = Eigen::Map<const Vec9>(C.data());
  Mat9 curl = Mat9::Zero();  // the Hessian of det F
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    curl.block<3, 3>(3 * j, 3 * k) = -skew(F.col(i));
    curl.block<3, 3>(3 * k, 3 * j) = skew(F.col(i));
  }
  return mu_ * (1 - 1 / below) * Mat9::Identity() + 2 * mu_ / (below * below) * f * f.transpose() +
         lambda_ * c * c.transpose() + lambda_ * (F.determinant() - alpha_) * curl;
}

Bodies::Bodies(const Vector& rest, const std::vector<Tetrahedron>& tetrahedra,
               const std::vector<char>& is_free, const Material& material)
    : material_(material), mass_(std::size_t(rest.size() / 3), 0) {
  for (std::size_t row = 0; row < tetrahedra.size(); ++row) {
    const Tetrahedron& t = tetrahedra[row];
    Mat3 edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = at(rest, t[std::size_t(i + 1)]) - at(rest, t[0]);
    const double volume = std::fabs(edges.determinant()) / 6;
    if (!(volume > 0)) throw std::invalid_argument("tetrahedron " + std::to_string(row) + " has no volume");
    for (const int v : t) mass_[std::size_t(v)] += material.density * volume / 4;
    if (std::any_of(t.begin(), t.end(), [&](int v) { return is_free[std::size_t(v)] != 0; }))
      elements_.push_back({t, edges.inverse(), volume});
  }
}

Mat3 Bodies::deformation(const Element& e, const Vector& x) const {
  Mat3 edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = at(x, e.vertices[std::size_t(i + 1)]) - at(x, e.vertices[0]);
  return edges * e.inverse;
}

double Bodies::energy(const Vector& x) const {
  double sum = 0;
  for (const Element& e : elements_) sum += e.volume * material_.energy(deformation(e, x));
  return sum;
}

double Bodies::least_volume(const Vector& x) const {
  double least = INFINITY;
  for (const Element& e : elements_) least = std::min(least, deformation(e, x).determinant());
  return least;
}

void Bodies::add_derivatives(const Vector& x, System& system) const {
  for (const Element& e : elements_) {
    const Mat3 F = deformation(e, x);
    Eigen::Matrix<double, 4, 3> shapes;  // of each vertex the gradient of its shape function
    shapes.bottomRows<3>() = e.inverse;
    shapes.row(0) = -e.inverse.colwise().sum();
    const Mat3 P = e.volume * material_.stress(F);
    const Eigen::SelfAdjointEigenSolver<Mat9> eigen(material_.stiffness(F));
    const Mat9 K = e.volume * eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                   eigen.eigenvectors().transpose();
    for (int i = 0; i < 4; ++i) {
      const int v = e.vertices[std::size_t(i)];
      system.add_gradient(v, P * shapes.row(i).transpose());
      for (int j = 0; j < 4; ++j) {
        Mat3 block = Mat3::Zero();
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) block += shapes(i, a) * shapes(j, b) * K.block<3, 3>(3 * a, 3 * b);
        system.add_block(v, e.vertices[std::size_t(j)], block);
      }
    }
  }
}

}  // namespace elastic
