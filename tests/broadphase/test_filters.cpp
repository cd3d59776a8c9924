// Bodies, static vertices, groups, exclusions: every broad phase gives what a filter written from the
// documentation of CollisionRules leaves of all pairs, and FilterCounts counts them.
#include <map>
#include <onset/intersections.hpp>
#include <onset/mesh.hpp>
#include <stdexcept>

#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/rule_filter.hpp"
#include "tests/scenes/rules.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::LeftOut;
using scenes::Random;
using scenes::set_rule;
using Rules = CollisionRules;

namespace {

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge, kEdgeFace};

std::vector<int> vertices_of(const MeshData& mesh, Primitive kind, int id) {
  if (kind == Primitive::vertex) return {id};
  if (kind == Primitive::edge) return {mesh.edges[std::size_t(id)][0], mesh.edges[std::size_t(id)][1]};
  const auto& f = mesh.faces[std::size_t(id)];
  return {f[0], f[1], f[2]};
}

LeftOut left_out(const Rules& r, const MeshData& mesh, const scenes::EdgeDistances& distances, PairKind kind,
                 int a, int b) {
  const std::vector<int> A = vertices_of(mesh, first_primitive(kind), a),
                         B = vertices_of(mesh, second_primitive(kind), b);
  const LeftOut reason = scenes::left_out(r, A, B);
  const bool by_name =
      kind == kEdgeFace ? scenes::excludes_intersection(r, a, b) : scenes::excludes_pair(r, kind, a, b);
  if (reason != LeftOut::no) return reason;
  if (by_name) return LeftOut::by_name;
  return distances.within(r.excluded_rings, A, B) ? LeftOut::within_rings : LeftOut::no;
}

template <class T>
Eigen::MatrixXi matrix(const std::vector<T>& rows) {
  Eigen::MatrixXi m(rows.size(), T().size());
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < T().size(); ++c) m(Eigen::Index(r), Eigen::Index(c)) = rows[r][c];
  return m;
}

// Clusters of a few vertices each, some with many faces, some wires, some points alone; edges may repeat.
Soup clusters(int count, Random& random) {
  Soup soup;
  soup.name = "clusters";
  for (int c = 0; c < count; ++c) {
    const int first = soup.mesh.num_vertices, size = scenes::integer(random, 1, 14);
    soup.mesh.num_vertices += size;
    for (int v = 0; v < 3 * size; ++v) {
      soup.x_t0.push_back(scenes::uniform(random, -1, 1));
      soup.x_t1.push_back(soup.x_t0.back() + scenes::uniform(random, -0.2, 0.2));
    }
    const auto vertex = [&] { return first + scenes::integer(random, 0, size - 1); };
    for (int i = 0; size > 2 && i < scenes::integer(random, 0, 12); ++i) {
      const int a = vertex(), b = vertex(), d = vertex();
      if (a != b && b != d && a != d) soup.mesh.faces.push_back({a, b, d});
    }
    for (int i = 0; size > 1 && i < scenes::integer(random, 0, 12); ++i)
      if (const int a = vertex(), b = vertex(); a != b) soup.mesh.edges.push_back({a, b});
  }
  soup.mesh.edges = complete_edge_list(matrix(soup.mesh.edges), matrix(soup.mesh.faces));
  return soup;
}

// Up to a hundred of each kind; few of them are candidates in a large mesh.
void name_pairs(const Mesh& mesh, Rules& rules, Random& random) {
  const int V = int(mesh.num_vertices()), E = int(mesh.num_edges()), F = int(mesh.num_faces());
  const auto id = [&](int count) { return scenes::integer(random, 0, count - 1); };
  if (E < 2 || F == 0 || scenes::integer(random, 0, 2) == 0) return;
  for (int i = scenes::integer(random, 0, 100); i > 0; --i) {
    rules.excluded_pairs.push_back({PairKind::vertex_face, id(V), id(F), {}});
    rules.excluded_intersections.push_back({id(E), id(F), IntersectionKind::touching, {}});
    if (const int e = id(E), g = id(E); e != g)
      rules.excluded_pairs.push_back({PairKind::edge_edge, e, g, {}});
  }
}

// Each rule with probability one half. Static vertices of `soup` stop moving.
Mesh random_rules(Soup& soup, Random& random) {
  Mesh mesh(soup.mesh.num_vertices, matrix(soup.mesh.edges), matrix(soup.mesh.faces));
  Rules rules;
  const auto some = [&](double part) { return scenes::uniform(random, 0, 1) < part; };
  const std::size_t V = std::size_t(soup.mesh.num_vertices);
  if (some(0.7)) {
    rules.bodies = mesh.components();
    const int merged = scenes::integer(random, 1, 20);
    for (int& b : rules.bodies) b %= merged;
    mesh.set_rules(rules);
  }
  const std::size_t bodies = std::size_t(mesh.num_bodies());
  const auto flags = [&](std::size_t size) {
    std::vector<bool> all(size);
    const double part = scenes::uniform(random, 0, 1);
    for (std::size_t i = 0; i < size; ++i) all[i] = some(part);
    return all;
  };
  if (some(0.5)) rules.rigid_bodies = flags(bodies);
  if (some(0.5)) rules.bodies_without_self_collision = flags(bodies);
  if (some(0.6)) {
    rules.static_vertices = some(0.5) ? flags(V) : mesh.of_bodies(flags(bodies));
    for (std::size_t v = 0; v < V; ++v)
      for (std::size_t a = 0; a < 3; ++a)
        if (rules.static_vertices[v]) soup.x_t1[3 * v + a] = soup.x_t0[3 * v + a];
  }
  if (some(0.5))
    for (std::size_t v = 0; v < V; ++v) {
      rules.groups.push_back(std::uint32_t(scenes::integer(random, 0, 3)) << 30);
      rules.masks.push_back(std::uint32_t(scenes::integer(random, 0, 3)) << 30);
    }
  const auto pairs = [&](int count, int size) {
    std::vector<std::array<int, 2>> all;
    for (int i = 0; i < count && size > 1; ++i) {
      const int a = scenes::integer(random, 0, size - 1), b = scenes::integer(random, 0, size - 1);
      if (a != b) all.push_back({a, b});
    }
    return all;
  };
  if (some(0.5)) rules.excluded_bodies = pairs(4, int(bodies));
  if (some(0.5)) rules.excluded_vertices = pairs(30, int(V));
  name_pairs(mesh, rules, random);
  if (some(0.4)) rules.excluded_rings = scenes::integer(random, 1, 4);
  mesh.set_rules(rules);
  return mesh;
}

}  // namespace

TEST_CASE("every broad phase leaves out what the rules say, and nothing else", "[property]") {
  Random random(20);
  std::int64_t found = 0;
  std::map<LeftOut, std::int64_t> reasons;
  for (int round = 0; round < 150; ++round) {
    Soup soup = clusters(scenes::integer(random, 1, 40), random);
    const Mesh mesh = random_rules(soup, random);
    const Rules& rules = mesh.rules();
    const Motion motion = make_motion(mesh.data(), {soup.x_t0.data(), soup.mesh.num_vertices},
                                      {soup.x_t1.data(), soup.mesh.num_vertices});
    REQUIRE(motion.status == Outcome::free);
    const Motion plain = soup.motion();
    const scenes::EdgeDistances distances(soup.mesh.num_vertices, soup.mesh.edges);
    for (const BoxTest test : {BoxTest::swept, BoxTest::both_ends, BoxTest::moving}) {
      BroadPhaseInput unfiltered{soup.mesh, plain}, input{mesh.data(), motion};
      unfiltered.test = input.test = test;
      unfiltered.inflation = input.inflation = round % 3 == 0 ? 0.05 : 0;
      unfiltered.t_max = input.t_max = round % 4 == 0 ? 0.3 : 1;
      unfiltered.diagonals.used = input.diagonals.used = test != BoxTest::swept && round % 2 == 0;
      for (const PairKind kind : kKinds) {
        if (kind == kEdgeFace && test != BoxTest::swept) continue;
        unfiltered.intersections = input.intersections = kind == kEdgeFace;
        const auto all = make_broad_phase(BroadPhaseMethod::brute, unfiltered);
        IdPairs expected;
        for (const auto& [a, b] : candidates(*all, kind)) {
          const LeftOut reason = left_out(rules, soup.mesh, distances, kind, a, b);
          ++reasons[reason];
          if (reason == LeftOut::no) expected.emplace_back(a, b);
        }
        found += std::int64_t(expected.size());
        std::vector<Method> every = methods();
        every.push_back({"brute", BroadPhaseMethod::brute, InstructionSet::scalar});
        for (const Method& method : every) {
          input.instruction_set = method.instruction_set;
          INFO("round " << round << ", " << method.name << ", kind " << int(kind) << ", test " << int(test));
          const auto phase = make_broad_phase(method.method, input);
          CHECK((candidates(*phase, kind) == expected));
          phase->refit(input);
          CHECK((candidates(*phase, kind) == expected));
        }
      }
    }
  }
  CHECK(found > 10000);
  for (const LeftOut reason :
       {LeftOut::masked, LeftOut::both_static, LeftOut::same_body, LeftOut::by_name, LeftOut::within_rings})
    CHECK(reasons[reason] > 1000);
}

TEST_CASE("filter counts hold every pair under the first reason that leaves it out", "[property]") {
  Random random(21);
  for (int round = 0; round < 150; ++round) {
    Soup soup = clusters(scenes::integer(random, 1, 25), random);
    const Mesh mesh = random_rules(soup, random);
    const Rules& rules = mesh.rules();
    const scenes::EdgeDistances distances(soup.mesh.num_vertices, soup.mesh.edges);
    std::array<std::vector<bool>, 3> busy;
    for (const Primitive p : kPrimitives) busy[std::size_t(p)].resize(primitive_count(soup.mesh, p));
    for (const PairKind kind : kKinds) {
      std::map<LeftOut, std::int64_t> counts;
      std::int64_t pairs = 0;
      const Primitive first = first_primitive(kind), second = second_primitive(kind);
      for (int a = 0; a < int(primitive_count(soup.mesh, first)); ++a)
        for (int b = first == second ? a + 1 : 0; b < int(primitive_count(soup.mesh, second)); ++b) {
          const LeftOut reason = left_out(rules, soup.mesh, distances, kind, a, b);
          ++counts[reason], ++pairs;
          if (reason == LeftOut::no)
            busy[std::size_t(first)][std::size_t(a)] = busy[std::size_t(second)][std::size_t(b)] = true;
        }
      if (kind == kEdgeFace) continue;  // in no count, but what may meet that way has a box
      const FilterCounts& all = mesh.filter_counts();
      const PairFilterCounts& plan = kind == PairKind::vertex_face ? all.vertex_face : all.edge_edge;
      CAPTURE(round, int(kind));
      CHECK(plan.pairs == pairs);
      CHECK(plan.masked == counts[LeftOut::masked]);
      CHECK(plan.both_static == counts[LeftOut::both_static]);
      CHECK(plan.same_body == counts[LeftOut::same_body]);
      CHECK(plan.adjacent == counts[LeftOut::adjacent]);
      CHECK(plan.excluded == counts[LeftOut::by_name]);
      CHECK(plan.within_rings == counts[LeftOut::within_rings]);
      CHECK(plan.may_meet() == counts[LeftOut::no]);
    }
    // What may meet something is never dropped; adjacency and exclusions are not looked at for that.
    const FilterCounts& all = mesh.filter_counts();
    const PrimitiveFilterCounts* plans[] = {&all.vertices, &all.edges, &all.faces};
    for (const Primitive p : kPrimitives) {
      const auto& marks = busy[std::size_t(p)];
      const std::int64_t needed = std::count(marks.begin(), marks.end(), true);
      const PrimitiveFilterCounts& plan = *plans[std::size_t(p)];
      CHECK(plan.moving + plan.statics >= needed);
      CHECK(plan.moving + plan.statics + plan.dropped == std::int64_t(marks.size()));
    }
  }
}

TEST_CASE("what can meet nothing gets no box", "[unit]") {
  Random random(4);
  const Soup soup = scattered("triangles", 40, 0.3, 0.1, random);
  const auto mesh = [&](bool faces) {
    return Mesh(soup.mesh.num_vertices, Indices(matrix(soup.mesh.edges)),
                faces ? Indices(matrix(soup.mesh.faces)) : Indices());
  };
  const FilterCounts wires = mesh(false).filter_counts(), all = mesh(true).filter_counts();
  CHECK(wires.vertices.dropped == 120);
  CHECK(wires.edges.moving == 120);
  CHECK(all.vertices.moving == 120);
  CHECK(all.faces.moving == 40);
  Mesh rigid = mesh(true);
  set_rule(rigid, &CollisionRules::rigid_bodies, {true});
  CHECK(rigid.filter_counts().vertices.dropped == 120);
  CHECK(rigid.filter_counts().edges.dropped == 120);
  CHECK(rigid.filter_counts().faces.dropped == 40);
  CHECK(rigid.filter_counts().edge_edge.may_meet() == 0);
  Mesh still = mesh(true);
  set_rule(still, &CollisionRules::static_vertices, std::vector<bool>(120, true));
  CHECK(still.filter_counts().faces.dropped == 40);
  Mesh ghost = mesh(true);  // the first triangle is in no group
  Rules rules;
  rules.groups.assign(120, 1), rules.masks.assign(120, 1);
  rules.groups[0] = rules.groups[1] = rules.groups[2] = 0;
  ghost.set_rules(rules);
  CHECK(ghost.filter_counts().vertices.dropped == 3);
  CHECK(ghost.filter_counts().edges.dropped == 3);
  CHECK(ghost.filter_counts().faces.dropped == 1);
  CHECK(ghost.filter_counts().faces.moving == 39);
}
