#include "scene/pairs/separation.hpp"

#include <algorithm>

#include "scene/motion/motion.hpp"
#include "scene/primitive.hpp"

namespace onset {
namespace {

// Returns what the bodies of two vertices have to keep, thickness apart.
double of_bodies(const MeshData& mesh, const Options& options, int v, int w) {
  const auto body = [&](int vertex) { return mesh.body.empty() ? 0 : mesh.body[std::size_t(vertex)]; };
  const int a = std::min(body(v), body(w)), b = std::max(body(v), body(w));
  const auto before = [](const SeparationOfBodies& s, const std::array<int, 2>& bodies) {
    return std::array<int, 2>{s.first, s.second} < bodies;
  };
  const auto& all = mesh.body_separations;
  const auto at = std::lower_bound(all.begin(), all.end(), std::array<int, 2>{a, b}, before);
  return at != all.end() && at->first == a && at->second == b ? at->separation : options.min_separation;
}

}  // namespace

double largest_of_bodies(const MeshData& mesh, const Options& options) {
  double r = options.min_separation;
  for (const SeparationOfBodies& s : mesh.body_separations) r = std::max(r, s.separation);
  return r;
}

// Where nothing is added the value is exact.
double separation_of_pair(const MeshData& mesh, const Options& options, const RestLimits* rest, PairKind kind,
                          IdPair pair, const int* v) {
  const int side = points_of_first_side(kind);
  double r = mesh.body_separations.empty() ? options.min_separation : of_bodies(mesh, options, v[0], v[side]);
  if (!mesh.thickness.empty())
    r = with_thickness(r, thickest(mesh, v, v + side), thickest(mesh, v + side, v + 4));
  return rest ? std::min(r, rest->of(kind, pair)) : r;
}

}  // namespace onset
