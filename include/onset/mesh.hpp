// The topology that can touch: vertices, edges and faces, checked once and shared by every call.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <onset/export.hpp>
#include <onset/views.hpp>
#include <vector>

namespace onset {

struct MeshData;  // base/mesh_data.hpp

// Immutable after construction apart from the set_ functions; const calls from any number of threads are
// safe. Copies share their data until one of them is changed.
class ONSET_API Mesh {
 public:
  // `vertices`: #V, the number of rows of every positions matrix. `edges`: #E x 2; `faces`: #F x 3. Throws
  // std::invalid_argument naming the row for an id out of [0, #V), a repeated vertex in a row, or a wrong
  // number of columns.
  Mesh(std::ptrdiff_t vertices, const Indices& edges, const Indices& faces);
  // As above with edges derived from the faces: onset::edges(faces), the order of igl::edges.
  Mesh(std::ptrdiff_t vertices, const Indices& faces);
  // As above; `rest` (#V x 3) gives the number of vertices. Its values are not used.
  Mesh(const Positions& rest, const Indices& edges, const Indices& faces);
  Mesh(const Positions& rest, const Indices& faces);

  std::ptrdiff_t num_vertices() const;
  std::ptrdiff_t num_edges() const;
  std::ptrdiff_t num_faces() const;
  std::array<int, 2> edge(std::ptrdiff_t row) const;
  std::array<int, 3> face(std::ptrdiff_t row) const;

  // Thickness of each vertex (#V values >= 0, model length): a pair must stay apart by
  // Options::min_separation plus the largest thickness among the vertices of each of its two primitives.
  // Throws std::invalid_argument naming the row.
  void set_thickness(const std::vector<double>& thickness);

  const MeshData& data() const { return *data_; }

 private:
  std::shared_ptr<const MeshData> data_;
};

// The undirected edges of `faces`, each once, in the order of igl::edges: see src/edges.cpp.
ONSET_API std::vector<std::array<int, 2>> edge_list(const Indices& faces);

// The same as a matrix (#E x 2).
inline Eigen::MatrixXi edges(const Indices& faces) {
  const std::vector<std::array<int, 2>> list = edge_list(faces);
  Eigen::MatrixXi E(list.size(), 2);
  for (std::size_t i = 0; i < list.size(); ++i) E.row(i) << list[i][0], list[i][1];
  return E;
}

}  // namespace onset
