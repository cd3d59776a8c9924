#include "onset/query.hpp"

#include <algorithm>
#include <cmath>

#include "base/float_environment.hpp"
#include "narrowphase/corners.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "src/shared/checked_options.hpp"
#include "src/shared/contacts.hpp"

namespace onset {
namespace {

MeshData single_pair(PairKind kind) {
  MeshData mesh;
  mesh.num_vertices = 4;
  if (kind == PairKind::vertex_face)
    mesh.faces = {{1, 2, 3}};
  else if (kind == PairKind::edge_edge)
    mesh.edges = {{0, 1}, {2, 3}};
  else
    mesh.edges = {{1, 2}}, mesh.dimension = 2;
  return mesh;
}

QueryResult solve(PairKind kind, const std::array<Point, 4>& t0, const std::array<Point, 4>& t1,
                  const Options& options) {
  static const MeshData kMeshes[] = {single_pair(PairKind::vertex_face), single_pair(PairKind::edge_edge),
                                     single_pair(PairKind::vertex_edge)};
  check(options);
  Motion motion;
  motion.num_vertices = 4;
  motion.in_plane = kind == PairKind::vertex_edge;
  motion.x = AlignedArray<double>(4 * kMotionStride);
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t a = 0; a < 4; ++a) {
      motion.x[kMotionStride * v + a] = a < 3 ? t0[v][a] : 0;
      motion.x[kMotionStride * v + 4 + a] = a < 3 ? t1[v][a] : 0;
    }
  finish_motion(motion);
  const IdPair pair = kind == PairKind::edge_edge ? IdPair{0, 1} : IdPair{0, 0};
  const int vertices[4] = {0, 1, 2, kind == PairKind::vertex_edge ? 2 : 3};
  QueryResult r;
  static_cast<Pair&>(r) = {kind, pair.a, pair.b, {0, 1, 2, vertices[3]}};
  if (motion.status != Outcome::free) {
    r.outcome = motion.status == Outcome::non_finite ? PairOutcome::non_finite : PairOutcome::out_of_range;
    r.toi = r.step_limit = 0;
    return r;
  }
  const MeshData& mesh = kMeshes[std::size_t(kind)];
  const Corners corners = make_corners(kind, motion, vertices);
  double largest = 0;
  for (const auto& end : corners.c)
    for (const auto& corner : end)
      for (const double x : corner) largest = std::max(largest, std::fabs(x));
  const double extent = largest * corners.unit;
  const bool exact_times = options.exactness == Exactness::exact;
  const NarrowPhase narrow({mesh, motion, absolute_tolerance(options, extent), extent, options, exact_times});
  NarrowPhaseScratch scratch;
  std::vector<PairResult> found;
  narrow.process(kind, &pair, 1, {}, scratch, found);
  r.checks = scratch.stats.checks;
  if (found.empty()) return r;
  put(found[0], r);
  const bool parting = r.outcome == PairOutcome::initial_separating;
  ContactGeometry geometry;
  contact_geometries(options.instruction_set, kind, motion, &r.vertices, &r.toi, &parting, 1, &geometry);
  put(geometry, r);
  return r;
}

}  // namespace

QueryResult vertex_face_ccd(const VertexFaceQuery& q, const Options& options) {
  return in_float_environment(solve, PairKind::vertex_face, q.t0, q.t1, options);
}
QueryResult edge_edge_ccd(const EdgeEdgeQuery& q, const Options& options) {
  return in_float_environment(solve, PairKind::edge_edge, q.t0, q.t1, options);
}
QueryResult vertex_edge_ccd(const VertexEdgeQuery& q, const Options& options) {
  std::array<Point, 4> t0{}, t1{};
  for (std::size_t i = 0; i < 4; ++i)  // the last row repeats the one before: four points, three of them used
    for (std::size_t a = 0; a < 2; ++a) t0[i][a] = q.t0[i < 3 ? i : 2][a], t1[i][a] = q.t1[i < 3 ? i : 2][a];
  return in_float_environment(solve, PairKind::vertex_edge, t0, t1, options);
}

}  // namespace onset
