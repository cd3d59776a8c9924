#include "scene/planes.hpp"

#include <algorithm>
#include <cmath>

#include "base/float_environment.hpp"
#include "scene/pairs/whole_scene.hpp"

namespace onset {
namespace {

// A scaled component that underflows is off by half of the smallest number; 2^-1022 is more than any of
// those.
MeshPlane scaled(const Plane& plane) {
  MeshPlane r;
  r.normal = plane.normal, r.offset = plane.offset;
  const auto& n = plane.normal;
  r.exponent = std::ilogb(std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])}));
  double squares = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    r.scaled[a] = std::ldexp(n[a], -r.exponent);
    r.magnitude[a] = n[a] == 0 ? 0 : std::max(std::fabs(r.scaled[a]), 0x1p-1022);
    squares += r.magnitude[a] * r.magnitude[a];
    r.sum += r.magnitude[a];
  }
  r.length = std::sqrt(squares) * (1 + 0x1p-50);
  r.sum *= 1 + 0x1p-50;
  r.scaled_offset = std::ldexp(plane.offset, -r.exponent);
  return r;
}

}  // namespace

bool may_meet_plane(const MeshData& mesh, int vertex, int plane) {
  const std::size_t v = std::size_t(vertex);
  if (mesh.whole && mesh.whole->owner(Primitive::vertex, vertex) != mesh.whole->here) return false;
  if (!mesh.is_static.empty() && mesh.is_static[v]) return false;
  const Plane& p = mesh.planes[std::size_t(plane)];
  const std::uint32_t group = mesh.group.empty() ? ~0u : mesh.group[v];
  const std::uint32_t mask = mesh.mask.empty() ? ~0u : mesh.mask[v];
  if ((group & p.mask) == 0 || (p.group & mask) == 0) return false;
  const auto& excluded = mesh.excluded_pairs[std::size_t(PairKind::vertex_plane)];
  return !std::binary_search(excluded.begin(), excluded.end(), std::array<int, 2>{vertex, plane});
}

std::shared_ptr<const MeshPlanes> make_planes(const MeshData& mesh) {
  if (mesh.planes.empty()) return nullptr;
  auto planes = std::make_shared<MeshPlanes>();
  for (std::size_t p = 0; p < mesh.planes.size(); ++p) {
    MeshPlane row = in_float_environment(scaled, mesh.planes[p]);
    for (int v = 0; v < mesh.num_vertices; ++v)
      if (may_meet_plane(mesh, v, int(p))) row.vertices.push_back(v);
    row.all = row.vertices.size() == std::size_t(mesh.num_vertices);
    if (row.all) row.vertices = {};
    planes->rows.push_back(std::move(row));
  }
  return planes;
}

}  // namespace onset
