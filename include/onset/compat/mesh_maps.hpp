// Which vertices, edges and faces of a mesh lie at each other: what CollisionMesh answers about its topology.
//
// Source: the maps of ipc::CollisionMesh of ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <map>
#include <onset/compat/arguments.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace onset::ipc {

using AdjacencyList = std::vector<std::vector<index_t>>;

// Returns the row of `edges` of each edge of each face, 0 1, 1 2, 2 0 (#F x 3).
// Throws std::runtime_error for an edge that is not there.
inline Eigen::MatrixXi faces_to_edges(const Eigen::MatrixXi& faces, const Eigen::MatrixXi& edges) {
  std::map<std::pair<int, int>, int> row;
  for (int e = 0; e < edges.rows(); ++e)
    row.emplace(std::minmax(int(edges(e, 0)), int(edges(e, 1))), e);  // the first of those given twice
  Eigen::MatrixXi r(faces.rows(), 3);
  for (int f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto found = row.find(std::minmax(int(faces(f, k)), int(faces(f, (k + 1) % 3))));
      if (found == row.end())
        throw std::runtime_error("face row " + std::to_string(f) + ": unable to find its edge " +
                                 std::to_string(k));
      r(f, k) = found->second;
    }
  return r;
}

// For each of `count` ids, the rows of `rows` that have it, ascending.
inline AdjacencyList rows_with(std::size_t count, const Eigen::MatrixXi& rows) {
  AdjacencyList r(count);
  for (int i = 0; i < rows.rows(); ++i)
    for (int k = 0; k < rows.cols(); ++k) {
      std::vector<index_t>& list = r[std::size_t(rows(i, k))];
      if (list.empty() || list.back() != i) list.push_back(i);
    }
  return r;
}

inline void sort_and_unite(AdjacencyList& lists) {
  for (std::vector<index_t>& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

// All lists ascending, each id once.
struct MeshMaps {
  MeshMaps() = default;
  MeshMaps(std::size_t vertices, const Eigen::MatrixXi& edges, const Eigen::MatrixXi& faces)
      : face_edges(faces_to_edges(faces, edges)),
        vertex_edges(rows_with(vertices, edges)),
        vertex_faces(rows_with(vertices, faces)),
        edge_faces(rows_with(std::size_t(edges.rows()), face_edges)),
        vertex_vertices(vertices),
        edge_vertices(std::size_t(edges.rows())),
        is_codim_vertex(vertices),
        is_codim_edge(std::size_t(edges.rows())) {
    for (int e = 0; e < edges.rows(); ++e)
      for (int k = 0; k < 2; ++k) vertex_vertices[std::size_t(edges(e, k))].push_back(edges(e, 1 - k));
    for (int f = 0; f < faces.rows(); ++f)
      for (int k = 0; k < 3; ++k)
        edge_vertices[std::size_t(face_edges(f, k))].push_back(faces(f, (k + 2) % 3));
    sort_and_unite(vertex_vertices), sort_and_unite(edge_vertices);
    for (std::size_t v = 0; v < vertices; ++v) is_codim_vertex[v] = vertex_edges[v].empty();
    for (std::size_t e = 0; e < edge_faces.size(); ++e) is_codim_edge[e] = edge_faces[e].empty();
    codim_vertices = where(is_codim_vertex), codim_edges = where(is_codim_edge);
  }

  static Eigen::VectorXi where(const std::vector<bool>& flags) {
    Eigen::VectorXi r(std::count(flags.begin(), flags.end(), true));
    Eigen::Index n = 0;
    for (std::size_t i = 0; i < flags.size(); ++i)
      if (flags[i]) r[n++] = int(i);
    return r;
  }

  Eigen::MatrixXi face_edges;
  AdjacencyList vertex_edges, vertex_faces, edge_faces, vertex_vertices;
  // The third vertices of the faces at an edge.
  AdjacencyList edge_vertices;
  std::vector<bool> is_codim_vertex, is_codim_edge;
  Eigen::VectorXi codim_vertices, codim_edges;
};

}  // namespace onset::ipc
