// The queries of one pair by ipc-toolkit's names, against exact arithmetic.
#include <onset/compat/ipc.hpp>
#include <onset/compat/narrow_phase.hpp>
#include <onset/compat/plane_query.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/oracle/within.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

namespace ipc = onset::ipc;
using namespace onset;
using Eigen::Vector3d;
using oracle::Rational;

namespace {

// What a pair is asked about: the points of a query that it uses, the others being copies of these.
enum class Asked { point_triangle, edge_edge, point_edge, point_point };
constexpr Asked kAll[] = {Asked::point_triangle, Asked::edge_edge, Asked::point_edge, Asked::point_point};

Vector3d vector(const Point& p) { return {p[0], p[1], p[2]}; }
Eigen::Vector2d flat(const Point& p) { return {p[0], p[1]}; }

// The same question as one of the oracle's: points are edges of length zero, in the plane at z = 0.
scenes::Query question(Asked asked, scenes::Query q, bool in_plane) {
  for (auto* x : {&q.t0, &q.t1}) {
    if (asked == Asked::point_edge || asked == Asked::point_point) (*x)[1] = (*x)[0];
    if (asked == Asked::point_point) (*x)[3] = (*x)[2];
    if (in_plane)
      for (Point& p : *x) p[2] = 0;
  }
  return q;
}

bool answer(Asked asked, const ipc::NarrowPhaseCCD& ccd, const scenes::Query& q, bool in_plane, double& toi,
            double min_distance, double tmax) {
  std::array<Vector3d, 4> a, b;
  for (std::size_t i = 0; i < 4; ++i) a[i] = vector(q.t0[i]), b[i] = vector(q.t1[i]);
  switch (asked) {
    case Asked::point_triangle:
      return ccd.point_triangle_ccd(a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], toi, min_distance, tmax);
    case Asked::edge_edge:
      return ccd.edge_edge_ccd(a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], toi, min_distance, tmax);
    case Asked::point_edge:
      if (in_plane)
        return ccd.point_edge_ccd(flat(q.t0[0]), flat(q.t0[2]), flat(q.t0[3]), flat(q.t1[0]), flat(q.t1[2]),
                                  flat(q.t1[3]), toi, min_distance, tmax);
      return ccd.point_edge_ccd(a[0], a[2], a[3], b[0], b[2], b[3], toi, min_distance, tmax);
    default:
      if (in_plane)
        return ccd.point_point_ccd(flat(q.t0[0]), flat(q.t0[2]), flat(q.t1[0]), flat(q.t1[2]), toi,
                                   min_distance, tmax);
      return ccd.point_point_ccd(a[0], a[2], b[0], b[2], toi, min_distance, tmax);
  }
}

struct Tally {
  int impacts = 0, free = 0, parting = 0, later_than_tmax = 0;
};

void check(Asked asked, const scenes::Query& made, bool in_plane, double min_distance,
           const ipc::NarrowPhaseCCD& ccd, Tally& tally) {
  const scenes::Query q = question(asked, made, in_plane);
  CAPTURE(int(asked), in_plane, min_distance, ccd.conservative_rescaling, scenes::to_text(q));
  double toi = -1;
  const bool hit = answer(asked, ccd, q, in_plane, toi, min_distance, 1);
  REQUIRE((hit ? toi >= 0 && toi <= 1 : toi == INFINITY));
  const oracle::Bracket start = oracle::distance(q, 0);
  if (start.hi <= min_distance) {  // stays, or parts from where it is
    if (start.hi == 0) CHECK((hit && toi == 0));
    tally.parting += toi > 0;
    if (toi > 0) CHECK(oracle::compare_distance(q, std::min(toi, 1.0), start.lo / 2) > 0);
    return;
  }
  const oracle::Truth truth = oracle::exact_within(q, min_distance);
  CAPTURE(toi, truth.toi_lo, truth.toi_hi, start.lo);
  CHECK((!truth.collides || (hit && toi <= truth.toi_lo)));  // never missed, never late
  tally.impacts += truth.collides, tally.free += !hit;
  double largest = 0;
  for (const auto& x : {q.t0, q.t1})
    for (const Point& p : x)
      for (const double c : p) largest = std::max(largest, std::fabs(c));
  if (start.lo > min_distance + 1e-12 * largest) {
    CHECK(toi > 0);
    // It keeps its share of the gap up to there.
    const double share = 1 - ccd.conservative_rescaling - 1e-9;
    if (share > 0)
      CHECK(oracle::compare_distance(q, std::min(toi, 1.0),
                                     min_distance + share * (start.lo - min_distance)) > 0);
  }
  // A limit only cuts off what is later.
  for (const double tmax : {0.0, 0.25, 0.5}) {
    double limited = -1;
    CHECK(answer(asked, ccd, q, in_plane, limited, min_distance, tmax) == (toi <= tmax));
    CHECK(limited == (toi <= tmax ? toi : INFINITY));
    tally.later_than_tmax += hit && toi > tmax;
  }
}

PairKind kind_of(Asked asked) {
  return asked == Asked::point_triangle ? PairKind::vertex_face : PairKind::edge_edge;
}

}  // namespace

TEST_CASE("queries by ipc-toolkit's names are never late and keep a share of the gap", "[oracle][property]") {
  const ipc::TightInclusionCCD tight;
  const ipc::AdditiveCCD additive;
  const ipc::TightInclusionCCD all_of_it(1e-6, ipc::TightInclusionCCD::DEFAULT_MAX_ITERATIONS, 1);
  const ipc::NarrowPhaseCCD* const narrow_phases[] = {&tight, &additive, &all_of_it};
  scenes::Random random(7);
  Tally tally;
  for (int i = 0; i < std::max(150, tests::fuzz(150)); ++i)
    for (const Asked asked : kAll)
      for (const bool in_plane : {false, true}) {
        if (in_plane && (asked == Asked::point_triangle || asked == Asked::edge_edge)) continue;
        scenes::Query q = i % 3 == 0 ? scenes::grid_query(kind_of(asked), random, 2)
                                     : scenes::mixed_query(kind_of(asked), random);
        // Two points meet where they are aimed at each other.
        if (asked == Asked::point_point && i % 2 == 0) q.t1[0] = q.t0[2], q.t1[2] = q.t0[0];
        const double min_distance = i % 2 == 0 ? 0 : scenes::power_of_ten(random, -4, 0.5);
        check(asked, q, in_plane, min_distance, *narrow_phases[i % 3], tally);
      }
  CAPTURE(tally.impacts, tally.free, tally.parting, tally.later_than_tmax);
  CHECK((tally.impacts > 30 && tally.free > 30 && tally.parting > 3 && tally.later_than_tmax > 10));
}

TEST_CASE("queries by ipc-toolkit's names are never late where others fail", "[oracle][property]") {
  const ipc::TightInclusionCCD tight;
  const ipc::AdditiveCCD additive;
  Tally tally;
  for (const scenes::Family& family : scenes::families())
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, 11);
      for (int i = 0; i < std::max(12, tests::fuzz(12)); ++i) {
        const scenes::Query q = family.make(kind, random);
        bool extreme = false;  // of the oracle's distances, too
        for (const auto& x : {q.t0, q.t1})
          for (const Point& p : x)
            for (const double c : p) extreme = extreme || std::fabs(c) > 0x1p200;
        if (extreme) continue;
        INFO(family.name);
        check(kind == PairKind::vertex_face ? Asked::point_triangle : Asked::edge_edge, q, false, 0,
              i % 2 == 0 ? static_cast<const ipc::NarrowPhaseCCD&>(tight) : additive, tally);
      }
    }
  CHECK(tally.impacts > 10);
}

TEST_CASE("a missed corner of Tight Inclusion 1.0.6 is met", "[unit]") {
  // Touches at t = 1/2; its rounding bound is too small at coordinates of a thousand.
  double toi = -1;
  CHECK(ipc::TightInclusionCCD(1e-3).point_triangle_ccd(
      Vector3d(-0x1.0f2a5e5d5fb2fp+9, 0x1.d873edba5407fp+9, 0x1.ebe65d25f6e63p+9),
      Vector3d(0x1.96202fd3d7a46p+7, 0x1.37e7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8),
      Vector3d(0x1.2f1017e9ebd23p+8, 0x1.91e7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8),
      Vector3d(0x1.111017e9ebd23p+8, 0x1.9be7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8),
      Vector3d(0x1.da3a76474b852p+9, -0x1.41180146138f8p+8, -0x1.b96088604c810p+7),
      Vector3d(0x1.96202fd3d7a46p+7, 0x1.37e7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8),
      Vector3d(0x1.2f1017e9ebd23p+8, 0x1.91e7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8),
      Vector3d(0x1.111017e9ebd23p+8, 0x1.9be7ed174a403p+8, 0x1.7d8e3b0de3c5fp+8), toi));
  CHECK((toi > 0.2 && toi <= 0.5));
}

TEST_CASE("an oblique distance is kept, and a pair that parts is not held", "[unit]") {
  // A point above a triangle with normal (1, 1, 1), in units of its length.
  const auto toi_of = [](double from, double to, double min_distance) {
    const Vector3d n = Vector3d(1, 1, 1).normalized(), a(1, -1, 0), b(0, 1, -1), c = -a - b;
    double toi = -1;
    ipc::TightInclusionCCD().point_triangle_ccd(from * n, a, b, c, to * n, a, b, c, toi, min_distance);
    return toi;
  };
  CHECK((toi_of(0.012, 0, 0.01) > 0 && toi_of(0.012, 0, 0.01) <= 1.0 / 6));
  CHECK((toi_of(0.011, 0.009, 0.01) > 0 && toi_of(0.011, 0.009, 0.01) <= 0.5));
  CHECK(toi_of(0.009, 0.02, 0.01) == INFINITY);
  CHECK(toi_of(0.009, 0.008, 0.01) == 0);
  CHECK(toi_of(0, 0.02, 0) == 0);
}

TEST_CASE("narrow phases have ipc-toolkit's defaults", "[unit]") {
  STATIC_REQUIRE(ipc::TightInclusionCCD::DEFAULT_TOLERANCE == 1e-6);
  STATIC_REQUIRE(ipc::TightInclusionCCD::DEFAULT_MAX_ITERATIONS == 10'000'000L);
  STATIC_REQUIRE(ipc::TightInclusionCCD::DEFAULT_CONSERVATIVE_RESCALING == 0.8);
  STATIC_REQUIRE(ipc::TightInclusionCCD::SMALL_TOI == 1e-6);
  STATIC_REQUIRE(ipc::AdditiveCCD::DEFAULT_MAX_ITERATIONS == 10'000'000L);
  STATIC_REQUIRE(ipc::AdditiveCCD::UNLIMITTED_ITERATIONS == -1);
  STATIC_REQUIRE(ipc::AdditiveCCD::DEFAULT_CONSERVATIVE_RESCALING == 0.9);
  STATIC_REQUIRE(!std::is_convertible_v<double, ipc::TightInclusionCCD>);
  const ipc::TightInclusionCCD tight, told(1e-3, 200, 0.5);
  CHECK(
      (tight.tolerance == 1e-6 && tight.max_iterations == 10'000'000 && tight.conservative_rescaling == 0.8));
  CHECK((told.tolerance == 1e-3 && told.max_iterations == 200 && told.conservative_rescaling == 0.5));
  const ipc::AdditiveCCD additive;
  CHECK((additive.max_iterations == -1 && additive.conservative_rescaling == 0.9));
  CHECK(told.options().max_checks == 200);
  CHECK(tight.options().max_checks == Options().max_checks);
  CHECK((additive.options().max_checks == Options().max_checks && !additive.options().tolerance));
}

TEST_CASE("queries by ipc-toolkit's names refuse what they cannot answer", "[unit]") {
  const ipc::TightInclusionCCD tight;
  const Vector3d a(0, 0, 1), b(0, 0, -1), still(0, 0, 0);
  const Eigen::Vector2d in_plane(0, 0);
  double toi = -1;
  const auto ask = [&](const ipc::NarrowPhaseCCD& ccd, double min_distance, double tmax) {
    return ccd.point_point_ccd(a, still, b, still, toi, min_distance, tmax);
  };
  CHECK(ask(tight, 0, 1));
  for (const double wrong : {-0.5, 1.5, double(NAN)}) {
    CHECK_THROWS_AS(ask(tight, 0, wrong), std::invalid_argument);
    CHECK_THROWS_AS(ask(ipc::AdditiveCCD(-1, wrong), 0, 1), std::invalid_argument);
  }
  CHECK_THROWS_AS(ask(tight, -1, 1), std::invalid_argument);
  CHECK_THROWS_AS(ask(tight, -0x1p-20, 1), std::invalid_argument);
  CHECK_THROWS_AS(ask(tight, 0x1p1021, 1), std::invalid_argument);
  CHECK_THROWS_AS(ask(ipc::TightInclusionCCD(0), 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(ask(ipc::TightInclusionCCD(1e-6, 0), 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(tight.point_point_ccd(a, in_plane, b, in_plane, toi), std::invalid_argument);
  for (const double bad : {double(NAN), double(INFINITY), 0x1p1023}) {
    toi = -1;
    CHECK((tight.point_point_ccd(a, still, Vector3d(bad, 0, 0), still, toi) && toi == 0));
    toi = -1;
    CHECK((tight.point_point_ccd(a, Vector3d(bad, 0, 0), b, still, toi) && toi == 0));
  }
}

TEST_CASE("queries by ipc-toolkit's names keep their share however far apart a pair is", "[unit]") {
  const double far = 0x1p1020;
  const ipc::TightInclusionCCD ccd;
  const Vector3d a(-far, -far, -far), b(far, far, far);
  double toi = -1;
  CHECK((ccd.point_point_ccd(a, b, a, -0.99 * b, toi) && toi <= 0.80403 && toi > 0.804));
  CHECK((ccd.point_point_ccd(a, b, a, -0.99 * b, toi, far) && toi <= 0.572 && toi > 0.57));
  CHECK_FALSE(ccd.point_point_ccd(a, b, a, 0.99 * b, toi));
  const compat::Nearest n = compat::nearest(compat::moving_points(a, b, a, b));
  CHECK((n.distance > 3.46 * far && n.distance < 3.47 * far));
  const Eigen::Hyperplane<double, 3> plane(Vector3d(0, 0, 1), far);
  CHECK(compat::nearest_to_plane(plane, b).distance == 2 * far);
  const Eigen::Hyperplane<double, 3> short_normal(Vector3d(0, 0, 0x1p-60), far);
  CHECK(compat::nearest_to_plane(short_normal, b).distance == INFINITY);
}

TEST_CASE("a vertex keeps its share of its distance from a plane, exactly", "[oracle][property]") {
  scenes::Random random(3);
  int impacts = 0, free = 0;
  for (int i = 0; i < std::max(300, tests::fuzz(300)); ++i) {
    const auto draw = [&] { return vector(scenes::point(random, 2)); };
    const Eigen::Hyperplane<double, 3> plane(draw(), scenes::uniform(random, -1, 1));
    const Vector3d p = draw(), q = draw();
    const auto height = [&](const Rational& t) {  // times the length of the normal
      Rational h = plane.offset();
      for (int a = 0; a < 3; ++a) {
        const Rational x0 = p[a], x1 = q[a];
        h += Rational(plane.normal()[a]) * (x0 + t * (x1 - x0));
      }
      return h;
    };
    double toi = -1;
    const bool hit = compat::plane_impact(toi, plane, p, q, 0, 1, 0.8);
    CAPTURE(i, hit, toi);
    if (height(0) <= 0) {
      CHECK((!hit || toi == 0 || height(Rational(1)) > height(0)));
      continue;
    }
    impacts += hit, free += !hit;
    CHECK(hit == (height(Rational(1)) < height(0) * Rational(0.2)));
    if (hit) CHECK((toi > 0 && height(Rational(toi)) >= height(0) * Rational(0.19)));
    double limited = -1;
    CHECK(compat::plane_impact(limited, plane, p, q, 0, 0.5, 0.8) == (toi <= 0.5));
  }
  CHECK((impacts > 20 && free > 20));
}

TEST_CASE("what a step may use up of a gap is any number in (0, 1], by all calls", "[unit]") {
  Eigen::MatrixXd x(2, 3), y;
  x << 0, 0, 1, 5, 5, 1;
  y = x;
  y.col(2).array() -= 2;
  ipc::CollisionMesh mesh(x);
  mesh.planes.emplace_back(Eigen::Vector3d(0, 0, 1), 0.0);
  const ipc::PlaneVertexCandidate pair(mesh.planes[0], 0);
  const Eigen::VectorXd from = x.row(0).transpose(), to = y.row(0).transpose();
  ipc::Candidates all;
  all.build(mesh, x, y);
  REQUIRE(all.size() == 2);
  ipc::TightInclusionCCD ccd;
  for (const double rescaling : {1.0, 0.5, 0x1p-53, 1e-17, 0x1p-1074}) {
    ccd.conservative_rescaling = rescaling;
    CAPTURE(rescaling);
    double toi = -1;
    CHECK((pair.ccd(from, to, toi, 0, 1, ccd) && toi >= 0 && toi <= 0.5 * rescaling + 0x1p-50));
    for (const double step : {ipc::compute_collision_free_stepsize(mesh, x, y, 0, nullptr, ccd),
                              all.compute_collision_free_stepsize(mesh, x, y, 0, ccd),
                              all.compute_cfl_stepsize(mesh, x, y, 0.1, 0, nullptr, ccd)})
      CHECK((step >= 0 && step <= 0.5 * rescaling + 0x1p-50));
  }
  for (const double rescaling : {0.0, -1.0, 1.5, double(NAN)}) {
    ccd.conservative_rescaling = rescaling;
    double toi = -1;
    CHECK_THROWS_AS(pair.ccd(from, to, toi, 0, 1, ccd), std::invalid_argument);
    CHECK_THROWS_AS(ipc::compute_collision_free_stepsize(mesh, x, y, 0, nullptr, ccd), std::invalid_argument);
    CHECK_THROWS_AS(all.compute_collision_free_stepsize(mesh, x, y, 0, ccd), std::invalid_argument);
  }
}
