#include "cloth/elastic.hpp"

#include <algorithm>
#include <map>

namespace cloth {
namespace {

double cotangent(const Vec3& apex, const Vec3& p, const Vec3& q) {
  const Vec3 a = p - apex, b = q - apex;
  return a.dot(b) / a.cross(b).norm();
}

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a).norm() / 2; }

}  // namespace

Elastic::Elastic(const Vector& rest, const std::vector<std::array<int, 3>>& faces, const Material& material)
    : stretch_(material.stretch), mass_(std::size_t(rest.size() / 3), 0) {
  std::map<std::pair<int, int>, std::vector<int>> opposite;  // of each edge
  for (const auto& f : faces)
    for (int i = 0; i < 3; ++i) {
      const int a = f[std::size_t(i)], b = f[std::size_t((i + 1) % 3)], c = f[std::size_t((i + 2) % 3)];
      opposite[std::minmax(a, b)].push_back(c);
      mass_[std::size_t(a)] += material.density * area(at(rest, a), at(rest, b), at(rest, c)) / 3;
    }
  for (const auto& [edge, ends] : opposite) {
    springs_.push_back({edge.first, edge.second, (at(rest, edge.first) - at(rest, edge.second)).norm()});
    if (ends.size() == 2) add_hinge(rest, edge.first, edge.second, ends[0], ends[1], material.bending);
  }
}

void Elastic::add_hinge(const Vector& rest, int a, int b, int c, int d, double bending) {
  const Vec3 p = at(rest, a), q = at(rest, b), r = at(rest, c), s = at(rest, d);
  const double pr = cotangent(p, q, r), ps = cotangent(p, q, s), qr = cotangent(q, p, r),
               qs = cotangent(q, p, s);
  hinges_.push_back(
      {{a, b, c, d}, {qr + qs, pr + ps, -pr - qr, -ps - qs}, bending * 3 / (area(p, q, r) + area(p, q, s))});
}

double Elastic::energy(const Vector& x) const {
  double sum = 0;
  for (const Spring& s : springs_) {
    const double stretched = (at(x, s.a) - at(x, s.b)).norm() - s.length;
    sum += 0.5 * stretch_ * stretched * stretched;
  }
  for (const Hinge& h : hinges_) {
    Vec3 bent = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) bent += h.weights[i] * at(x, h.vertices[i]);
    sum += 0.5 * h.stiffness * bent.squaredNorm();
  }
  return sum;
}

void Elastic::add_derivatives(const Vector& x, System& system) const {
  for (const Spring& s : springs_) {
    const Vec3 d = at(x, s.a) - at(x, s.b);
    const double l = d.norm();
    const Mat3 along = d * d.transpose() / (l * l);
    // Across its direction a compressed spring pushes outward: that negative part is left out.
    const Mat3 block = stretch_ * (along + std::max(0.0, 1 - s.length / l) * (Mat3::Identity() - along));
    const Vec3 force = stretch_ * (1 - s.length / l) * d;
    system.add_gradient(s.a, force), system.add_gradient(s.b, -force);
    system.add_block(s.a, s.a, block), system.add_block(s.b, s.b, block);
    system.add_block(s.a, s.b, -block), system.add_block(s.b, s.a, -block);
  }
  for (const Hinge& h : hinges_) {
    Vec3 bent = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) bent += h.weights[i] * at(x, h.vertices[i]);
    for (std::size_t i = 0; i < 4; ++i) {
      system.add_gradient(h.vertices[i], h.stiffness * h.weights[i] * bent);
      for (std::size_t j = 0; j < 4; ++j)
        system.add_block(h.vertices[i], h.vertices[j],
                         h.stiffness * h.weights[i] * h.weights[j] * Mat3::Identity());
    }
  }
}

}  // namespace cloth
