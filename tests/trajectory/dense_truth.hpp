// When a pair of primitives on rigid and linear paths meets first: by samples of the paths, far denser than
// anything happens on them, and bisection. Nothing of the library is used.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <onset/onset.hpp>
#include <optional>
#include <vector>

#include "tests/trajectory/exact_path.hpp"

namespace onset::tests {

using Long = long double;
template <class Scalar>
using VecIn = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using FourIn = std::array<VecIn<Scalar>, 4>;

// A scene whose vertices turn with bodies, or move linearly.
struct TurningPaths {
  Eigen::MatrixXd x_t0, x_t1;  // of those in no body
  std::vector<int> body;       // of each vertex; -1: none
  std::vector<RigidMotion> bodies;

  RigidTrajectory trajectory() const {
    RigidTrajectory r(x_t0, x_t1);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      std::vector<int> vertices;
      for (std::size_t v = 0; v < body.size(); ++v)
        if (body[v] == int(b)) vertices.push_back(int(v));
      r.add_body(vertices, bodies[b].rotation, bodies[b].translation, bodies[b].centre);
    }
    return r;
  }
  template <class Scalar>
  VecIn<Scalar> at(int v, Scalar t) const {
    using Vec = VecIn<Scalar>;
    const Vec p = x_t0.row(v).transpose().cast<Scalar>();
    const int b = body[std::size_t(v)];
    if (b < 0) return p + t * (Vec(x_t1.row(v).transpose().cast<Scalar>()) - p);
    const RigidMotion& m = bodies[std::size_t(b)];
    const Vec w = m.rotation.cast<Scalar>(), c = m.centre.cast<Scalar>();
    const Scalar angle = w.norm();
    Vec q = p - c;
    if (angle > 0) q = Eigen::AngleAxis<Scalar>(t * angle, w / angle) * q;
    return c + q + t * m.translation.cast<Scalar>();
  }
  template <class Scalar>
  FourIn<Scalar> at(const std::array<int, 4>& v, Scalar t) const {
    return {at(v[0], t), at(v[1], t), at(v[2], t), at(v[3], t)};
  }
};

template <class Scalar>
Scalar distance(const VecIn<Scalar>& p, const VecIn<Scalar>& a, const VecIn<Scalar>& b) {
  const VecIn<Scalar> e = b - a;
  const Scalar s =
      e.squaredNorm() > 0 ? std::clamp<Scalar>((p - a).dot(e) / e.squaredNorm(), 0, 1) : Scalar(0);
  return (p - a - s * e).norm();
}

template <class Scalar>
Scalar distance_to_face(const FourIn<Scalar>& x) {
  const Scalar least =
      std::min({distance(x[0], x[1], x[2]), distance(x[0], x[2], x[3]), distance(x[0], x[3], x[1])});
  const VecIn<Scalar> n = (x[2] - x[1]).cross(x[3] - x[1]);
  if (n.norm() == 0) return least;
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const VecIn<Scalar>&a = x[1 + i], &b = x[1 + (i + 1) % 3];
    inside = inside && (b - a).cross(x[0] - a).dot(n) >= 0;
  }
  return inside ? std::fabs((x[0] - x[1]).dot(n)) / n.norm() : least;
}

template <class Scalar>
Scalar distance_of_edges(const FourIn<Scalar>& x) {
  const Scalar least = std::min({distance(x[0], x[2], x[3]), distance(x[1], x[2], x[3]),
                                 distance(x[2], x[0], x[1]), distance(x[3], x[0], x[1])});
  const VecIn<Scalar> u = x[1] - x[0], v = x[3] - x[2], w = x[0] - x[2];
  const Scalar a = u.dot(u), b = u.dot(v), c = v.dot(v), d = u.dot(w), e = v.dot(w), det = a * c - b * b;
  if (det <= 0) return least;
  const Scalar s = (b * e - c * d) / det, t = (a * e - b * d) / det;
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  return std::min(least, VecIn<Scalar>(w + s * u - t * v).norm());
}

template <class Scalar>
Scalar distance(PairKind kind, const FourIn<Scalar>& x) {
  return kind == PairKind::vertex_face ? distance_to_face(x) : distance_of_edges(x);
}

template <class Scalar>
Scalar volume(PairKind kind, const FourIn<Scalar>& x) {
  if (kind == PairKind::vertex_face) return (x[0] - x[1]).dot((x[2] - x[1]).cross(x[3] - x[1]));
  return (x[0] - x[2]).dot((x[1] - x[0]).cross(x[3] - x[2]));
}

struct Truth {
  std::optional<Long> first;  // within 1e-12
  Long least = INFINITY;      // distance at any time
};

// Bisects [t0, t1] where `late` holds at t1 and not at t0.
template <class F>
Long bisect(Long t0, Long t1, F&& late) {
  for (int i = 0; i < 60; ++i) {
    const Long t = (t0 + t1) / 2;
    (late(t) ? t1 : t0) = t;
  }
  return t1;
}

// Returns where a function with one valley in [t0, t1] is least.
template <class F>
Long lowest(Long t0, Long t1, F&& f) {
  for (int i = 0; i < 80; ++i) {
    const Long a = t0 + (t1 - t0) / 3, b = t1 - (t1 - t0) / 3;
    if (f(a) < f(b))
      t1 = b;
    else
      t0 = a;
  }
  return (t0 + t1) / 2;
}

// With a separation, when the distance is no more first; without, when the volume changes its sign first at a
// distance of 0. Times between samples are looked at where the distance is least around a sample; a contact
// that hides even so is left out, none is made up.
inline Truth first_contact(const TurningPaths& paths, PairKind kind, const std::array<int, 4>& v,
                           double separation, int samples) {
  Truth r;
  std::vector<double> apart(std::size_t(samples) + 1), volumes(apart.size());
  double size = 0;
  for (int i = 0; i <= samples; ++i) {
    const FourIn<double> x = paths.at(v, double(i) / samples);
    for (const auto& y : x) size = std::max(size, y.norm());
    apart[std::size_t(i)] = distance(kind, x), volumes[std::size_t(i)] = volume(kind, x);
  }
  const auto gap = [&](Long t) { return distance(kind, paths.at(v, t)); };
  for (int i = 0; i <= samples; ++i) {
    const std::size_t k = std::size_t(i);
    const Long before = std::max<Long>(0, Long(i - 1) / samples), now = Long(i) / samples,
               after = std::min<Long>(1, Long(i + 1) / samples);
    r.least = std::min<Long>(r.least, apart[k]);
    const bool valley = (i == 0 || apart[k] <= apart[k - 1]) && (i == samples || apart[k] <= apart[k + 1]);
    if (valley && apart[k] < separation + 0.1 * size) {
      const Long t = lowest(before, after, gap), least = gap(t);
      r.least = std::min(r.least, least);
      if (!r.first && separation > 0 && least <= separation && gap(before) > separation)
        r.first = bisect(before, t, [&](Long s) { return gap(s) <= separation; });
    }
    if (r.first || i == 0) {
      if (!r.first && separation > 0 && apart[k] <= separation) r.first = 0;
      continue;
    }
    if (separation > 0) {
      if (apart[k] <= separation) r.first = bisect(before, now, [&](Long s) { return gap(s) <= separation; });
    } else if ((volumes[k] > 0) != (volumes[k - 1] > 0)) {
      const Long t =
          bisect(before, now, [&](Long s) { return (volume(kind, paths.at(v, s)) > 0) == (volumes[k] > 0); });
      if (gap(t) < 1e-14L * size) r.first = t, r.least = 0;
    }
  }
  return r;
}

}  // namespace onset::tests
