// Single queries of a vertex and an edge against exact contacts.
#include <sstream>

#include "tests/catch.hpp"
#include "tests/in_plane/support/plane_queries.hpp"
#include "tests/in_plane/support/plane_truth.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

constexpr int kQueries = 12'500;  // of each family; 100,000 in all

std::string to_text(const VertexEdgeQuery& q, const QueryResult& r, const PlaneTruth& truth) {
  std::ostringstream s;
  s << std::hexfloat;
  for (const auto* points : {&q.t0, &q.t1})
    for (const PlanePoint& p : *points) s << p[0] << ' ' << p[1] << "  ";
  s << "outcome " << to_string(r.outcome) << " certainty " << to_string(r.certainty) << " toi " << r.toi
    << ' ' << r.toi_hi << " limit " << r.step_limit << " truth " << truth.collides << ' ' << truth.lo << ' '
    << truth.hi;
  return s.str();
}

// Empty, or what is wrong at every level: a miss, a time that is late, 0 from apart, a bracket around
// nothing.
const char* broken(const QueryResult& r, const PlaneTruth& truth) {
  if (truth.collides && !r.collides()) return "missed";
  if (truth.collides && r.toi > truth.lo) return "late";
  if (r.collides() && !truth.at_start() && !(r.toi > 0)) return "0 from apart";
  if (r.certainty != Certainty::within_tolerance && !truth.collides) return "certain of nothing";
  if (truth.collides && r.toi_hi < truth.lo) return "bracket too early";
  if (r.outcome == PairOutcome::contact && !(r.step_limit <= truth.lo) && truth.collides) return "limit";
  return "";
}

// Certified and exact answers are the truth itself, which fixed-width integers decide.
const char* inexact(const QueryResult& r, const PlaneTruth& truth, Exactness exactness) {
  if (r.collides() != truth.collides) return "not the truth";
  if (truth.collides && r.certainty == Certainty::within_tolerance) return "uncertain";
  if (exactness != Exactness::exact || !truth.collides) return "";
  if (r.toi_hi != truth.hi) return "toi_hi";
  return r.toi == truth.lo ? "" : "toi";
}

void ask(PlaneFamily family, int count) {
  scenes::Random random(oracle::fuzz_seed() * 100 + std::uint64_t(family));
  int wrong = 0;
  for (int i = 0; i < oracle::fuzz(count) && wrong < 3; ++i) {
    const VertexEdgeQuery query = plane_query(family, random);
    const PlaneTruth truth = plane_truth(query);
    for (const Exactness exactness : {Exactness::conservative, Exactness::certify, Exactness::exact}) {
      Options options;
      options.exactness = exactness;
      const QueryResult r = vertex_edge_ccd(query, options);
      std::string why = broken(r, truth);
      const bool decided = exactness == Exactness::exact ||
                           (exactness == Exactness::certify && family != PlaneFamily::huge_and_tiny);
      if (why.empty() && decided) why = inexact(r, truth, exactness);
      if (!why.empty()) ++wrong;
      INFO("query " << i << " exactness " << int(exactness) << ": " << to_text(query, r, truth));
      CHECK(why == "");
    }
  }
}

}  // namespace

TEST_CASE("vertex and edge: no query is missed or late, and certified answers are the truth") {
  for (int family = 0; family < kPlaneFamilies; ++family) {
    INFO("family " << family);
    ask(PlaneFamily(family), kQueries);
  }
}

TEST_CASE("vertex and edge: the normal is a unit vector in the plane, and the weights are on the edge") {
  scenes::Random random(oracle::fuzz_seed());
  int contacts = 0;
  for (int i = 0; i < oracle::fuzz(4000); ++i) {
    const VertexEdgeQuery q = plane_query(PlaneFamily(i % kPlaneFamilies), random);
    for (const Exactness exactness : {Exactness::certify, Exactness::exact}) {
      Options options;
      options.exactness = exactness;
      const QueryResult r = vertex_edge_ccd(q, options);
      if (!r.collides() || r.outcome == PairOutcome::out_of_range) continue;
      ++contacts;
      INFO(to_text(q, r, plane_truth(q)));
      CHECK(r.normal[2] == 0);
      CHECK(std::abs(std::hypot(r.normal[0], r.normal[1]) - 1) < 1e-14);
      CHECK((r.weights[0] == 1 && r.weights[3] == 0 && r.weights[1] + r.weights[2] == -1));
      CHECK((r.weights[1] <= 0 && r.weights[2] <= 0));
      CHECK(r.vertices == std::array<int, 4>{0, 1, 2, 2});
    }
  }
  CHECK(contacts > oracle::fuzz(4000) / 4);
}

TEST_CASE("vertex and edge: contact inside the edge has the exact side, from which the vertex came") {
  scenes::Random random(oracle::fuzz_seed() + 7);
  int sided = 0;
  for (int i = 0; i < oracle::fuzz(4000); ++i) {
    const VertexEdgeQuery q = plane_query(i % 2 == 0 ? PlaneFamily::aimed : PlaneFamily::uniform, random);
    Options options;
    options.exactness = Exactness::exact;
    const QueryResult r = vertex_edge_ccd(q, options);
    if (!r.collides() || r.degenerate || r.weights[1] == 0 || r.weights[2] == 0) continue;
    ++sided;
    const double t = r.toi;
    double e[2];
    for (std::size_t k = 0; k < 2; ++k)
      e[k] = (1 - t) * (q.t0[2][k] - q.t0[1][k]) + t * (q.t1[2][k] - q.t1[1][k]);
    INFO(to_text(q, r, plane_truth(q)));
    CHECK(std::abs(r.normal[0] * e[0] + r.normal[1] * e[1]) <= 1e-6 * std::hypot(e[0], e[1]));
    // It closes in on the edge: the side is the one that it leaves.
    CHECK(r.speed <= 1e-14);
  }
  CHECK(sided > oracle::fuzz(4000) / 8);
}
