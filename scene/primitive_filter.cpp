#include "scene/primitive_filter.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "scene/filter_counts.hpp"
#include "scene/pairs/vertex_rings.hpp"
#include "scene/pairs/whole_scene.hpp"
#include "scene/planes.hpp"
#include "scene/static_cache.hpp"

namespace onset {
namespace {

int vertices_each(Primitive kind) { return kind == Primitive::vertex ? 1 : kind == Primitive::edge ? 2 : 3; }

bool any_excluded_pair(const MeshData& m) {
  return std::any_of(m.excluded_pairs.begin(), m.excluded_pairs.end(),
                     [](const auto& pairs) { return !pairs.empty(); });
}

bool needs_keys(const MeshData& m) {
  const auto any = [](const std::vector<bool>& flags) {
    return std::find(flags.begin(), flags.end(), true) != flags.end();
  };
  return !m.group.empty() || any(m.is_static) || any(m.rigid) || any(m.no_self) ||
         !m.excluded_bodies.empty() || !m.excluded_vertices.empty() || any_excluded_pair(m) ||
         m.rings != nullptr;
}

std::vector<bool> marked(std::size_t size, const std::vector<std::array<int, 2>>& pairs) {
  std::vector<bool> marks(pairs.empty() ? 0 : size);
  for (const auto& pair : pairs)
    for (int i : pair) marks[std::size_t(i)] = true;
  return marks;
}

void make_keys(const MeshData& m, PrimitiveFilter& filter) {
  const int bodies = count_bodies(m);
  const std::vector<bool> body_named = marked(std::size_t(bodies), m.excluded_bodies);
  const std::vector<bool> vertex_named = marked(std::size_t(m.num_vertices), m.excluded_vertices);
  for (const Primitive kind : kPrimitives) {
    auto& keys = filter.keys[std::size_t(kind)];
    keys.resize(primitive_count(m, kind));
    for (std::size_t id = 0; id < keys.size(); ++id) {
      const std::array<int, 3> vertices = primitive_vertices(m, kind, int(id));
      const std::size_t body = m.body.empty() ? 0 : std::size_t(m.body[std::size_t(vertices[0])]);
      const bool no_self = (!m.rigid.empty() && m.rigid[body]) || (!m.no_self.empty() && m.no_self[body]);
      PrimitiveKey key{no_self ? ~int(body) : 0, 0, 0, 0};
      if (is_static(m, kind, int(id))) key.flags |= kStaticFlag;
      if (!body_named.empty() && body_named[body]) key.flags |= kExcludedFlag;
      if (m.group.empty()) key.group = key.mask = ~0u;
      for (int k = 0; k < vertices_each(kind); ++k) {
        const std::size_t v = std::size_t(vertices[std::size_t(k)]);
        if (!m.group.empty()) key.group |= m.group[v], key.mask |= m.mask[v];
        if (!vertex_named.empty() && vertex_named[v]) key.flags |= kExcludedFlag;
        if (m.rings && m.rings->has_neighbours(int(v))) key.flags |= kExcludedFlag;
      }
      keys[id] = key;
      filter.compares_keys =
          filter.compares_keys || key.body < 0 || (key.flags & kExcludedFlag) != 0 || !m.group.empty();
    }
  }
}

void flag_excluded_pairs(const MeshData& m, PrimitiveFilter& filter) {
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge, PairKind::vertex_edge, kEdgeFace})
    for (const auto& [a, b] : m.excluded_pairs[std::size_t(kind)]) {
      filter.keys[std::size_t(first_primitive(kind))][std::size_t(a)].flags |= kExcludedFlag;
      filter.keys[std::size_t(second_primitive(kind))][std::size_t(b)].flags |= kExcludedFlag;
      filter.compares_keys = true;
    }
}

std::vector<int> listed(const std::vector<bool>& marks) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) ids.push_back(int(i));
  return ids;
}

// Fills the lists where rules keep no two primitives apart: a kind without partners is dropped as a whole.
void list_kinds(const MeshData& m, PrimitiveFilter& filter) {
  const bool faces = m.num_vertices > 0 && !m.faces.empty();
  const bool in_plane = m.dimension == 2 && !m.edges.empty();
  const bool edges = m.edges.size() > 1 || (faces && !m.edges.empty()) || in_plane;
  const std::array<bool, 3> needed{faces || in_plane, edges, faces};
  const std::array<PrimitiveFilterCounts*, 3> counts{&filter.counts.vertices, &filter.counts.edges,
                                                     &filter.counts.faces};
  for (const Primitive kind : kPrimitives) {
    const std::size_t k = std::size_t(kind), count = primitive_count(m, kind);
    (needed[k] ? counts[k]->moving : counts[k]->dropped) = std::int64_t(count);
    if (!needed[k] && count > 0) filter.all = false;
  }
  if (filter.all) return;
  for (const Primitive kind : kPrimitives) {
    auto& ids = filter.moving[std::size_t(kind)];
    if (needed[std::size_t(kind)]) ids.resize(primitive_count(m, kind));
    std::iota(ids.begin(), ids.end(), 0);
  }
}

void list_primitives(const MeshData& m, const std::array<std::vector<bool>, 3>& idle,
                     PrimitiveFilter& filter) {
  const std::array<PrimitiveFilterCounts*, 3> counts{&filter.counts.vertices, &filter.counts.edges,
                                                     &filter.counts.faces};
  filter.all = false;
  for (const Primitive kind : kPrimitives) {
    const std::size_t k = std::size_t(kind);
    for (std::size_t id = 0; id < idle[k].size(); ++id)
      if (!idle[k][id]) (is_static(m, kind, int(id)) ? filter.statics : filter.moving)[k].push_back(int(id));
    *counts[k] = {std::int64_t(filter.moving[k].size()), std::int64_t(filter.statics[k].size()),
                  std::int64_t(idle[k].size() - filter.moving[k].size() - filter.statics[k].size())};
  }
}

void list_vertices(const MeshData& m, PrimitiveFilter& filter) {
  std::vector<bool> moving(std::size_t(m.num_vertices)), stays(std::size_t(m.num_vertices));
  for (const Primitive kind : kPrimitives)
    for (const auto& [ids, used] : {std::pair(&filter.moving[std::size_t(kind)], &moving),
                                    {&filter.statics[std::size_t(kind)], &stays}})
      for (int id : *ids)
        for (int v : primitive_vertices(m, kind, id)) (*used)[std::size_t(v)] = true;
  filter.moving_vertices = listed(moving), filter.static_vertices = listed(stays);
}

bool named(const std::vector<std::array<int, 2>>& pairs, int a, int b) {
  return std::binary_search(pairs.begin(), pairs.end(), std::array<int, 2>{std::min(a, b), std::max(a, b)});
}

}  // namespace

bool scene_has_static(const MeshData& mesh) {
  return mesh.whole ? mesh.whole->has_static : mesh.filter->has_static();
}

void finish_mesh(MeshData& mesh) {
  auto filter = std::make_shared<PrimitiveFilter>();
  if (needs_keys(mesh)) make_keys(mesh, *filter), flag_excluded_pairs(mesh, *filter);
  std::array<std::vector<bool>, 3> idle;
  if (mesh.whole)  // its partners may be in other parts
    for (const Primitive kind : kPrimitives) idle[std::size_t(kind)].resize(primitive_count(mesh, kind));
  else
    count_filtered(mesh, *filter, idle);
  if (filter->keeps_apart())
    list_primitives(mesh, idle, *filter);
  else
    list_kinds(mesh, *filter);
  if (!filter->all) list_vertices(mesh, *filter);
  for (std::size_t v = 0; v < mesh.is_static.size(); ++v)
    (mesh.is_static[v] ? filter->static_ids : filter->free_ids).push_back(int(v));
  mesh.static_cache = filter->has_static() ? std::make_shared<StaticCache>() : nullptr;
  mesh.mesh_planes = make_planes(mesh);
  mesh.broad_phases = std::make_shared<BroadPhasePool>();
  mesh.turning_scenes = std::make_shared<TurningScenePool>();
  mesh.filter = std::move(filter);
}

std::shared_ptr<const PrimitiveFilter> all_primitives() {
  static const auto filter = std::make_shared<const PrimitiveFilter>();
  return filter;
}

bool share_vertex(const MeshData& mesh, PairKind kind, int a, int b) {
  const auto first = primitive_vertices(mesh, first_primitive(kind), a);
  const auto second = primitive_vertices(mesh, second_primitive(kind), b);
  for (int v : first)
    if (std::find(second.begin(), second.end(), v) != second.end()) return true;
  return false;
}

bool excluded_by_name(const MeshData& mesh, PairKind kind, int a, int b) {
  const auto& pairs = mesh.excluded_pairs[std::size_t(kind)];
  const std::array<int, 2> ids = kind == PairKind::edge_edge
                                     ? std::array<int, 2>{std::min(a, b), std::max(a, b)}
                                     : std::array<int, 2>{a, b};
  if (std::binary_search(pairs.begin(), pairs.end(), ids)) return true;
  const auto first = primitive_vertices(mesh, first_primitive(kind), a);
  const auto second = primitive_vertices(mesh, second_primitive(kind), b);
  if (!mesh.excluded_bodies.empty() &&
      named(mesh.excluded_bodies, mesh.body[std::size_t(first[0])], mesh.body[std::size_t(second[0])]))
    return true;
  for (int v : first)
    for (int w : second)
      if (named(mesh.excluded_vertices, v, w)) return true;
  return false;
}

bool excluded(const MeshData& mesh, PairKind kind, int a, int b) {
  return excluded_by_name(mesh, kind, a, b) || within_rings(mesh, kind, a, b);
}

bool may_meet(const MeshData& mesh, PairKind kind, int a, int b) {
  if (mesh.filter->keeps_apart()) {
    const PrimitiveKey& x = mesh.filter->keys[std::size_t(first_primitive(kind))][std::size_t(a)];
    const PrimitiveKey& y = mesh.filter->keys[std::size_t(second_primitive(kind))][std::size_t(b)];
    if (!keys_meet(x, y)) return false;
    if ((x.flags & y.flags & kExcludedFlag) != 0 && excluded(mesh, kind, a, b)) return false;
  }
  return !share_vertex(mesh, kind, a, b);
}

}  // namespace onset
