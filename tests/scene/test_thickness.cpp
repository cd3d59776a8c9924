// Thickness of vertices: every pair keeps the separation plus the largest thickness on each of its two sides.
#include <algorithm>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/mesh_pairs.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;
using scenes::set_rule;

namespace {

std::vector<double> random_thickness(const Mesh& mesh, double most, Random& random) {
  std::vector<double> t(std::size_t(mesh.num_vertices()));
  for (double& x : t) x = scenes::integer(random, 0, 2) ? scenes::uniform(random, 0, most) : 0;
  return t;
}

}  // namespace

TEST_CASE("each pair of a scene with thickness answers as the query with that separation", "[property]") {
  Random random(111);
  const int every = std::max(1, 4 / fuzz(4));  // of the pairs that are not reported
  int reported = 0, silent = 0;
  for (NamedScene named : {some_scenes()[1], some_scenes()[3], some_scenes()[7]})
    for (Norm norm : {Norm::euclidean, Norm::maximum}) {
      if (named.scene.faces.rows() > 40) named.scene = scenes::sphere_onto_cube(3, 6, 0.25, 0.4);
      Mesh mesh = named.mesh();
      const std::vector<double> t = random_thickness(mesh, 0.05, random);
      set_rule(mesh, &CollisionRules::thickness, t);
      Options o;
      o.min_separation = 0.01;
      o.norm = norm;
      o.tolerance = 1e-6;
      const ActiveSet active = construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, o);
      for_all_pairs(mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
        const int first = scenes::first_body(kind);
        const double d = 0.01 + thickest(t, v, 0, first) + thickest(t, v, first, 4);
        Query query = query_of(kind, v, named.scene.x_t0, named.scene.x_t1);
        const std::size_t i = row_of(active, {kind, a, b});
        const bool found = i < active.size();
        ++(found ? reported : silent);
        if (!found && silent % every != 0) return;
        Options alone = o;
        alone.min_separation = d;
        const double closest = rough_distance(query, rough_closest_time(query, norm), norm);
        CAPTURE(named.name, int(kind), a, b, d, closest, int(norm));
        if (found) {
          CHECK(closest <= d + 1.1e-6);
          const QueryResult r = ccd(query, alone);
          CHECK(std::abs(r.toi - active[i].toi) < 1e-3);
        } else {
          CHECK(closest >= d * (1 - 1e-9));
        }
      });
    }
  CHECK(reported > 50);
  CHECK(silent > 50);
}

TEST_CASE("uniform thickness is a separation of twice as much", "[property]") {
  for (const NamedScene& named : some_scenes()) {
    Mesh thick = named.mesh();
    const Mesh thin = named.mesh();
    set_rule(thick, &CollisionRules::thickness,
             std::vector<double>(std::size_t(thick.num_vertices()), 0x1p-6));
    Options o, twice;
    o.tolerance = twice.tolerance = 1e-6;
    twice.min_separation = 0x1p-5 * (1 + 0x1p-51);  // as the sum is rounded up
    CAPTURE(named.name);
    CHECK(same_bytes(construct_active_set(thick, named.scene.x_t0, named.scene.x_t1, o),
                     construct_active_set(thin, named.scene.x_t0, named.scene.x_t1, twice)));
  }
}

TEST_CASE("zero thickness changes nothing, and the broad phases agree with thickness", "[property]") {
  Random random(112);
  for (const NamedScene& named : some_scenes()) {
    Mesh mesh = named.mesh();
    Options o;
    o.tolerance = 1e-6;
    const ActiveSet plain = construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, o);
    set_rule(mesh, &CollisionRules::thickness, std::vector<double>(std::size_t(mesh.num_vertices()), 0));
    CAPTURE(named.name);
    CHECK(same_bytes(plain, construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, o)));
    set_rule(mesh, &CollisionRules::thickness, random_thickness(mesh, 0.1, random));
    o.min_separation = 1e-3;
    const ActiveSet automatic = construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, o);
    o.broad_phase = BroadPhaseMethod::brute;
    CHECK(same_bytes(automatic, construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, o)));
    CHECK(automatic.size() >= plain.size());
  }
}
