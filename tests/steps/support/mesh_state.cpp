#include "tests/steps/support/mesh_state.hpp"

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/src/support/mesh_pairs.hpp"

namespace onset::tests {

using scenes::Query;

static bool touches(const Query& at_rest) {
  return !oracle::boxes_apart(at_rest, 0) && oracle::orientation(at_rest.kind, at_rest.t0) == 0 &&
         oracle::compare_distance(at_rest, 0, 0) == 0;
}

// As the way of a vertex from one end of the edge to the other.
static bool pierces(const Mesh& mesh, int edge, int face, const Eigen::MatrixXd& x) {
  const auto e = mesh.edge(edge);
  const auto f = mesh.face(face);
  for (int v : f)
    if (v == e[0] || v == e[1]) return false;
  Query way = query_of(PairKind::vertex_face, {e[0], f[0], f[1], f[2]}, x, x);
  for (std::size_t k = 0; k < 3; ++k) way.t1[0][k] = x(e[1], Eigen::Index(k));
  if (oracle::boxes_apart(way, 0)) return false;
  const int from = oracle::orientation(way.kind, way.t0), to = oracle::orientation(way.kind, way.t1);
  return (from == 0 || from != to) && oracle::exact_ccd(way).collides;
}

std::string meets_itself(const Mesh& mesh, const Eigen::MatrixXd& x) {
  std::string found;
  const auto note = [&](const char* what, int a, int b) {
    if (found.empty()) found = what + std::to_string(a) + " and " + std::to_string(b);
  };
  for_all_pairs(mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    if (touches(query_of(kind, v, x, x)))
      note(kind == PairKind::vertex_face ? "touches: vertex and face " : "touches: edges ", a, b);
  });
  for (int e = 0; e < mesh.num_edges(); ++e)
    for (int f = 0; f < mesh.num_faces(); ++f)
      if (pierces(mesh, e, f, x)) note("pierces: edge and face ", e, f);
  return found;
}

}  // namespace onset::tests
