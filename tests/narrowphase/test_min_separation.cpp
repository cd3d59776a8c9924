// Pairs must stay farther apart than d: reported if ever closer, not reported if always farther than d +
// tolerance. In the Euclidean and in the maximum norm, against exact distances.
#include <cmath>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/check_promises.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

// Separations that are hard to tell from the distance, and ones of every size.
double some_separation(const Query& query, Norm norm, Random& random) {
  const double size = extent(query), start = rough_distance(query, 0, norm);
  switch (scenes::integer(random, 0, 5)) {
    case 0:
      return rough_distance(query, rough_closest_time(query, norm), norm) * scenes::uniform(random, 0.5, 1.5);
    case 1:
      return start * (1 - scenes::power_of_ten(random, -12, -0.1));
    case 2:
      return start * (1 + scenes::power_of_ten(random, -12, -0.1));
    case 3:
      return size * scenes::power_of_ten(random, -16, -3);
    case 4:
      return size * scenes::power_of_ten(random, -3, 0);
    default:
      return size * scenes::power_of_ten(random, 0, 6);  // larger than the pair
  }
}

bool measurable(const Query& query) {
  const double size = extent(query);
  return size > 0x1p-900 && size < 0x1p900;
}

void check_separations(Norm norm, int count) {
  for_each_query(
      all_sources(), count, 11, [&](const std::string& source, const Query& query, Random& random) {
        if (!measurable(query)) return;
        for (int i = 0; i < 4; ++i) {
          Options o;
          o.norm = norm;
          o.min_separation = some_separation(query, norm, random);
          if (!(o.min_separation < 0x1p1000)) continue;
          if (scenes::coin(random))
            o.tolerance = std::max(extent(query) * scenes::power_of_ten(random, -14, -2), 0x1p-1070);
          if (i == 3) o.max_checks = scenes::integer(random, 1, 10);
          check_promises(source, query, o);
        }
      });
}

// A vertex above the middle of a triangle with normal (1, 1, 1), which it approaches or leaves along the
// normal; heights are Euclidean distances.
Query above_oblique_triangle(double height_t0, double height_t1) {
  Query query;
  query.kind = PairKind::vertex_face;
  const std::array<Point, 3> face{{{2, -1, -1}, {-1, 2, -1}, {-1, -1, 2}}};
  const auto at = [&](double height) {
    const double x = height / std::sqrt(3.0);
    return std::array<Point, 4>{Point{x, x, x}, face[0], face[1], face[2]};
  };
  query.t0 = at(height_t0), query.t1 = at(height_t1);
  return query;
}

}  // namespace

TEST_CASE("Euclidean separations are kept, and nothing farther is reported", "[property][oracle]") {
  check_separations(Norm::euclidean, fuzz(3));
}

TEST_CASE("separations in the maximum norm are kept, and nothing farther is reported", "[property][oracle]") {
  check_separations(Norm::maximum, fuzz(2));
}

TEST_CASE("separations are kept by the inclusion root finder alone", "[property][oracle]") {
  for_each_query(all_sources(), fuzz(1), 12,
                 [&](const std::string& source, const Query& query, Random& random) {
                   if (!measurable(query)) return;
                   for (Norm norm : {Norm::euclidean, Norm::maximum}) {
                     Options o;
                     o.norm = norm;
                     o.narrow_phase = NarrowPhaseMethod::inclusion;
                     o.max_checks = 3000;
                     o.relative_tolerance = 1e-4;
                     o.min_separation = some_separation(query, norm, random);
                     if (o.min_separation < 0x1p1000) check_promises(source, query, o);
                   }
                 });
}

// Others test a cube where the start was tested in a ball, and halve d where these contradict each other. In
// the maximum norm the distance to this face is the height / sqrt(3).
TEST_CASE("an oblique face is kept at its distance", "[unit]") {
  for (Norm norm : {Norm::euclidean, Norm::maximum}) {
    const double unit = norm == Norm::euclidean ? 1 : std::sqrt(3.0);
    Options o;
    o.min_separation = 0.01;
    o.norm = norm;
    o.tolerance = 1e-7;
    INFO("norm " << int(norm));

    const Query grazing = above_oblique_triangle(0.011 * unit, 0.009 * unit);
    const QueryResult a = ccd(grazing, o);
    CHECK(a.outcome == PairOutcome::contact);
    CHECK(a.toi <= 0.5);
    CHECK(a.toi > 0.4999);
    CHECK(broken_promise(grazing, o, a) == "");

    const Query falling = above_oblique_triangle(0.012 * unit, 0);
    const QueryResult b = ccd(falling, o);
    CHECK(b.outcome == PairOutcome::contact);
    CHECK(b.toi <= 1 / 6.0);
    CHECK(b.toi > 0.1666);
    CHECK(broken_promise(falling, o, b) == "");

    const Query parting = above_oblique_triangle(0.009 * unit, 0.02 * unit);
    CHECK(ccd(parting, o).outcome == PairOutcome::initial_separating);

    const Query pressing = above_oblique_triangle(0.009 * unit, 0.001 * unit);
    const QueryResult c = ccd(pressing, o);
    CHECK(c.outcome == PairOutcome::initial_contact);
    CHECK(c.toi == 0);
  }
}

// Between the two norms: closer than d in the maximum norm, farther in the Euclidean one.
TEST_CASE("the two norms differ by what they should", "[unit]") {
  const Query query = above_oblique_triangle(0.03, 0.011);
  Options o;
  o.min_separation = 0.01;
  CHECK(ccd(query, o).outcome == PairOutcome::free);
  o.norm = Norm::maximum;
  const QueryResult r = ccd(query, o);
  CHECK(r.outcome == PairOutcome::contact);
  const double exact = (0.03 - 0.01 * std::sqrt(3.0)) / (0.03 - 0.011);
  CHECK(r.toi <= exact);
  CHECK(r.toi > exact - 1e-3);
}
