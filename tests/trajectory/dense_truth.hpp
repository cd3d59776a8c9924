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
using LongVec = Eigen::Matrix<Long, 3, 1>;

// A scene whose vertices turn with bodies, or move linearly.
struct TurningPaths {
  Eigen::MatrixXd x_t0, x_t1;      // of those in no body
  std::vector<int> body;           // of each vertex; -1: none
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
  LongVec at(int v, Long t) const {
    const LongVec p = x_t0.row(v).transpose().cast<Long>();
    const int b = body[std::size_t(v)];
    if (b < 0) return p + t * (x_t1.row(v).transpose().cast<Long>() - p);
    const RigidMotion& m = bodies[std::size_t(b)];
    const LongVec w = m.rotation.cast<Long>(), c = m.centre.cast<Long>();
    const Long angle = w.norm();
    LongVec q = p - c;
    if (angle > 0) q = Eigen::AngleAxis<Long>(t * angle, w / angle) * q;
    return c + q + t * m.translation.cast<Long>();
  }
  std::array<LongVec, 4> at(const std::array<int, 4>& v, Long t) const {
    return {at(v[0], t), at(v[1], t), at(v[2], t), at(v[3], t)};
  }
};

inline Long distance(const LongVec& p, const LongVec& a, const LongVec& b) {
  const LongVec e = b - a;
  const Long s = e.squaredNorm() > 0 ? std::clamp<Long>((p - a).dot(e) / e.squaredNorm(), 0, 1) : 0;
  return (p - a - s * e).norm();
}

inline Long distance(PairKind kind, const std::array<LongVec, 4>& x) {
  if (kind == PairKind::vertex_face) {
    Long least = std::min({distance(x[0], x[1], x[2]), distance(x[0], x[2], x[3]), distance(x[0], x[3], x[1])});
    const LongVec n = (x[2] - x[1]).cross(x[3] - x[1]);
    if (n.norm() == 0) return least;
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const LongVec &a = x[std::size_t(1 + i)], &b = x[std::size_t(1 + (i + 1) % 3)];
      inside = inside && (b - a).cross(x[0] - a).dot(n) >= 0;
    }
    return inside ? std::fabs((x[0] - x[1]).dot(n)) / n.norm() : least;
  }
  Long least = std::min({distance(x[0], x[2], x[3]), distance(x[1], x[2], x[3]), distance(x[2], x[0], x[1]),
                         distance(x[3], x[0], x[1])});
  const LongVec u = x[1] - x[0], v = x[3] - x[2], w = x[0] - x[2];
  const Long a = u.dot(u), b = u.dot(v), c = v.dot(v), d = u.dot(w), e = v.dot(w), det = a * c - b * b;
  if (det <= 0) return least;
  const Long s = (b * e - c * d) / det, t = (a * e - b * d) / det;
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  return std::min(least, (w + s * u - t * v).norm());
}

inline Long volume(PairKind kind, const std::array<LongVec, 4>& x) {
  if (kind == PairKind::vertex_face) return (x[0] - x[1]).dot((x[2] - x[1]).cross(x[3] - x[1]));
  return (x[0] - x[2]).dot((x[1] - x[0]).cross(x[3] - x[2]));
}

struct Truth {
  std::optional<Long> first;  // within 1e-12
  Long least = INFINITY;      // distance at any sample
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

// With a separation, when the distance is no more first; without, when the volume changes its sign first at a
// distance of 0. Contacts shorter than 1 / samples of the step may be left out, none is made up.
inline Truth first_contact(const TurningPaths& paths, PairKind kind, const std::array<int, 4>& v,
                           double separation, int samples) {
  Truth r;
  Long size = 0;
  Long before = volume(kind, paths.at(v, 0));
  for (int i = 0; i <= samples; ++i) {
    const Long t0 = Long(i - 1) / samples, t1 = Long(i) / samples;
    const auto x = paths.at(v, t1);
    for (const LongVec& y : x) size = std::max(size, y.norm());
    r.least = std::min(r.least, distance(kind, x));
    if (separation > 0) {
      if (distance(kind, x) > separation || r.first) continue;
      r.first = i == 0 ? Long(0) : bisect(t0, t1, [&](Long t) {
        return distance(kind, paths.at(v, t)) <= separation;
      });
      continue;
    }
    const Long now = volume(kind, x);
    if (i > 0 && !r.first && (now > 0) != (before > 0)) {
      const Long t = bisect(t0, t1, [&](Long at) { return (volume(kind, paths.at(v, at)) > 0) == (now > 0); });
      if (distance(kind, paths.at(v, t)) < 1e-14L * size) r.first = t, r.least = 0;
    }
    before = now;
  }
  return r;
}

}  // namespace onset::tests
