// A query alone and a scene of that one pair have the same contact, bit for bit: when, where, with which
// normal.
#include <cmath>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

struct Counts {
  int contacts = 0, free = 0, parting = 0, certain = 0;
};

// With a tolerance of its own the two have the same one, whatever the rest of a scene.
void expect_same_contact(const Query& query, const Options& o, Counts& counts) {
  const QueryResult alone = scenes::ccd(query, o);
  const ActiveSet set =
      construct_active_set(mesh_of(query.kind), positions(query.t0), positions(query.t1), o);
  INFO(to_text(query));
  CAPTURE(o.min_separation, int(o.exactness), to_string(alone.outcome), alone.toi);
  REQUIRE(set.size() <= 1);
  if (set.empty()) {  // what comes within the tolerance, boxes never together, is not in the set
    CHECK((!alone.collides() || alone.certainty == Certainty::within_tolerance));
    counts.free += !alone.collides();
  } else {
    CHECK(same_bytes(set[0], alone));
    CHECK(set[0].tolerance == alone.tolerance);
    ++counts.contacts, counts.certain += alone.certainty != Certainty::within_tolerance;
    counts.parting += alone.outcome == PairOutcome::initial_separating;
  }
}

std::vector<Options> ways_to_ask() {
  std::vector<Options> all(6);
  for (Options& o : all) o.tolerance = 1e-6;
  all[1].exactness = Exactness::exact, all[2].exactness = Exactness::conservative;
  all[3].min_separation = 1, all[4].min_separation = 0.01, all[4].norm = Norm::maximum;
  all[5].touching_may_pass_through = true, all[5].max_checks = 20;
  return all;
}

}  // namespace

TEST_CASE("a query has the contact of the active set of that pair, bit for bit", "[property][simd]") {
  Random random(71);
  Counts counts;
  for (int i = 0; i < fuzz(200); ++i)
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      const Query query = i % 3 == 0   ? scenes::interior_query(kind, random)
                          : i % 3 == 1 ? scenes::mixed_query(kind, random)
                                       : scenes::grid_query(kind, random, 1);
      for (Options o : ways_to_ask())
        for (const InstructionSet instruction_set : kernels()) {
          o.instruction_set = instruction_set;
          expect_same_contact(query, o, counts);
        }
    }
  CHECK((counts.contacts > fuzz(200) && counts.free > fuzz(200) && counts.certain > fuzz(200)));
  CHECK(counts.parting > int(kernels().size()) * fuzz(200) / 40);
}

TEST_CASE("degenerate queries, too, have the contact of the active set", "[property]") {
  Counts counts;
  for (const scenes::Family& family : scenes::families())
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      Random random = scenes::seeded(family, kind, 72);
      INFO(family.name);
      for (int i = 0; i < fuzz(10); ++i) {
        const Query query = family.make(kind, random);
        for (const Options& o : ways_to_ask()) expect_same_contact(query, o, counts);
      }
    }
  CHECK((counts.contacts > fuzz(200) && counts.free > fuzz(50)));
}

TEST_CASE("a query tells where it touches, and names its points in its own order", "[unit]") {
  const VertexFaceQuery falls{{{{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                              {{{0.25, 0.25, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  Options o;
  o.exactness = Exactness::exact;
  const QueryResult face = vertex_face_ccd(falls, o);
  CHECK((face.kind == PairKind::vertex_face && face.a == 0 && face.b == 0));
  CHECK(face.vertices == std::array<int, 4>{0, 1, 2, 3});
  CHECK((face.toi == 0.5 && face.step_limit == 0.5 && face.checks > 0));
  CHECK(face.certainty == Certainty::certain);
  CHECK(face.weights == std::array<double, 4>{1, -0.5, -0.25, -0.25});
  CHECK(face.normal == Point{0, 0, 1});
  CHECK((face.gap == 0 && face.speed == -2 && !face.degenerate));

  const EdgeEdgeQuery wires{{{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 3, 0}}},
                            {{{-1, 0, -1}, {1, 0, -1}, {0, -1, 0}, {0, 3, 0}}}};
  const QueryResult edges = edge_edge_ccd(wires, o);
  CHECK((edges.kind == PairKind::edge_edge && edges.a == 0 && edges.b == 1));
  CHECK(edges.vertices == std::array<int, 4>{0, 1, 2, 3});
  CHECK((edges.toi == 0.5 && edges.speed == -2 && !edges.degenerate));
  CHECK(edges.weights == std::array<double, 4>{0.5, 0.5, -0.75, -0.25});
  CHECK(edges.normal == Point{0, 0, 1});

  VertexFaceQuery rises = falls;
  rises.t1[0][2] = 2;
  const QueryResult free = vertex_face_ccd(rises, o);
  CHECK((!free.collides() && free.toi == INFINITY && free.toi_hi == INFINITY && free.step_limit == INFINITY));
  CHECK((free.weights == std::array<double, 4>{} && free.normal == Point{} && free.speed == 0));
  CHECK(free.vertices == std::array<int, 4>{0, 1, 2, 3});
}
