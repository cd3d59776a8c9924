#include "onset/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/buffer_pool.hpp"
#include "onset/intersections.hpp"
#include "scene/edges_of_faces.hpp"
#include "scene/named_pairs.hpp"
#include "scene/primitive.hpp"
#include "scene/primitive_filter.hpp"
#include "scene/static_cache.hpp"

namespace onset {
namespace {

[[noreturn]] void reject(const char* what, std::ptrdiff_t row, const std::string& why) {
  throw std::invalid_argument(std::string(what) + " row " + std::to_string(row) + ": " + why);
}

template <std::size_t N>
std::vector<std::array<int, N>> checked(const char* what, const Indices& ids, std::ptrdiff_t vertices) {
  if (ids.rows() > 0 && ids.cols() != std::ptrdiff_t(N))
    throw std::invalid_argument(std::string(what) + "s have " + std::to_string(ids.cols()) +
                                " columns, not " + std::to_string(N));
  std::vector<std::array<int, N>> result(std::size_t(ids.rows()));
  for (std::ptrdiff_t r = 0; r < ids.rows(); ++r)
    for (std::size_t c = 0; c < N; ++c) {
      const long long v = ids(r, c);
      if (v < 0 || v >= vertices)
        reject(what, r,
               "vertex " + std::to_string(v) + " is out of range, there are " + std::to_string(vertices));
      for (std::size_t k = 0; k < c; ++k)
        if (result[r][k] == v) reject(what, r, "vertex " + std::to_string(v) + " is repeated");
      result[r][c] = int(v);
    }
  return result;
}

std::ptrdiff_t checked_count(std::ptrdiff_t vertices) {
  if (vertices < 0 || vertices > std::numeric_limits<int>::max())
    throw std::invalid_argument("a mesh cannot have " + std::to_string(vertices) + " vertices");
  return vertices;
}

MeshData make_data(std::ptrdiff_t vertices, std::vector<std::array<int, 2>> edges,
                   std::vector<std::array<int, 3>> faces) {
  MeshData data;
  data.num_vertices = int(vertices);
  data.edges = std::move(edges);
  data.faces = std::move(faces);
  data.num_full_vertices = data.num_vertices;
  finish_mesh(data);
  return data;
}

}  // namespace

Mesh::Mesh(std::ptrdiff_t vertices, const Indices& edges, const Indices& faces) {
  auto E = checked<2>("edge", edges, checked_count(vertices));
  auto F = checked<3>("face", faces, vertices);
  require_edges_of_faces(E, F);
  data_ = std::make_shared<MeshData>(make_data(vertices, std::move(E), std::move(F)));
}

Mesh::Mesh(std::ptrdiff_t vertices, const Indices& faces) {
  auto F = checked<3>("face", faces, checked_count(vertices));
  data_ = std::make_shared<MeshData>(make_data(vertices, edge_list(faces), std::move(F)));
}

Mesh::Mesh(const Positions& rest, const Indices& edges, const Indices& faces)
    : Mesh(rest.rows(), edges, faces) {}
Mesh::Mesh(const Positions& rest, const Indices& faces) : Mesh(rest.rows(), faces) {}

std::ptrdiff_t Mesh::num_vertices() const { return data_->num_vertices; }
std::ptrdiff_t Mesh::num_edges() const { return std::ptrdiff_t(data_->edges.size()); }
std::ptrdiff_t Mesh::num_points() const { return data_->num_points; }
std::ptrdiff_t Mesh::num_faces() const { return std::ptrdiff_t(data_->faces.size()); }
std::array<int, 2> Mesh::edge(std::ptrdiff_t row) const { return data_->edges.at(std::size_t(row)); }
std::array<int, 3> Mesh::face(std::ptrdiff_t row) const { return data_->faces.at(std::size_t(row)); }

int Mesh::num_bodies() const {
  const std::vector<int>& body = data_->body;
  return body.empty() ? 1 : *std::max_element(body.begin(), body.end()) + 1;
}
int Mesh::body(std::ptrdiff_t vertex) const {
  return data_->body.empty() ? 0 : data_->body.at(std::size_t(vertex));
}
std::ptrdiff_t Mesh::num_full_vertices() const { return data_->num_full_vertices; }
int Mesh::full_vertex(std::ptrdiff_t vertex) const {
  return data_->full_vertex.empty() ? int(vertex) : data_->full_vertex.at(std::size_t(vertex));
}
const FilterCounts& Mesh::filter_counts() const { return data_->filter->counts; }

void Mesh::release_memory() const {
  data_->buffer_pool->clear();
  if (data_->static_cache) data_->static_cache->clear();
}

std::array<int, 4> Mesh::full_vertices(const Pair& pair) const {
  std::array<int, 4> full = pair.vertices;
  for (int& v : full)
    if (v >= 0) v = full_vertex(v);
  return full;
}

std::array<std::ptrdiff_t, 12> Mesh::full_dofs(const Pair& pair) const {
  const std::array<int, 4> full = full_vertices(pair);
  std::array<std::ptrdiff_t, 12> dofs;
  for (std::size_t i = 0; i < 12; ++i)
    dofs[i] = full[i / 3] < 0 ? -1 : 3 * std::ptrdiff_t(full[i / 3]) + std::ptrdiff_t(i % 3);
  return dofs;
}

std::vector<double> Mesh::surface_positions(const Positions& full) const {
  if (full.cols() != 3 || full.rows() != num_full_vertices())
    throw std::invalid_argument("positions of the full mesh have " + std::to_string(full.rows()) +
                                " rows of " + std::to_string(full.cols()) + "; it has " +
                                std::to_string(num_full_vertices()) +
                                " vertices and needs one row of 3 for each");
  std::vector<double> surface;
  surface.reserve(3 * std::size_t(num_vertices()));
  for (std::ptrdiff_t v = 0; v < num_vertices(); ++v)
    for (int a = 0; a < 3; ++a) surface.push_back(full(full_vertex(v), a));
  return surface;
}

std::vector<int> Mesh::components() const {
  std::vector<int> root(data_->num_vertices);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[std::size_t(v)] != v) v = root[std::size_t(v)] = root[std::size_t(root[std::size_t(v)])];
    return v;
  };
  const auto join = [&](int v, int w) {  // the smaller id is the root
    v = find(v), w = find(w);
    root[std::size_t(std::max(v, w))] = std::min(v, w);
  };
  for (const auto& e : data_->edges) join(e[0], e[1]);
  for (const auto& f : data_->faces) join(f[0], f[1]), join(f[1], f[2]);
  std::vector<int> body(root.size());
  int bodies = 0;
  for (std::size_t v = 0; v < root.size(); ++v) {
    const int r = find(int(v));
    body[v] = r == int(v) ? bodies++ : body[std::size_t(r)];
  }
  return body;
}

// All or nothing: data_ changes when f and what follows from it are done.
template <class F>
void Mesh::change(F&& f) {
  auto changed = std::make_shared<MeshData>(*data_);
  f(*changed);
  finish_mesh(*changed);
  data_ = std::move(changed);
}

namespace {

void check_size(const char* what, std::size_t size, std::ptrdiff_t wanted, const char* of) {
  if (std::ptrdiff_t(size) != wanted)
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(size) + " values for " +
                                std::to_string(wanted) + " " + of);
}

std::vector<std::array<int, 2>> checked_pairs(const char* what, std::vector<std::array<int, 2>> pairs,
                                              std::ptrdiff_t count) {
  for (std::size_t r = 0; r < pairs.size(); ++r) {
    auto& [a, b] = pairs[r];
    for (const int i : {a, b})
      if (i < 0 || i >= count)
        reject(what, std::ptrdiff_t(r),
               "id " + std::to_string(i) + " is out of range, there are " + std::to_string(count));
    if (a == b) reject(what, std::ptrdiff_t(r), "id " + std::to_string(a) + " is repeated");
    if (a > b) std::swap(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

template <std::size_t N>
void check_one_body(const char* what, const std::vector<std::array<int, N>>& elements,
                    const std::vector<int>& body) {
  for (std::size_t r = 0; r < elements.size(); ++r)
    for (const int v : elements[r])
      if (const int first = elements[r][0]; body[std::size_t(v)] != body[std::size_t(first)])
        reject(what, std::ptrdiff_t(r),
               "vertex " + std::to_string(first) + " is in body " + std::to_string(body[std::size_t(first)]) +
                   ", vertex " + std::to_string(v) + " in body " + std::to_string(body[std::size_t(v)]));
}

}  // namespace

void Mesh::set_points(const std::vector<int>& ids) {
  const std::size_t edges = data_->edges.size() - std::size_t(data_->num_points);
  enum : char { none, element, point };
  std::vector<char> part(std::size_t(num_vertices()), none);
  for (std::size_t e = 0; e < edges; ++e)
    for (const int v : data_->edges[e]) part[std::size_t(v)] = element;
  for (const auto& f : data_->faces)
    for (const int v : f) part[std::size_t(v)] = element;
  for (std::size_t r = 0; r < ids.size(); ++r) {
    const auto bad = [&](const std::string& why) {
      reject("point", std::ptrdiff_t(r), "vertex " + std::to_string(ids[r]) + why);
    };
    if (ids[r] < 0 || ids[r] >= num_vertices())
      bad(" is out of range, there are " + std::to_string(num_vertices()));
    char& used = part[std::size_t(ids[r])];
    if (used == element) bad(" belongs to an edge or a face");
    if (used == point) bad(" is repeated");
    used = point;
  }
  change([&](MeshData& data) {
    data.edges.resize(edges);
    for (const int v : ids) data.edges.push_back({v, v});
    data.num_points = int(ids.size());
    for (const PairKind kind : {PairKind::edge_edge, kEdgeFace}) {
      auto& pairs = data.excluded_pairs[std::size_t(kind)];
      const auto of_points = [&](const std::array<int, 2>& p) {
        return std::size_t(kind == kEdgeFace ? p[0] : p[1]) >= edges;  // a < b
      };
      pairs.erase(std::remove_if(pairs.begin(), pairs.end(), of_points), pairs.end());
    }
  });
}

void Mesh::set_bodies(const std::vector<int>& body) {
  check_size("body", body.size(), num_vertices(), "vertices");
  for (std::size_t v = 0; v < body.size(); ++v)
    if (body[v] < 0 || body[v] == std::numeric_limits<int>::max())
      reject("body", std::ptrdiff_t(v), "id " + std::to_string(body[v]) + " is not in [0, 2^31 - 1)");
  check_one_body("edge", data_->edges, body);
  check_one_body("face", data_->faces, body);
  change([&](MeshData& data) {
    data.body = body;
    data.rigid = data.no_self = {};
    data.excluded_bodies = {};
  });
}

void Mesh::set_static(const std::vector<bool>& vertices) {
  check_size("static", vertices.size(), num_vertices(), "vertices");
  change([&](MeshData& data) { data.is_static = vertices; });
}

void Mesh::set_rigid(const std::vector<bool>& bodies) {
  check_size("rigid", bodies.size(), num_bodies(), "bodies");
  change([&](MeshData& data) { data.rigid = bodies; });
}

void Mesh::set_self_collision(const std::vector<bool>& bodies) {
  check_size("self-collision", bodies.size(), num_bodies(), "bodies");
  change([&](MeshData& data) {
    data.no_self = bodies;
    data.no_self.flip();
  });
}

void Mesh::set_groups(const std::vector<std::uint32_t>& groups, const std::vector<std::uint32_t>& masks) {
  check_size("groups", groups.size(), num_vertices(), "vertices");
  check_size("masks", masks.size(), num_vertices(), "vertices");
  change([&](MeshData& data) { data.group = groups, data.mask = masks; });
}

void Mesh::set_excluded_bodies(const std::vector<std::array<int, 2>>& pairs) {
  auto checked = checked_pairs("excluded bodies", pairs, num_bodies());
  change([&](MeshData& data) { data.excluded_bodies = std::move(checked); });
}

void Mesh::set_excluded_vertices(const std::vector<std::array<int, 2>>& pairs) {
  auto checked = checked_pairs("excluded vertices", pairs, num_vertices());
  change([&](MeshData& data) { data.excluded_vertices = std::move(checked); });
}

void Mesh::set_excluded_pairs(const std::vector<Pair>& pairs) {
  const std::vector<PairKind> kinds{PairKind::vertex_face, PairKind::edge_edge};
  NamedPairs named("excluded pairs", *data_, kinds);
  for (const Pair& p : pairs) named.add(p.kind, p.a, p.b);
  change([&](MeshData& data) {
    for (const PairKind kind : kinds) data.excluded_pairs[std::size_t(kind)] = named.of(kind);
  });
}

void Mesh::set_excluded_intersections(const std::vector<Intersection>& pairs) {
  NamedPairs named("excluded intersections", *data_, {kEdgeFace});
  for (const Intersection& p : pairs) named.add(kEdgeFace, p.edge, p.face);
  change([&](MeshData& data) { data.excluded_pairs[std::size_t(kEdgeFace)] = named.of(kEdgeFace); });
}

void Mesh::set_weld(bool on) {
  change([&](MeshData& data) { data.weld = on; });
}

void Mesh::set_full_vertices(const std::vector<int>& ids, std::ptrdiff_t full_vertices) {
  check_size("full vertices", ids.size(), num_vertices(), "vertices");
  std::vector<bool> taken(std::size_t(checked_count(full_vertices)));
  for (std::size_t v = 0; v < ids.size(); ++v) {
    if (ids[v] < 0 || ids[v] >= full_vertices)
      reject("full vertices", std::ptrdiff_t(v),
             "id " + std::to_string(ids[v]) + " is out of range, there are " + std::to_string(full_vertices));
    if (taken[std::size_t(ids[v])])
      reject("full vertices", std::ptrdiff_t(v), "id " + std::to_string(ids[v]) + " is repeated");
    taken[std::size_t(ids[v])] = true;
  }
  change([&](MeshData& data) { data.full_vertex = ids, data.num_full_vertices = int(full_vertices); });
}

void Mesh::set_thickness(const std::vector<double>& thickness) {
  check_size("thickness", thickness.size(), num_vertices(), "vertices");
  for (std::size_t v = 0; v < thickness.size(); ++v)
    if (!(thickness[v] >= 0) || !std::isfinite(thickness[v]))
      reject("thickness", std::ptrdiff_t(v), std::to_string(thickness[v]) + " is not a finite number >= 0");
  // All zero is none.
  const bool any = std::any_of(thickness.begin(), thickness.end(), [](double t) { return t > 0; });
  change([&](MeshData& data) { data.thickness = any ? thickness : std::vector<double>(); });
}

}  // namespace onset
