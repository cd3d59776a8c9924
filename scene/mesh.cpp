#include "onset/mesh.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "scene/edges_of_faces.hpp"
#include "scene/pairs/rest_limits.hpp"
#include "scene/primitive.hpp"
#include "scene/primitive_filter.hpp"
#include "scene/rules.hpp"
#include "scene/static_cache.hpp"

namespace onset {
namespace {

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
        reject_row(what, r,
                   "vertex " + std::to_string(v) + " is out of range, there are " + std::to_string(vertices));
      for (std::size_t k = 0; k < c; ++k)
        if (result[r][k] == v) reject_row(what, r, "vertex " + std::to_string(v) + " is repeated");
      result[r][c] = int(v);
    }
  return result;
}

std::ptrdiff_t checked_count(std::ptrdiff_t vertices) {
  if (vertices < 0 || vertices > std::numeric_limits<int>::max())
    throw std::invalid_argument("a mesh cannot have " + std::to_string(vertices) + " vertices");
  return vertices;
}

std::shared_ptr<MeshData> make_data(std::ptrdiff_t vertices, std::vector<std::array<int, 2>> edges,
                                    std::vector<std::array<int, 3>> faces, const CollisionRules& rules,
                                    int dimension = 3) {
  auto data = std::make_shared<MeshData>();
  data->num_vertices = data->num_full_vertices = int(vertices);
  data->dimension = dimension;
  data->edges = std::move(edges);
  data->faces = std::move(faces);
  apply_rules(rules, *data);
  data->rules = std::make_shared<const CollisionRules>(rules);
  finish_mesh(*data);
  return data;
}

const std::shared_ptr<MeshData>& no_vertices() {
  static const std::shared_ptr<MeshData> data = make_data(0, {}, {}, {});
  return data;
}

}  // namespace

Mesh::Mesh() : data_(no_vertices()) {}

// Whoever moves from a mesh has made it, or one like it, so that nothing is allocated here.
Mesh::Mesh(Mesh&& other) noexcept : data_(std::exchange(other.data_, no_vertices())) {}
Mesh& Mesh::operator=(Mesh&& other) noexcept {
  if (this != &other) data_ = std::exchange(other.data_, no_vertices());
  return *this;
}

Mesh::Mesh(std::ptrdiff_t vertices, const Indices& edges, const Indices& faces, const CollisionRules& rules) {
  no_vertices();
  auto E = checked<2>("edge", edges, checked_count(vertices));
  auto F = checked<3>("face", faces, vertices);
  require_edges_of_faces(E, F);
  data_ = make_data(vertices, std::move(E), std::move(F), rules);
}

Mesh::Mesh(std::ptrdiff_t vertices, const Indices& faces, const CollisionRules& rules) {
  no_vertices();
  auto F = checked<3>("face", faces, checked_count(vertices));
  data_ = make_data(vertices, edge_list(faces), std::move(F), rules);
}

Mesh::Mesh(const Positions& rest, const Indices& edges, const Indices& faces, const CollisionRules& rules)
    : Mesh(rest.cols() == 2 ? in_plane(rest.rows(), edges, rules) : Mesh(rest.rows(), edges, faces, rules)) {
  if (rest.cols() == 2 && faces.rows() > 0)
    throw std::invalid_argument("a mesh in the plane (positions of 2 columns) has no faces, but " +
                                std::to_string(faces.rows()) + " are given: pass edges");
}
Mesh::Mesh(const Positions& rest, const Indices& faces, const CollisionRules& rules)
    : Mesh(rest.cols() == 2 ? in_plane(rest.rows(), faces, rules) : Mesh(rest.rows(), faces, rules)) {}

Mesh Mesh::in_plane(std::ptrdiff_t vertices, const Indices& edges, const CollisionRules& rules) {
  no_vertices();
  auto E = checked<2>("edge", edges, checked_count(vertices));
  return Mesh(std::shared_ptr<const MeshData>(make_data(vertices, std::move(E), {}, rules, 2)));
}

// Changes data_ only after all that may throw is done.
template <class F>
void Mesh::change(F&& f) {
  auto changed = std::make_shared<MeshData>(*data_);
  f(*changed);
  finish_mesh(*changed);
  data_ = std::move(changed);
}

void Mesh::set_rules(const CollisionRules& rules) {
  change([&](MeshData& data) {
    apply_rules(rules, data);
    data.rules = std::make_shared<const CollisionRules>(rules);
  });
}
const CollisionRules& Mesh::rules() const noexcept { return *data_->rules; }

int Mesh::dimension() const noexcept { return data_->dimension; }
std::ptrdiff_t Mesh::num_vertices() const noexcept { return data_->num_vertices; }
std::ptrdiff_t Mesh::num_edges() const noexcept { return std::ptrdiff_t(data_->edges.size()); }
std::ptrdiff_t Mesh::num_points() const noexcept { return data_->num_points; }
std::ptrdiff_t Mesh::num_faces() const noexcept { return std::ptrdiff_t(data_->faces.size()); }
std::array<int, 2> Mesh::edge(std::ptrdiff_t row) const { return data_->edges.at(std::size_t(row)); }
std::array<int, 3> Mesh::face(std::ptrdiff_t row) const { return data_->faces.at(std::size_t(row)); }

int Mesh::num_bodies() const noexcept { return count_bodies(*data_); }
int Mesh::body(std::ptrdiff_t vertex) const {
  return data_->body.empty() ? 0 : data_->body.at(std::size_t(vertex));
}
std::ptrdiff_t Mesh::num_full_vertices() const noexcept { return data_->num_full_vertices; }
int Mesh::full_vertex(std::ptrdiff_t vertex) const {
  return data_->full_vertex.empty() ? int(vertex) : data_->full_vertex.at(std::size_t(vertex));
}
const FilterCounts& Mesh::filter_counts() const noexcept { return data_->filter->counts; }

void Mesh::release_memory() const noexcept {
  data_->broad_phases->clear();
  if (data_->rest) data_->rest->limits.clear();
  if (data_->turning_scenes) data_->turning_scenes->clear();
  if (!data_->static_cache) return;
  data_->static_cache->motion.clear();
  data_->static_cache->trees.clear();
}

std::array<int, 4> Mesh::full_vertices(const Pair& pair) const {
  std::array<int, 4> full = pair.vertices;
  for (int& v : full)
    if (v >= 0) v = full_vertex(v);
  return full;
}

std::array<std::ptrdiff_t, 12> Mesh::full_dofs(const Pair& pair) const {
  const std::array<int, 4> full = full_vertices(pair);
  const std::size_t columns = std::size_t(dimension()), vertices = columns == 2 ? 3 : 4;
  std::array<std::ptrdiff_t, 12> dofs;
  dofs.fill(-1);
  for (std::size_t i = 0; i < columns * vertices; ++i)
    if (const int v = full[i / columns]; v >= 0)
      dofs[i] = std::ptrdiff_t(columns) * v + std::ptrdiff_t(i % columns);
  return dofs;
}

std::vector<double> Mesh::surface_positions(const Positions& full) const {
  if (full.cols() != dimension() || full.rows() != num_full_vertices())
    throw std::invalid_argument("positions of the full mesh have " + std::to_string(full.rows()) +
                                " rows of " + std::to_string(full.cols()) + "; it has " +
                                std::to_string(num_full_vertices()) + " vertices and needs one row of " +
                                std::to_string(dimension()) + " for each");
  std::vector<double> surface;
  surface.reserve(3 * std::size_t(num_vertices()));
  for (std::ptrdiff_t v = 0; v < num_vertices(); ++v)
    for (int a = 0; a < dimension(); ++a) surface.push_back(full(full_vertex(v), a));
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

void Mesh::set_full_vertices(const std::vector<int>& ids, std::ptrdiff_t full_vertices) {
  check_size("full vertices", ids.size(), num_vertices(), "vertices");
  std::vector<bool> taken(std::size_t(checked_count(full_vertices)));
  for (std::size_t v = 0; v < ids.size(); ++v) {
    if (ids[v] < 0 || ids[v] >= full_vertices)
      reject_row(
          "full vertices", std::ptrdiff_t(v),
          "id " + std::to_string(ids[v]) + " is out of range, there are " + std::to_string(full_vertices));
    if (taken[std::size_t(ids[v])])
      reject_row("full vertices", std::ptrdiff_t(v), "id " + std::to_string(ids[v]) + " is repeated");
    taken[std::size_t(ids[v])] = true;
  }
  change([&](MeshData& data) { data.full_vertex = ids, data.num_full_vertices = int(full_vertices); });
}

}  // namespace onset
