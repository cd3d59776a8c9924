#include "onset/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/mesh_data.hpp"

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
  return data;
}

}  // namespace

Mesh::Mesh(std::ptrdiff_t vertices, const Indices& edges, const Indices& faces)
    : data_(std::make_shared<MeshData>(make_data(checked_count(vertices), checked<2>("edge", edges, vertices),
                                                 checked<3>("face", faces, vertices)))) {}

Mesh::Mesh(std::ptrdiff_t vertices, const Indices& faces) {
  auto F = checked<3>("face", faces, checked_count(vertices));
  data_ = std::make_shared<MeshData>(make_data(vertices, edge_list(faces), std::move(F)));
}

Mesh::Mesh(const Positions& rest, const Indices& edges, const Indices& faces)
    : Mesh(rest.rows(), edges, faces) {}
Mesh::Mesh(const Positions& rest, const Indices& faces) : Mesh(rest.rows(), faces) {}

std::ptrdiff_t Mesh::num_vertices() const { return data_->num_vertices; }
std::ptrdiff_t Mesh::num_edges() const { return std::ptrdiff_t(data_->edges.size()); }
std::ptrdiff_t Mesh::num_faces() const { return std::ptrdiff_t(data_->faces.size()); }
std::array<int, 2> Mesh::edge(std::ptrdiff_t row) const { return data_->edges.at(std::size_t(row)); }
std::array<int, 3> Mesh::face(std::ptrdiff_t row) const { return data_->faces.at(std::size_t(row)); }

void Mesh::set_thickness(const std::vector<double>& thickness) {
  if (std::ptrdiff_t(thickness.size()) != num_vertices())
    throw std::invalid_argument("thickness has " + std::to_string(thickness.size()) + " values for " +
                                std::to_string(num_vertices()) + " vertices");
  for (std::size_t v = 0; v < thickness.size(); ++v)
    if (!(thickness[v] >= 0) || !std::isfinite(thickness[v]))
      reject("thickness", std::ptrdiff_t(v), std::to_string(thickness[v]) + " is not a finite number >= 0");
  auto changed = std::make_shared<MeshData>(*data_);
  changed->thickness = thickness;
  data_ = std::move(changed);
}

}  // namespace onset
