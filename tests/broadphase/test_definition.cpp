// Brute force against boxes in exact arithmetic: nothing is lost, and only pairs a rounding error apart are
// added.
#include <stdexcept>

#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/arithmetic/rational.hpp"

using namespace onset;
using namespace onset::tests;
using oracle::Rational;

namespace {

struct ExactBox {
  Rational lo[2][3], hi[2][3];  // at both ends
};

ExactBox exact_box(const BroadPhaseInput& input, const std::vector<int>& vertices) {
  Rational r = input.inflation, thickest = 0;
  for (int v : vertices)
    if (!input.mesh.thickness.empty())
      thickest = std::max(thickest, Rational(input.mesh.thickness[std::size_t(v)]));
  r += thickest;
  ExactBox box;
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end)
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const Rational x0 = input.motion.t0(vertices[k])[a], x1 = input.motion.t1(vertices[k])[a];
        const Rational x = end == 0 ? x0 : Rational(x0 + Rational(input.t_max) * (x1 - x0));
        if (k == 0 || x - r < box.lo[end][a]) box.lo[end][a] = x - r;
        if (k == 0 || x + r > box.hi[end][a]) box.hi[end][a] = x + r;
      }
  return box;
}

// Whether boxes that reach `slack` farther pass the test; times may be out by a share `late` of themselves.
bool passes(BoxTest test, const ExactBox& a, const ExactBox& b, const Rational& slack, const Rational& late) {
  Rational begin = 0, end = 1;
  for (int i = 0; i < 3; ++i)
    for (const auto& [p, q] : {std::pair(&a, &b), std::pair(&b, &a)}) {
      const Rational s0 = p->hi[0][i] - q->lo[0][i] + slack, s1 = p->hi[1][i] - q->lo[1][i] + slack;
      const Rational swept = std::max(p->hi[0][i], p->hi[1][i]) - std::min(q->lo[0][i], q->lo[1][i]) + slack;
      if (test == BoxTest::swept ? swept < 0 : s0 < 0 && s1 < 0) return false;
      if (s0 < 0 && s1 >= 0) begin = std::max(begin, Rational(s0 / (s0 - s1)));
      if (s0 >= 0 && s1 < 0) end = std::min(end, Rational(s0 / (s0 - s1)));
    }
  return test != BoxTest::moving || begin * (1 - late) <= end * (1 + late);
}

double largest_coordinate(const Motion& motion) {
  double largest = 0;
  for (int v = 0; v < motion.num_vertices; ++v)
    for (int a = 0; a < 3; ++a)
      largest = std::max(largest, std::max(std::fabs(motion.t0(v)[a]), std::fabs(motion.t1(v)[a])));
  return largest;
}

std::vector<int> vertices_of(const MeshData& mesh, PairKind kind, bool second, int id) {
  if (kind == PairKind::edge_edge) return {mesh.edges[std::size_t(id)][0], mesh.edges[std::size_t(id)][1]};
  if (!second) return {id};
  const auto& f = mesh.faces[std::size_t(id)];
  return {f[0], f[1], f[2]};
}

// Returns how many pairs are together at no time but apart on no axis at both ends.
int expect_definition(const BroadPhaseInput& input, double slack) {
  int taking_turns = 0;
  const auto brute = make_broad_phase(BroadPhaseMethod::brute, input);
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    const IdPairs found = candidates(*brute, kind);
    const int first = kind == PairKind::edge_edge ? int(input.mesh.edges.size()) : input.mesh.num_vertices;
    const int second = int(kind == PairKind::edge_edge ? input.mesh.edges.size() : input.mesh.faces.size());
    const auto boxes = [&](bool is_second, int count) {
      std::vector<std::pair<std::vector<int>, ExactBox>> all;
      for (int id = 0; id < count; ++id) {
        const auto vertices = vertices_of(input.mesh, kind, is_second, id);
        all.emplace_back(vertices, exact_box(input, vertices));
      }
      return all;
    };
    const auto firsts = boxes(false, first), seconds = boxes(true, second);
    for (int a = 0; a < first; ++a)
      for (int b = kind == PairKind::edge_edge ? a + 1 : 0; b < second; ++b) {
        const auto &va = firsts[std::size_t(a)].first, &vb = seconds[std::size_t(b)].first;
        const bool shared = std::find_first_of(va.begin(), va.end(), vb.begin(), vb.end()) != va.end();
        const bool is_candidate = std::binary_search(found.begin(), found.end(), std::pair(a, b));
        if (shared) {
          if (is_candidate) FAIL("a pair that shares a vertex: " << a << " " << b);
          continue;
        }
        const ExactBox &box_a = firsts[std::size_t(a)].second, &box_b = seconds[std::size_t(b)].second;
        const bool pass = passes(input.test, box_a, box_b, 0, 0);
        if (pass && !is_candidate) FAIL("missed: kind " << int(kind) << " pair " << a << " " << b);
        if (is_candidate && !passes(input.test, box_a, box_b, slack, Rational(0x1p-44)))
          FAIL("too far apart: kind " << int(kind) << " pair " << a << " " << b);
        taking_turns +=
            !pass && input.test == BoxTest::moving && passes(BoxTest::both_ends, box_a, box_b, 0, 0);
      }
  }
  return taking_turns;
}

std::vector<Soup> small_soups() {
  scenes::Random random(17);
  const auto whole = [](scenes::Random& r) { return double(scenes::integer(r, -3, 3)); };
  const auto tenths = [](scenes::Random& r) { return scenes::integer(r, -9, 9) / 10.0; };
  const Soup base = scattered("scattered", 12, 0.4, 0.4, random);
  return {base,
          tangled(12, 15, random),
          triangles("whole", 12, random, whole),
          triangles("tenths", 12, random, tenths),
          moved(base, "far", 1e15, 1e15, 1e15),
          scaled(base, "huge", 0x1p1015),
          scaled(base, "tiny", 0x1p-1060)};
}

}  // namespace

TEST_CASE("boxes without inflation are exact", "[oracle]") {
  int taking_turns = 0;
  for (const Soup& soup : small_soups()) {
    INFO(soup.name);
    const Motion motion = soup.motion();
    for (BoxTest test : {BoxTest::swept, BoxTest::both_ends, BoxTest::moving}) {
      BroadPhaseInput input{soup.mesh, motion};
      input.test = test;
      taking_turns += expect_definition(input, 0);
    }
  }
  CHECK(taking_turns > 50);
}

TEST_CASE("inflation, thickness and t_max round outward, by a few units in the last place", "[oracle]") {
  scenes::Random random(19);
  for (Soup& soup : small_soups()) {
    INFO(soup.name);
    const Motion motion = soup.motion();
    const double size = largest_coordinate(motion);
    for (BoxTest test : {BoxTest::swept, BoxTest::both_ends, BoxTest::moving})
      for (double relative : {0.0, 0.1})
        for (double t_max : {0.0, 0.3, 1.0}) {
          soup.mesh.thickness.clear();
          if (scenes::coin(random))
            for (int v = 0; v < soup.mesh.num_vertices; ++v)
              soup.mesh.thickness.push_back(size * scenes::uniform(random, 0, 0.1));
          BroadPhaseInput input{soup.mesh, motion};
          input.test = test, input.inflation = size * relative, input.t_max = t_max;
          expect_definition(input, size * 0x1p-46 + 0x1p-1066);
        }
  }
}
