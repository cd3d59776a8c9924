#include "tests/src/support/every_call.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "tests/src/support/call_parts.hpp"

namespace onset::tests {
namespace {

using scenes::Scene;

std::array<Point, 4> corners(const Eigen::MatrixXd& x, const std::array<int, 4>& vertices) {
  std::array<Point, 4> points;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t a = 0; a < 3; ++a) points[i][a] = x(vertices[i], Eigen::Index(a));
  return points;
}

// Every one of a list, or about `most` of them, evenly spread.
template <class T, class F>
void some_of(const std::vector<T>& list, std::size_t most, F&& f) {
  const std::size_t stride = 1 + list.size() / most;
  for (std::size_t i = 0; i < list.size(); i += stride) f(list[i]);
}

void ask_step(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(compute_collision_free_stepsize(mesh, s.scene.x_t0, s.scene.x_t1, o));
}
void ask_listed_step(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(compute_collision_free_stepsize(mesh, s.candidates, s.scene.x_t0, s.scene.x_t1, o, 0.2));
}
void ask_free(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(is_step_collision_free(mesh, s.scene.x_t0, s.scene.x_t1, o));
}

// A mesh without the rules that are not for bodies that turn.
Mesh that_may_turn(const Mesh& mesh) {
  CollisionRules rules = mesh.rules();
  if (rules.planes.empty() && rules.body_separations.empty() && rules.rest_positions.size() == 0) return mesh;
  const auto is_of_plane = [](const Pair& p) { return p.kind == PairKind::vertex_plane; };
  auto& pairs = rules.excluded_pairs;
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_of_plane), pairs.end());
  rules.planes.clear(), rules.body_separations.clear();
  rules.rest_positions = {};
  Mesh plain = mesh;
  plain.set_rules(rules);
  return plain;
}

// The first component turns, unless it is static, and all others go where they would.
RigidTrajectory turning(const Mesh& mesh, const Subject& s) {
  RigidTrajectory trajectory(s.scene.x_t0, s.scene.x_t1);
  const std::vector<int> parts = mesh.components();
  std::vector<int> first;
  for (std::size_t v = 0; v < parts.size(); ++v)
    if (parts[v] == 0) first.push_back(int(v));
  trajectory.add_body(first, {0.3, 0.9, -0.2}, {0.05, 0, 0.1}, {0.5, 0.25, 0});
  return trajectory;
}
void ask_turning_step(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  const RigidTrajectory trajectory = turning(mesh, s);
  const int v = 0;
  double x[3], strays;
  trajectory.positions(0.3, &v, 1, x);
  trajectory.straying(0.2, 0.3, &v, 1, &strays);
  a.add(x[0], x[1], x[2], strays, trajectory.at(0.3)(0, 0), trajectory.num_vertices(), trajectory.body(0));
  a.add(compute_collision_free_stepsize(that_may_turn(mesh), trajectory, o));
}
void ask_turning_free(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(is_step_collision_free(that_may_turn(mesh), turning(mesh, s), o));
}
void ask_turning_set(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(construct_active_set(that_may_turn(mesh), turning(mesh, s), o));
}

void ask_active_set(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  const ActiveSet set = construct_active_set(mesh, s.scene.x_t0, s.scene.x_t1, o);
  a.add(set, set.size(), set.empty());
  for (const Contact& contact : set) a.add(contact.toi);
  if (const Contact* first = set.earliest()) a.add(*first);
}
void ask_exact_set(const Mesh& mesh, const Subject& s, const Options& options, Answer& a) {
  Options o = options;
  o.exactness = Exactness::exact;
  ask_active_set(mesh, s, o, a);
}
void ask_window(const Mesh& mesh, const Subject& s, const Options& options, Answer& a) {
  Options o = options;
  o.window = 0.01;
  o.memory_limit = 256 * 8;
  a.add(construct_active_set(mesh, s.scene.x_t0, s.scene.x_t1, o));
}

void ask_candidates(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(compute_candidates(mesh, s.scene.x_t0, s.scene.x_t1, o));
}
void ask_count(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  const Candidates counted = count_candidates(mesh, s.scene.x_t0, s.scene.x_t1, o);
  a.add(counted, counted.counts.total());
}
// The visitor is called in any order: what it sees is added up.
void ask_visit(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  std::atomic<std::uint64_t> sum{0};
  const auto visit = [&](PairKind kind, const std::array<int, 2>* pairs, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) sum += Answer().add(kind, pairs[i]).hash();
  };
  a.add(visit_candidates(mesh, s.scene.x_t0, s.scene.x_t1, visit, o));
  if (a.outcome == Outcome::free) a.add(sum.load());
}

void ask_line_search(const Mesh& mesh, const Subject& s, const Options& options, Answer& a) {
  LineSearchOptions o = options;
  o.d_hat = s.d_hat;
  LineSearch made(mesh, s.scene.x_t0, s.dx, o);
  LineSearch search;
  search = std::move(made);
  a.add(search.candidates(), search.close_candidates());
  a.add(search.close_pairs(0.5));
  a.add(search.largest_step(0.3));
  a.add(search.largest_step());
}
// Where it may hold nothing, it finds its pairs again for each question.
void ask_short_line_search(const Mesh& mesh, const Subject& s, const Options& options, Answer& a) {
  Options o = options;
  o.memory_limit = 100;
  a.add(LineSearch(mesh, s.scene.x_t0, s.dx, o).largest_step());
}

void ask_close_pairs(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  const ClosePairs close = close_pairs(mesh, s.scene.x_t0, s.d_hat, o);
  a.add(close, close.size());
  for (const ClosePair& pair : close) a.add(pair.gap);
}
void ask_safe(const Mesh& mesh, const Subject& s, const Options&, Answer& a) {
  const std::vector<double> safe = safe_distances(mesh, s.scene.x_t0, s.close);
  a.add(safe, safe_step(safe, s.dx));
}
void ask_cfl(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(compute_cfl_stepsize(mesh, s.scene.x_t0, s.scene.x_t1, s.close, o));
}

void ask_truncate(const Mesh& mesh, const Subject& s, const Options& options, Answer& a) {
  TruncateOptions o = options;
  a.add(truncate_step(mesh, s.scene.x_t0, s.scene.x_t1, o));
  o.d_hat = s.d_hat;
  a.add(truncate_step(mesh, s.scene.x_t0, s.scene.x_t1, o));
}

void ask_constraints(const Mesh& mesh, const Subject& s, const Options&, Answer& a) {
  std::vector<int> full;
  for (int v = 0; v < mesh.num_vertices(); ++v) full.push_back(2 * v + 1);
  for (const Constraints& c : {assemble_constraints(s.set), assemble_constraints(s.set, 1e-3, full)})
    a.add(c, c.rows());
}

void ask_match(const Mesh&, const Subject& s, const Options&, Answer& a) {
  std::vector<Pair> some(s.set.contacts.begin(), s.set.contacts.end());
  if (!some.empty()) some.erase(some.begin());
  a.add(match(s.set, s.set), match(s.close, s.close), match(some, {some.rbegin(), some.rend()}));
}

// Each vertex is between two nodes, the dofs of which are its coordinates and those of the next.
void ask_vertex_map(const Mesh& mesh, const Subject& s, const Options&, Answer& a) {
  const int n = int(mesh.num_vertices());
  Eigen::SparseMatrix<double> weights(n, n);
  for (int v = 0; v < n; ++v) weights.insert(v, v) = 0.7, weights.insert(v, (v + 1) % n) = 0.3;
  const VertexMap map(n, weights);
  map.require_dimension(map.dimension());
  a.add(map.num_dofs(), map.positions(s.scene.x_t0), map.rounding(s.scene.x_t0, s.scene.x_t1));
  a.add(assemble_constraints(s.set, 0, map), map.constraints(assemble_constraints(s.set)));
  a.add(map.to_dofs(Eigen::VectorXd(Eigen::VectorXd::Constant(3 * n, 0.1))));
  const Eigen::SparseMatrix<double> hessian = map.to_dofs(map.matrix());
  a.add(std::vector<double>(hessian.valuePtr(), hessian.valuePtr() + hessian.nonZeros()),
        std::vector<int>(hessian.innerIndexPtr(), hessian.innerIndexPtr() + hessian.nonZeros()));
}

// A tetrahedron on each face, all with one tip.
void ask_tetrahedra(const Mesh& mesh, const Subject& s, const Options&, Answer& a) {
  const Eigen::Index n = s.scene.x_t0.rows();
  Eigen::MatrixXi T(mesh.num_faces(), 4);
  T << s.scene.faces, Eigen::VectorXi::Constant(T.rows(), int(n));
  Eigen::MatrixXd x(n + 1, 3);
  x << s.scene.x_t0, Eigen::RowVector3d(0.25, 7, 0.5);
  const TetrahedraSurface surface = surface_of_tetrahedra(T, x);
  a.add(surface, surface_of_tetrahedra(T, n + 1), surface.mesh().num_edges());
}

void ask_intersections(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  const Intersections found = intersections(mesh, s.scene.x_t1, o);
  a.add(found, found.size(), found.empty(), found.count(IntersectionKind::touching));
  for (const Intersection& p : found) a.add(p.edge);
}
void ask_has_intersections(const Mesh& mesh, const Subject& s, const Options& o, Answer& a) {
  a.add(has_intersections(mesh, s.scene.x_t1, o));
}
void ask_check(const Mesh& mesh, const Subject& s, const Options& options, Answer& a) {
  Options o = options;
  o.min_separation = 0.5 * s.d_hat;
  const StartReport report = check(mesh, s.scene.x_t0, o);
  a.add(report, report.acceptable(), report.clean());
  a.add(duplicate_vertices(s.scene.x_t0));
}

void ask_queries(const Mesh&, const Subject& s, const Options& options, Answer& a) {
  for (const Exactness exactness : {Exactness::certify, Exactness::exact}) {
    Options o = options;
    o.exactness = exactness;
    for (const VertexFaceQuery& q : s.vertex_face) {
      const QueryResult r = vertex_face_ccd(q, o);
      a.add(r, r.collides());
    }
    for (const EdgeEdgeQuery& q : s.edge_edge) a.add(edge_edge_ccd(q, o));
  }
}

// A third is another double in each mode of rounding.
void ask_environment(const Mesh&, const Subject& s, const Options&, Answer& a) {
  in_default_float_environment([&] { a.add(s.d_hat / 3); });
}

}  // namespace

Subject::Subject(std::string name, Scene scene, CollisionRules rules, double d_hat_share)
    : name(std::move(name)), scene(std::move(scene)), rules(std::move(rules)) {
  const Scene& at = this->scene;
  dx = at.x_t1 - at.x_t0;
  d_hat = d_hat_share * (at.x_t0.maxCoeff() - at.x_t0.minCoeff()) + 1e-12;
  const Mesh clean = mesh();
  set = construct_active_set(clean, at.x_t0, at.x_t1);
  close = close_pairs(clean, at.x_t0, d_hat);
  candidates = compute_candidates(clean, at.x_t0, at.x_t1);
  safe = safe_distances(clean, at.x_t0, close);
  const auto add = [&](const Pair& p) {
    if (p.kind == PairKind::vertex_plane) return;
    const auto t0 = corners(at.x_t0, p.vertices), t1 = corners(at.x_t1, p.vertices);
    if (p.kind == PairKind::vertex_face)
      vertex_face.push_back({t0, t1});
    else
      edge_edge.push_back({t0, t1});
  };
  some_of(set.contacts, 20, add), some_of(close.pairs, 20, add);
}

std::vector<Subject> small_subjects() {
  scenes::Random random(11);
  std::vector<Subject> all;
  all.emplace_back("soup", scenes::triangle_soup(14, 0.5, 0.6, random));

  // A sphere falls onto a cube that does not move, beside two points.
  Scene falling = scenes::sphere_onto_cube(2, 4, 0.25, 0.75);
  falling.x_t0.conservativeResize(20, 3), falling.x_t1.conservativeResize(20, 3);
  falling.x_t0.bottomRows(2) << 0, 0, 1.25, 0.25, 0, 1.25;
  falling.x_t1.bottomRows(2) << 0.25, 0, 1.25, 0, 0, 1.25;
  CollisionRules rules;
  rules.points = {18, 19};
  for (int v = 0; v < 20; ++v) {
    const bool cube = v >= 10 && v < 18;
    rules.static_vertices.push_back(cube);
    rules.bodies.push_back(v < 10 ? 0 : v - 9 > 8 ? v - 16 : 1);
    rules.groups.push_back(v < 10 ? 1 : 2), rules.masks.push_back(3);
    rules.thickness.push_back(cube ? 0x1p-10 : 0x1p-8);
  }
  rules.rigid_bodies = {false, true, false, false};
  rules.bodies_without_self_collision = {true, false, false, false};
  rules.excluded_bodies = {{1, 3}};
  all.emplace_back("sphere onto static cube", falling, rules);

  // A cloth that crumples, with a seam whose copies count as one; two corners meet nothing of one edge.
  Scene seam = scenes::cloth(3, 4);
  scenes::Scene copy = scenes::translated(seam, {1, 0, 0});
  seam = scenes::joined(seam, copy);
  scenes::shake(seam, 0.5, random);
  for (const int row : {0, 1, 2}) seam.x_t1.row(12 + 4 * row) = seam.x_t1.row(4 * row + 3);
  rules = {};
  rules.weld = true;
  rules.excluded_vertices = {{0, 11}};
  rules.excluded_pairs = {{PairKind::vertex_face, 0, 20, {}}, {PairKind::edge_edge, 0, 30, {}}};
  rules.excluded_intersections = {{1, 5, IntersectionKind::crossing, {}}};
  all.emplace_back("cloth with a seam", seam, rules);

  // Two cloths, finer than what they keep of themselves and of each other.
  Scene layers = scenes::joined(scenes::cloth(3, 4), scenes::translated(scenes::cloth(3, 4), {0, 0, 0.5}));
  scenes::shake(layers, 0.5, random);
  rules = {};
  rules.bodies.assign(24, 0);
  std::fill(rules.bodies.begin() + 12, rules.bodies.end(), 1);
  rules.body_separations = {{0, 0, 0.5}, {1, 0, 0.25}};
  rules.rest_positions = layers.x_t0, rules.rest_share = 0.75;
  rules.excluded_rings = 1;
  all.emplace_back("cloths finer than their separation", layers, rules);

  // Two cubes that touch in every way from the start, and then pass through each other.
  Scene touching = scenes::translated(scenes::cube(), {1, 0, 2});
  scenes::displace(touching, {0, 0, -1});
  all.emplace_back("cube on cube", scenes::joined(touching, scenes::cube()));

  // A cloth that falls on the ground, a slope and a wall, some of it within its thickness or behind a plane.
  Scene over_planes = scenes::cloth(4, 5);
  scenes::shake(over_planes, 0.3, random);
  scenes::displace(over_planes, {0.25, 0, -1});
  rules = {};
  rules.planes = {{{0, 0, 2}, -1}, {{-0.5, 0.25, 3}, -1.5}, {{1e300, 0, 0}, -1e299}, {{0, 1, 0}, 0.125}};
  rules.planes[2].mask = 1;
  rules.thickness.assign(20, 0x1p-9);
  rules.excluded_pairs = {{PairKind::vertex_plane, 3, 0, {}}};
  all.emplace_back("cloth over planes", over_planes, rules);

  // Large enough for several tasks.
  all.emplace_back("spheres", scenes::sphere_onto_sphere(7, 9, 0.01, 0.5));
  return all;
}

const std::vector<Call>& every_call() {
  static const std::vector<Call> calls{
      {"compute_collision_free_stepsize", true, ask_step},
      {"compute_collision_free_stepsize of candidates", true, ask_listed_step},
      {"is_step_collision_free", true, ask_free},
      {"compute_collision_free_stepsize of a trajectory", true, ask_turning_step},
      {"is_step_collision_free of a trajectory", true, ask_turning_free},
      {"construct_active_set of a trajectory", true, ask_turning_set},
      {"construct_active_set", true, ask_active_set},
      {"construct_active_set, exact", true, ask_exact_set},
      {"construct_active_set, window and memory limit", true, ask_window},
      {"compute_candidates", true, ask_candidates},
      {"count_candidates", true, ask_count},
      {"visit_candidates", true, ask_visit},
      {"LineSearch", true, ask_line_search},
      {"LineSearch, memory limit", true, ask_short_line_search},
      {"close_pairs", true, ask_close_pairs},
      {"safe_distances, safe_step", false, ask_safe},
      {"compute_cfl_stepsize", true, ask_cfl},
      {"truncate_step", true, ask_truncate},
      {"assemble_constraints", false, ask_constraints},
      {"match", false, ask_match},
      {"VertexMap", false, ask_vertex_map},
      {"surface_of_tetrahedra", false, ask_tetrahedra},
      {"intersections", true, ask_intersections},
      {"has_intersections", true, ask_has_intersections},
      {"check, duplicate_vertices", true, ask_check},
      {"vertex_face_ccd, edge_edge_ccd", false, ask_queries},
      {"in_default_float_environment", false, ask_environment},
      {"in the plane: step", true, ask_plane_step},
      {"in the plane: active set", true, ask_plane_set},
      {"in the plane: check, intersections", true, ask_plane_start},
      {"in the plane: pairs, constraints, vertex_edge_ccd", false, ask_plane_pairs},
      {"Mesh", false, ask_mesh},
      {"words and counts", false, ask_words},
      {"adapter: surfaces", false, ask_surfaces},
      {"adapter: steps", false, ask_adapter},
      {"adapter: parts", false, ask_toolkit},
  };
  return calls;
}

}  // namespace onset::tests
