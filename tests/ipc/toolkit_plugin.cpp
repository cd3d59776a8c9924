// The plug-in classes of onset/compat/ipc_toolkit.hpp in ipc-toolkit's own functions, on random scenes:
// brute force's pairs, and times and steps like those of Onset's own calls, never later than the exact ones.
// Built by toolkit_plugin.py.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ipc/broad_phase/brute_force.hpp>
#include <ipc/broad_phase/lbvh.hpp>
#include <ipc/candidates/candidates.hpp>
#include <ipc/ipc.hpp>
#include <onset/compat/ipc.hpp>
#include <onset/compat/ipc_toolkit.hpp>
#include <onset/onset.hpp>
#include <random>
#include <string>
#include <vector>

namespace {

using Eigen::MatrixXd;
using Eigen::MatrixXi;
using Pairs = std::vector<std::array<int, 2>>;

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", what.c_str());
  std::exit(1);
}

struct Scene {
  MatrixXd x0, x1;
  MatrixXi edges, faces;
};

// Triangles, a chain of wires and points in the unit cube; in the plane the wires and points alone.
Scene random_scene(std::mt19937& random, int dim, double speed) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const int triangles = dim == 3 ? 12 : 0, wires = dim == 3 ? 4 : 20, points = 6;
  const int n = 3 * triangles + wires + 1 + points;
  Scene s{MatrixXd(n, dim), MatrixXd(n, dim), MatrixXi(), MatrixXi(triangles, 3)};
  for (int v = 0; v < n; ++v)
    for (int a = 0; a < dim; ++a) {
      const double centre = v < 3 * triangles && v % 3 != 0 ? s.x0(v - v % 3, a) : unit(random);
      s.x0(v, a) = v < 3 * triangles && v % 3 == 0 ? centre : centre + 0.3 * unit(random);
      s.x1(v, a) = s.x0(v, a) + speed * unit(random);
    }
  for (int f = 0; f < triangles; ++f) s.faces.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  MatrixXi chain(wires, 2);
  for (int e = 0; e < wires; ++e) chain.row(e) << 3 * triangles + e, 3 * triangles + e + 1;
  s.edges = triangles > 0 ? onset::complete_edges(chain, s.faces) : chain;
  return s;
}

template <class Candidate>
Pairs pairs_of(const std::vector<Candidate>& candidates) {
  Pairs r;
  for (const auto& c : candidates) {
    const auto& [a, b] = c;
    r.push_back({int(a), int(b)});
  }
  return r;
}

template <class Candidate>
void same_pairs(const ipc::BroadPhase& a, const ipc::BroadPhase& b,
                void (ipc::BroadPhase::*detect)(std::vector<Candidate>&) const, std::size_t& count) {
  std::vector<Candidate> first, second;
  (a.*detect)(first), (b.*detect)(second);
  Pairs ours = pairs_of(first), theirs = pairs_of(second);
  require(std::is_sorted(ours.begin(), ours.end()), "pairs are in order");
  std::sort(theirs.begin(), theirs.end());
  require(ours == theirs,
          "the pairs of brute force: " + std::to_string(ours.size()) + ", " + std::to_string(theirs.size()));
  count += ours.size();
}

std::size_t compare_broad_phases(const Scene& s, double radius, const ipc::CollisionFilter& filter,
                                 bool moving) {
  std::size_t count = 0;
  for (const auto method : {onset::BroadPhaseMethod::automatic, onset::BroadPhaseMethod::hash}) {
    onset::ipc_toolkit::BroadPhase ours(method);
    ipc::BruteForce theirs;
    for (ipc::BroadPhase* phase :
         {static_cast<ipc::BroadPhase*>(&ours), static_cast<ipc::BroadPhase*>(&theirs)}) {
      phase->can_vertices_collide = filter;
      if (moving)
        phase->build(s.x0, s.x1, s.edges, s.faces, radius);
      else
        phase->build(s.x0, s.edges, s.faces, radius);
    }
    same_pairs(ours, theirs, &ipc::BroadPhase::detect_vertex_vertex_candidates, count);
    same_pairs(ours, theirs, &ipc::BroadPhase::detect_edge_vertex_candidates, count);
    same_pairs(ours, theirs, &ipc::BroadPhase::detect_edge_edge_candidates, count);
    same_pairs(ours, theirs, &ipc::BroadPhase::detect_face_vertex_candidates, count);
    same_pairs(ours, theirs, &ipc::BroadPhase::detect_edge_face_candidates, count);
    same_pairs(ours, theirs, &ipc::BroadPhase::detect_face_face_candidates, count);
  }
  return count;
}

// The exact first contact of the whole scene, rounded down.
double exact_first_contact(const onset::ipc::CollisionMesh& mesh, const Scene& s) {
  onset::Options options;
  options.exactness = onset::Exactness::exact;
  return onset::compute_collision_free_stepsize(mesh.onset_mesh(), s.x0, s.x1, options).toi_hi;
}

struct Tally {
  std::size_t pairs = 0, queries = 0, impacts = 0, contacts = 0;
  double least = INFINITY, most = 0;
};

void compare_steps(const Scene& s, bool filtered, double min_distance, Tally& tally) {
  ipc::CollisionMesh theirs(s.x0, s.edges, s.faces);
  onset::ipc::CollisionMesh ours(s.x0, s.edges, s.faces);
  if (filtered) {
    const auto may = [](std::size_t i, std::size_t j) { return (i + j) % 3 != 0; };
    theirs.can_collide = may, ours.can_collide = may;
  }
  onset::ipc_toolkit::BroadPhase broad_phase;
  ipc::BruteForce brute_force;
  const onset::ipc_toolkit::NarrowPhaseCCD ccd;
  const onset::ipc::TightInclusionCCD native_ccd;

  // ipc-toolkit's candidates, by either broad phase.
  ipc::Candidates candidates, expected;
  candidates.build(theirs, s.x0, s.x1, min_distance / 2, &broad_phase);
  expected.build(theirs, s.x0, s.x1, min_distance / 2, &brute_force);
  const auto sorted = [](Pairs p) {
    std::sort(p.begin(), p.end());
    return p;
  };
  require(sorted(pairs_of(candidates.vv_candidates)) == sorted(pairs_of(expected.vv_candidates)), "vertices");
  require(sorted(pairs_of(candidates.ev_candidates)) == sorted(pairs_of(expected.ev_candidates)),
          "edge, vertex");
  require(sorted(pairs_of(candidates.ee_candidates)) == sorted(pairs_of(expected.ee_candidates)), "edges");
  require(sorted(pairs_of(candidates.fv_candidates)) == sorted(pairs_of(expected.fv_candidates)),
          "face, vertex");

  // Each query, as the native class answers it.
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto& pair = candidates[i];
    const ipc::VectorMax12d x0 = pair.dof(s.x0, s.edges, s.faces), x1 = pair.dof(s.x1, s.edges, s.faces);
    double plugged = -1, native = -1;
    const bool hit = pair.ccd(x0, x1, plugged, min_distance, 1, ccd);
    bool native_hit = false;
    const int size = int(x0.size()) / pair.num_vertices();
    const auto p = [&](const ipc::VectorMax12d& x, int k) -> onset::ipc::VectorMax3d {
      return x.segment(k * size, size);
    };
    if (pair.num_vertices() == 2)
      native_hit = native_ccd.point_point_ccd(p(x0, 0), p(x0, 1), p(x1, 0), p(x1, 1), native, min_distance);
    else if (pair.num_vertices() == 3)
      native_hit = native_ccd.point_edge_ccd(p(x0, 0), p(x0, 1), p(x0, 2), p(x1, 0), p(x1, 1), p(x1, 2),
                                             native, min_distance);
    else if (candidates.is_edge_edge(i))
      native_hit = native_ccd.edge_edge_ccd(p(x0, 0), p(x0, 1), p(x0, 2), p(x0, 3), p(x1, 0), p(x1, 1),
                                            p(x1, 2), p(x1, 3), native, min_distance);
    else
      native_hit = native_ccd.point_triangle_ccd(p(x0, 0), p(x0, 1), p(x0, 2), p(x0, 3), p(x1, 0), p(x1, 1),
                                                 p(x1, 2), p(x1, 3), native, min_distance);
    require(hit == native_hit && plugged == native, "a query is answered as by the native class");
    double limited = -1;
    require(pair.ccd(x0, x1, limited, min_distance, 0.5, ccd) == (plugged <= 0.5), "tmax");
    ++tally.queries, tally.impacts += hit;
  }

  // The step of ipc-toolkit's own function.
  const double exact = filtered || min_distance > 0 ? INFINITY : exact_first_contact(ours, s);
  const double step =
      ipc::compute_collision_free_stepsize(theirs, s.x0, s.x1, min_distance, &broad_phase, ccd);
  const double native = onset::ipc::compute_collision_free_stepsize(ours, s.x0, s.x1, min_distance);
  require(step >= 0 && step <= 1 && step <= exact, "the step is not late");
  if (native > 0) {
    tally.least = std::min(tally.least, step / native), tally.most = std::max(tally.most, step / native);
    // Both keep a fifth of each gap; each may report a pair within its tolerance of that.
    require(std::fabs(step - native) < 1e-3,
            "the step is that of the native call: " + std::to_string(step) + ", " + std::to_string(native));
  }
  const MatrixXd stepped = s.x0 + step * (s.x1 - s.x0);
  require(onset::ipc::is_step_collision_free(ours, s.x0, stepped, min_distance) || native == 0,
          "the step is free");
  if (ipc::is_step_collision_free(theirs, s.x0, s.x1, min_distance, &broad_phase, ccd))
    require(onset::ipc::is_step_collision_free(ours, s.x0, s.x1, min_distance), "whole steps are free");
  tally.contacts += step < 1;
}

void refuse_what_is_not_finite() {
  const Scene s = [] {
    std::mt19937 random(1);
    return random_scene(random, 3, 0.1);
  }();
  const ipc::CollisionMesh mesh(s.x0, s.edges, s.faces);
  onset::ipc_toolkit::BroadPhase broad_phase;
  for (const double bad : {double(NAN), double(INFINITY)})
    for (const bool at_start : {false, true}) {
      MatrixXd other = s.x1;
      other(3, 1) = bad;
      bool thrown = false;
      try {
        ipc::compute_collision_free_stepsize(mesh, at_start ? other : s.x0, at_start ? s.x0 : other, 0,
                                             &broad_phase, onset::ipc_toolkit::NarrowPhaseCCD());
      } catch (const std::runtime_error&) {
        thrown = true;
      }
      require(thrown, "positions that are not finite are refused");
    }
  double toi = -1;
  const Eigen::Vector3d a(0, 0, 1), b(0, NAN, 0);
  require(onset::ipc_toolkit::NarrowPhaseCCD().point_point_ccd(a, a, b, a, toi) && toi == 0, "NaN is at 0");
}

}  // namespace

int main() {
  std::mt19937 random(20);
  Tally tally;
  for (int i = 0; i < 60; ++i) {
    const int dim = i % 3 == 2 ? 2 : 3;
    const Scene s = random_scene(random, dim, i % 2 == 0 ? 0.5 : 0.05);
    ipc::CollisionFilter filter;
    if (i % 4 == 1) filter = [](std::size_t a, std::size_t b) { return (a + b) % 2 == 0; };
    tally.pairs += compare_broad_phases(s, i % 5 == 0 ? 0 : 0.02, filter, i % 2 == 0);
    compare_steps(s, i % 4 == 3, i % 5 == 4 ? 1e-3 : 0, tally);
  }
  refuse_what_is_not_finite();
  std::printf(
      "%zu pairs of boxes, %zu queries, %zu with an impact, %zu of 60 steps shorter than 1; "
      "step / native step: %.6f to %.6f\n",
      tally.pairs, tally.queries, tally.impacts, tally.contacts, tally.least, tally.most);
  require(tally.pairs > 1000 && tally.queries > 1000 && tally.impacts > 100 && tally.contacts > 20,
          "there was enough to compare");
}
