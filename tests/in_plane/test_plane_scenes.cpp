// Whole scenes in the plane against the exact contacts of all their pairs.
#include "tests/catch.hpp"
#include "tests/in_plane/support/plane_scenes.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

double first_contact(const std::map<std::array<int, 2>, PlaneTruth>& contacts) {
  double first = INFINITY;
  for (const auto& [pair, truth] : contacts) first = std::min(first, truth.lo);
  return first;
}

}  // namespace

TEST_CASE("polygons: steps end before the first exact contact, and above 0") {
  scenes::Random random(oracle::fuzz_seed());
  int limited = 0;
  for (int i = 0; i < oracle::fuzz(200); ++i) {
    const double scale = i % 4 == 3 ? std::ldexp(1.0, scenes::integer(random, -900, 900)) : 1;
    const PlaneScene s =
        polygons(scenes::integer(random, 2, 12), scenes::power_of_ten(random, -2, 0.5), random, scale);
    const Mesh mesh = s.mesh();
    REQUIRE(mesh.dimension() == 2);
    const auto contacts = contacts_of(s);
    const StepResult r = compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1);
    INFO("scene " << i);
    const bool free = is_step_collision_free(mesh, s.x_t0, s.x_t1);
    if (contacts.empty()) {
      CHECK(r.step > 0.99);
    } else {
      ++limited;
      CHECK_FALSE(free);
      CHECK(r.step <= first_contact(contacts));
      CHECK(r.toi <= first_contact(contacts));
      CHECK(r.step >= 0.9 * first_contact(contacts) - 1e-6);
      REQUIRE(r.limiting);
      CHECK(r.limiting->kind == PairKind::vertex_edge);
    }
    CHECK(r.step > 0);
    CHECK_FALSE(any_common_point(s.x_t0 + r.step * (s.x_t1 - s.x_t0), s.edges));
  }
  CHECK(limited > oracle::fuzz(200) / 8);
}

TEST_CASE("polygons: active sets are the exact contacts") {
  scenes::Random random(oracle::fuzz_seed() + 1);
  std::size_t contacts = 0;
  for (int i = 0; i < oracle::fuzz(200); ++i) {
    const PlaneScene s =
        polygons(scenes::integer(random, 2, 12), scenes::power_of_ten(random, -2, 0.5), random);
    const auto truth = contacts_of(s);
    for (const Exactness exactness : {Exactness::certify, Exactness::exact}) {
      Options options;
      options.exactness = exactness;
      const ActiveSet set = construct_active_set(s.mesh(), s.x_t0, s.x_t1, options);
      INFO("scene " << i);
      REQUIRE(set.size() == truth.size());
      CHECK(set.dimension == 2);
      CHECK(set.stats.contacts.vertex_edge == std::int64_t(set.size()));
      auto t = truth.begin();
      for (const Contact& c : set) {
        CHECK((c.kind == PairKind::vertex_edge && c.a == t->first[0] && c.b == t->first[1]));
        CHECK((c.toi <= t->second.lo && c.toi_hi >= t->second.lo && c.toi_hi < 2));
        CHECK(c.certainty != Certainty::within_tolerance);
        ++t;
      }
      contacts += set.size();
    }
  }
  CHECK(contacts > std::size_t(oracle::fuzz(200)) * 5);
}
