// Every pair of scenes in which faces and edges have vertices of several bodies, with thickness and rules,
// against densely sampled paths.
#include <algorithm>
#include <cstdio>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/trajectory/dense_truth.hpp"

namespace onset::tests {
namespace {

using scenes::coin;
using scenes::integer;
using scenes::Random;
using scenes::uniform;

constexpr double kBlur = 1e-10;

Eigen::Vector3d vector(Random& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

struct Mixed {
  TurningPaths paths;
  Eigen::MatrixXi faces;
  CollisionRules rules;
};

// Triangles whose vertices are in two bodies that turn, or move, as it happens.
Mixed mixed_scene(Random& random) {
  Mixed s;
  const scenes::Scene soup = scenes::triangle_soup(6, 0.7, 0.3, random);
  s.paths.x_t0 = soup.x_t0, s.paths.x_t1 = soup.x_t1, s.faces = soup.faces;
  for (int b = 0; b < 2; ++b)
    s.paths.bodies.push_back({vector(random, 2), coin(random) ? vector(random, 0.3) : Eigen::Vector3d::Zero(),
                              vector(random, 0.5)});
  const bool whole = coin(random);
  for (int v = 0; v < 18; ++v)
    s.paths.body.push_back(whole && v % 3 > 0 ? s.paths.body.back() : integer(random, -1, 1));
  if (coin(random))
    for (int v = 0; v < 18; ++v) s.rules.thickness.push_back(uniform(random, 0, 0.02));
  if (coin(random)) {
    for (int v = 0; v < 18; ++v) s.rules.bodies.push_back(v / 9);
    s.rules.bodies_without_self_collision = {true, coin(random)};
  }
  return s;
}

double thickest(const CollisionRules& rules, const int* first, const int* last) {
  double r = 0;
  for (; first != last && !rules.thickness.empty(); ++first)
    r = std::max(r, rules.thickness[std::size_t(*first)]);
  return r;
}

struct Tally {
  int contacts = 0, listed = 0, late = 0, missed = 0, left_out = 0;
};

void ask(const Mesh& mesh, const Mixed& s, const ActiveSet& set, const Pair& pair, Tally& tally) {
  const int first = pair.kind == PairKind::vertex_face ? 1 : 2;
  const auto& v = pair.vertices;
  for (int i = 0; i < first; ++i)
    if (std::find(v.begin() + first, v.end(), v[std::size_t(i)]) != v.end()) return;
  const auto row = std::find_if(set.begin(), set.end(), [&](const Contact& c) {
    return c.kind == pair.kind && c.a == pair.a && c.b == pair.b;
  });
  const auto& no_self = s.rules.bodies_without_self_collision;
  const int body = mesh.body(v[0]);
  if (!no_self.empty() && body == mesh.body(v[3]) && no_self[std::size_t(body)]) {
    REQUIRE(row == set.end());
    ++tally.left_out;
    return;
  }
  const double separation = 0.01 + thickest(s.rules, v.data(), v.data() + first) +
                            thickest(s.rules, v.data() + first, v.data() + 4);
  const Truth truth = first_contact(s.paths, pair.kind, v, separation, 100);
  CAPTURE(int(pair.kind), pair.a, pair.b, separation, double(truth.least));
  if (truth.first) ++tally.contacts;
  if (truth.first && row == set.end() && truth.least < separation - kBlur) ++tally.missed;
  if (row == set.end()) return;
  ++tally.listed;
  REQUIRE(truth.least <= separation + 2e-4);
  if (truth.first && row->toi > double(*truth.first) + kBlur) ++tally.late;
  if (truth.first && row->certainty == Certainty::certain)
    REQUIRE(row->toi_hi >= double(*truth.first) - kBlur);
}

}  // namespace

TEST_CASE("pairs with vertices of several bodies are neither missed nor late", "[trajectory]") {
  Random random(51);
  Tally tally;
  for (int i = 0; i < fuzz(25); ++i) {
    const Mixed s = mixed_scene(random);
    const Mesh mesh(s.paths.x_t0, s.faces, s.rules);
    Options options;
    options.min_separation = 0.01;
    options.tolerance = 1e-4;
    const ActiveSet set = construct_active_set(mesh, s.paths.trajectory(), options);
    const StepResult step = compute_collision_free_stepsize(mesh, s.paths.trajectory(), options);
    CAPTURE(i, set.size(), step.step);
    // Linear pairs that part at the start are contacts that block nothing.
    const auto blocks = [](const Contact& c) { return c.outcome != PairOutcome::initial_separating; };
    if (std::all_of(set.begin(), set.end(), blocks)) {
      REQUIRE((step.toi <= 1) == !set.empty());
      if (!set.empty()) REQUIRE(step.toi == set.earliest()->toi);
    }
    for (int v = 0; v < mesh.num_vertices(); ++v)
      for (int f = 0; f < mesh.num_faces(); ++f)
        ask(mesh, s, set,
            {PairKind::vertex_face, v, f, {v, mesh.face(f)[0], mesh.face(f)[1], mesh.face(f)[2]}}, tally);
    for (int e = 0; e < mesh.num_edges(); ++e)
      for (int g = e + 1; g < mesh.num_edges(); ++g)
        ask(mesh, s, set,
            {PairKind::edge_edge, e, g, {mesh.edge(e)[0], mesh.edge(e)[1], mesh.edge(g)[0], mesh.edge(g)[1]}},
            tally);
  }
  std::printf("mixed scenes: %d contacts, %d missed, %d late, %d listed, %d left out by rules\n",
              tally.contacts, tally.missed, tally.late, tally.listed, tally.left_out);
  CHECK(tally.missed == 0);
  CHECK(tally.late == 0);
  CHECK(tally.contacts > 3 * fuzz(25));
  CHECK((tally.left_out > 3 * fuzz(25) || fuzz(25) < 5));
}

}  // namespace onset::tests
