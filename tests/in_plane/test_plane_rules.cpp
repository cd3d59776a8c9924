// The rules of a scene on meshes in the plane: what is left out, by every broad phase, and how much.
#include "tests/catch.hpp"
#include "tests/in_plane/support/plane_scenes.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

using Pairs = std::vector<std::array<int, 2>>;

Pairs listed(const Mesh& mesh, const PlaneScene& s, BroadPhaseMethod method) {
  Options options;
  options.broad_phase = method;
  options.min_separation = 100;  // boxes reach everywhere
  return compute_candidates(mesh, s.x_t0, s.x_t1, options).vertex_edge;
}

// Compares what each broad phase lists where boxes keep nothing apart, and the count, with a rule in words.
template <class May>
void check_pairs(const PlaneScene& s, const CollisionRules& rules, May&& may) {
  const Mesh mesh = s.mesh(rules);
  Pairs expected;
  for (int v = 0; v < s.x_t0.rows(); ++v)
    for (int e = 0; e < mesh.num_edges(); ++e) {
      const std::array<int, 2> ends = mesh.edge(e);
      if (ends[0] != v && ends[1] != v && may(v, ends)) expected.push_back({v, e});
    }
  for (const BroadPhaseMethod method :
       {BroadPhaseMethod::bvh, BroadPhaseMethod::hash, BroadPhaseMethod::brute})
    CHECK(listed(mesh, s, method) == expected);
  CHECK(mesh.filter_counts().vertex_edge.may_meet() == std::int64_t(expected.size()));
  CHECK(mesh.filter_counts().vertex_face.pairs == 0);
  CHECK(mesh.filter_counts().edge_edge.pairs == 0);
}

}  // namespace

TEST_CASE("in the plane: rules leave out the pairs that they name") {
  scenes::Random random(oracle::fuzz_seed());
  for (int run = 0; run < 20; ++run) {
    PlaneScene s = polygons(5, 0, random);
    s.x_t1 = s.x_t0;
    const std::vector<int> body = s.mesh().components();
    const std::size_t bodies = std::size_t(*std::max_element(body.begin(), body.end()) + 1);
    const std::size_t V = std::size_t(s.x_t0.rows());
    const auto of = [&](int v) { return body[std::size_t(v)]; };
    CollisionRules rules;
    check_pairs(s, rules, [](int, const auto&) { return true; });

    rules.bodies = body;
    rules.rigid_bodies.assign(bodies, false), rules.rigid_bodies[1] = true;
    rules.excluded_bodies = {{0, 2}};
    const auto bodies_meet = [&](int v, const std::array<int, 2>& e) {
      const int b = of(v), c = of(e[0]);
      return !(b == 1 && c == 1) && !(b + c == 2 && b != c);
    };
    check_pairs(s, rules, bodies_meet);

    rules.groups.resize(V), rules.masks.resize(V);
    for (std::size_t v = 0; v < V; ++v)
      rules.groups[v] = 1u << (body[v] % 3), rules.masks[v] = body[v] == 3 ? 1 : 7;
    rules.excluded_vertices = {{0, 5}};
    rules.excluded_pairs = {{PairKind::vertex_edge, int(V) - 1, 0, {}}};
    const auto meet = [&](int v, const std::array<int, 2>& e) {
      const std::uint32_t g = rules.groups[std::size_t(v)], m = rules.masks[std::size_t(v)];
      std::uint32_t eg = 0, em = 0;
      for (const int w : e) eg |= rules.groups[std::size_t(w)], em |= rules.masks[std::size_t(w)];
      if ((g & em) == 0 || (eg & m) == 0 || !bodies_meet(v, e)) return false;
      for (const int w : e)
        if (std::minmax(v, w) == std::pair<const int&, const int&>(0, 5)) return false;
      return !(v == int(V) - 1 && e == std::array<int, 2>{s.edges(0, 0), s.edges(0, 1)});
    };
    check_pairs(s, rules, meet);

    rules = {};
    rules.static_vertices.assign(V, false);
    for (std::size_t v = 0; v < V; ++v) rules.static_vertices[v] = body[v] < 2;
    check_pairs(s, rules, [&](int v, const std::array<int, 2>& e) { return of(v) >= 2 || of(e[0]) >= 2; });
  }
}

TEST_CASE("in the plane: static bodies, separations and thickness limit steps as they should") {
  // A point falls onto a static edge that keeps 1/4, by thickness and by separation.
  PlaneScene s;
  s.x_t0.resize(3, 2), s.x_t1.resize(3, 2);
  s.x_t0 << 0, 1, -1, 0, 1, 0;
  s.x_t1 << 0, -1, -1, 0, 1, 0;
  s.edges = edge_matrix({{1, 2}});
  for (const bool thick : {false, true}) {
    CollisionRules rules;
    rules.static_vertices = {false, true, true};
    Options options;
    if (thick)
      rules.thickness = {0.125, 0.125, 0.0625};
    else
      options.min_separation = 0.25;
    const Mesh mesh = s.mesh(rules);
    for (int call = 0; call < 2; ++call) {  // the second one has the static part of the first
      const StepResult r = compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, options);
      CHECK((r.step <= 0.375 && r.step > 0.374));
    }
    const ActiveSet set = construct_active_set(mesh, s.x_t0, s.x_t1, options);
    REQUIRE(set.size() == 1);
    CHECK((set[0].toi <= 0.375 && set[0].toi > 0.3749));
    CHECK((set[0].normal == std::array<double, 3>{0, 1, 0}));
  }
  Eigen::MatrixXd moved = s.x_t1;
  moved(1, 0) = 0;
  CollisionRules rules;
  rules.static_vertices = {false, true, true};
  CHECK_THROWS_AS(compute_collision_free_stepsize(s.mesh(rules), s.x_t0, moved), std::invalid_argument);
}

TEST_CASE("in the plane: declared points meet each other, and welded copies do not") {
  PlaneScene s;
  s.x_t0.resize(2, 2), s.x_t1.resize(2, 2);
  s.x_t0 << 0, 0, 4, 0;
  s.x_t1 << 2, 0, 2, 0;
  s.edges.resize(0, 2);
  CHECK(is_step_collision_free(s.mesh(), s.x_t0, s.x_t1));
  CollisionRules rules;
  rules.points = {0, 1};
  const ActiveSet set = construct_active_set(s.mesh(rules), s.x_t0, s.x_t1);
  REQUIRE(set.size() == 2);  // once from each side
  CHECK((set[0].a == 0 && set[0].b == 1 && set[1].a == 1 && set[1].b == 0));
  CHECK((set[0].toi > 0.99 && set[0].normal == std::array<double, 3>{-1, 0, 0}));

  // Two edges with a common place: copies of one vertex.
  PlaneScene seam;
  seam.x_t0.resize(4, 2);
  seam.x_t0 << 0, 0, 1, 0, 1, 0, 2, 1;
  seam.x_t1 = seam.x_t0.array() + 1;
  seam.edges = edge_matrix({{0, 1}, {2, 3}});
  CHECK(compute_collision_free_stepsize(seam.mesh(), seam.x_t0, seam.x_t1).step == 0);
  rules = {};
  rules.weld = true;
  CHECK(compute_collision_free_stepsize(seam.mesh(rules), seam.x_t0, seam.x_t1).step == 1);
}
