// Pairs within noise of touching at the start (narrowphase/initial.cpp): what is plainly pressed on has no
// direction that parts it.
#include <algorithm>
#include <cmath>

#include "narrowphase/exact/orientation.hpp"
#include "narrowphase/initial.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/kernel/kernel_batch.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

Point random_point(Random& random, double size) {
  return {scenes::uniform(random, -size, size), scenes::uniform(random, -size, size),
          scenes::uniform(random, -size, size)};
}
Point mixed(const Point& a, const Point& b, double t) {
  return scenes::plus(scenes::times(1 - t, a), scenes::times(t, b));
}

// The first primitive reaches into the second or near its border, up to rounding, and all move by up to
// `far`.
Query touching_query(PairKind kind, double far, Random& random) {
  Query q{kind, {}, {}};
  for (Point& p : q.t0) p = random_point(random, 1);
  const auto share = [&] {
    return scenes::coin(random) ? scenes::unit(random) : scenes::power_of_ten(random, -9, 0);
  };
  if (kind == PairKind::vertex_face) {
    q.t0[0] = mixed(mixed(q.t0[1], q.t0[2], share()), q.t0[3], share());
  } else {
    const Point touched = mixed(q.t0[2], q.t0[3], share());
    const double t = std::max(share(), 1e-3);
    q.t0[1] = scenes::plus(q.t0[0], scenes::times(1 / t, scenes::plus(touched, scenes::times(-1, q.t0[0]))));
  }
  for (std::size_t i = 0; i < 4; ++i) q.t1[i] = scenes::plus(q.t0[i], random_point(random, far));
  return q;
}

struct Pressed {
  Query query;
  KernelBatch batch;
  KernelPairs pairs;
  Motion motion;
  Corners corners;
  explicit Pressed(const Query& q) : query(q), batch(q.kind) {
    const PairKind kind = q.kind;
    batch.add(query, 0);
    pairs = batch.pairs(1e-6);
    motion.num_vertices = 4;
    motion.x = AlignedArray<double>(4 * kMotionStride);
    std::copy_n(pairs.x, 4 * kMotionStride, motion.x.data());
    corners = make_corners(kind, motion, pairs.vertices[0]);
  }
};

double least(const Corners& corners, double t, const Vec& n) {
  double at[4][3], r = INFINITY;
  corners.at(t, at);
  for (int k = 0; k < corners.count; ++k) r = std::min(r, dot(n, vec(at[k])));
  return r;
}

// Near the plane's normal or anywhere.
Vec some_direction(const Vec& normal, Random& random) {
  const Point away = random_point(random, 1);
  const double by = scenes::integer(random, 0, 3) ? scenes::power_of_ten(random, -17, 0) : 1e3;
  const double turned = scenes::coin(random) ? 1 : -1;
  return unit(turned * normal + by * Vec{{away[0], away[1], away[2]}});
}

}  // namespace

TEST_CASE("what is plainly pressed on has no direction that parts it", "[property]") {
  Random random(85);
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    int plain = 0, near = 0;
    for (int i = 0; i < fuzz(3000); ++i) {
      const Pressed pair(touching_query(kind, scenes::power_of_ten(random, -9, 1), random));
      const std::function<Vec(double)> none = [](double) { return Vec{}; };
      const InitialCase asked{pair.corners, pair.pairs, 0, kind, 0, none, nullptr};
      const double noise = 16 * kU * pair.corners.rho;
      const Vec normal = unit(cross(vec(pair.corners.e[0][0]), vec(pair.corners.e[0][1])));
      near += std::fabs(least(pair.corners, 0, normal)) < noise;
      if (!plainly_goes_through(asked)) continue;
      ++plain;
      const double* p[4];
      for (int k = 0; k < 4; ++k) p[k] = pair.pairs.x + k * kMotionStride;
      const int sign = kind == PairKind::vertex_face ? orientation(p[2], p[3], p[0], p[1])
                                                     : orientation(p[1], p[2], p[3], p[0]);
      for (int k = 0; k < 100; ++k) {
        const Vec n = some_direction(normal, random);
        const double s = dot(n, normal);
        const bool allowed = std::fabs(s) < 1e-9 || (s > 0) == (sign > 0);
        const double t = std::ldexp(1.0, -scenes::integer(random, 0, 23));
        if (allowed && least(pair.corners, 0, n) >= -noise && least(pair.corners, t, n) > 4 * noise)
          FAIL_CHECK("pair " << i << " of kind " << int(kind) << " parts at " << t);
      }
    }
    CHECK(plain > near / 6);  // many a pair within noise, and no other
    CHECK(plain > fuzz(200));
  }
}

// Flat up to rounding, so that a determinant is computed as 0, and not flat exactly.
TEST_CASE("of pairs that are flat up to rounding nothing is plain") {
  const double tiny = 1e-12;
  const std::array<Point, 4> edges{{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {1.5, tiny, 0}}};
  const std::array<Point, 4> face{{{0.25, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0.5, tiny, 0}}};
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (const double up : {1e-17, -1e-17, 1e-300, 0.0}) {
      Query q{kind, kind == PairKind::vertex_face ? face : edges, {}};
      q.t0[0][2] += up;
      q.t1 = q.t0;
      for (Point& p : q.t1) p[2] -= up < 0 ? -1 : 1;
      q.t1[0][2] = up;
      const Pressed pair(q);
      const std::function<Vec(double)> none = [](double) { return Vec{}; };
      CHECK_FALSE(plainly_goes_through({pair.corners, pair.pairs, 0, kind, 0, none, nullptr}));
    }
}
