#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/parallel.hpp"
#include "onset/mesh.hpp"
#include "scene/edges_of_faces.hpp"

namespace onset {
namespace {

using Edge = std::array<int, 2>;

// The order of igl::edges, which walks the upper triangle of the adjacency matrix column by column. Rows are
// (smaller, larger).
constexpr auto in_order = [](const Edge& e, const Edge& f) {
  return e[1] != f[1] ? e[1] < f[1] : e[0] < f[0];
};

int id_in(const char* what, const Indices& ids, std::ptrdiff_t row, std::ptrdiff_t column) {
  const long long v = ids(row, column);
  if (v < 0 || v > std::numeric_limits<int>::max())
    throw std::invalid_argument(std::string(what) + " row " + std::to_string(row) + ": vertex " +
                                std::to_string(v) + " is out of range");
  return int(v);
}

Edge upward(int v, int w) { return {std::min(v, w), std::max(v, w)}; }

void sort_once(std::vector<Edge>& list) {
  if (!std::is_sorted(list.begin(), list.end(), in_order)) parallel_sort(list.begin(), list.end(), in_order);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

std::vector<Edge> missing(std::vector<Edge> present, const std::vector<Edge>& wanted) {
  for (Edge& e : present) e = upward(e[0], e[1]);
  sort_once(present);
  std::vector<Edge> rest;
  std::set_difference(wanted.begin(), wanted.end(), present.begin(), present.end(), std::back_inserter(rest),
                      in_order);
  return rest;
}

}  // namespace

std::vector<Edge> edge_list(const Indices& faces) {
  if (faces.rows() > 0 && faces.cols() != 3)
    throw std::invalid_argument("faces have " + std::to_string(faces.cols()) + " columns, not 3");
  std::vector<Edge> list;
  list.reserve(std::size_t(faces.rows()) * 3);
  for (std::ptrdiff_t f = 0; f < faces.rows(); ++f)
    for (std::ptrdiff_t c = 0; c < faces.cols(); ++c)
      list.push_back(upward(id_in("face", faces, f, c), id_in("face", faces, f, (c + 1) % faces.cols())));
  sort_once(list);
  return list;
}

std::vector<Edge> complete_edge_list(const Indices& edges, const Indices& faces) {
  if (edges.rows() > 0 && edges.cols() != 2)
    throw std::invalid_argument("edges have " + std::to_string(edges.cols()) + " columns, not 2");
  std::vector<Edge> list;
  for (std::ptrdiff_t e = 0; e < edges.rows(); ++e)
    list.push_back({id_in("edge", edges, e, 0), id_in("edge", edges, e, 1)});
  const std::vector<Edge> rest = missing(list, edge_list(faces));
  list.insert(list.end(), rest.begin(), rest.end());
  return list;
}

void require_edges_of_faces(const std::vector<Edge>& edges, const std::vector<std::array<int, 3>>& faces) {
  std::vector<Edge> wanted;
  wanted.reserve(3 * faces.size());
  for (const auto& f : faces)
    for (std::size_t c = 0; c < 3; ++c) wanted.push_back(upward(f[c], f[(c + 1) % 3]));
  sort_once(wanted);
  if (edges == wanted) return;  // as edges made from faces are
  const std::vector<Edge> lost = missing(edges, wanted);
  if (lost.empty()) return;
  for (std::size_t r = 0; r < faces.size(); ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      const Edge e = upward(faces[r][c], faces[r][(c + 1) % 3]);
      if (std::binary_search(lost.begin(), lost.end(), e, in_order))
        throw std::invalid_argument(
            "face row " + std::to_string(r) + ": its edge between vertices " + std::to_string(e[0]) +
            " and " + std::to_string(e[1]) +
            " is not among the edges; pass onset::complete_edges(edges, faces), or no edges to have "
            "those of the faces");
    }
}

}  // namespace onset
