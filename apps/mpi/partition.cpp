#include "mpi/partition.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace app {
namespace {

// Cuts [first, last) across its widest axis, in proportion to the ranks on each side.
void bisect(const Eigen::MatrixXd& x, std::vector<int>::iterator first, std::vector<int>::iterator last,
            int low, int ranks, std::vector<int>& rank_of) {
  if (ranks == 1 || first == last) {
    for (; first != last; ++first) rank_of[std::size_t(*first)] = low;
    return;
  }
  Eigen::Index widest = 0;
  double width = -1;
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (auto v = first; v != last; ++v) lo = std::min(lo, x(*v, a)), hi = std::max(hi, x(*v, a));
    if (hi - lo > width) width = hi - lo, widest = a;
  }
  const int left = ranks / 2;
  const auto middle = first + (last - first) * left / ranks;
  std::nth_element(first, middle, last, [&](int v, int w) { return x(v, widest) < x(w, widest); });
  bisect(x, first, middle, low, left, rank_of);
  bisect(x, middle, last, low + left, ranks - left, rank_of);
}

template <class T>
std::vector<T> of_rows(const std::vector<T>& values, const std::vector<int>& ids) {
  std::vector<T> rows;
  for (std::size_t i = 0; i < ids.size() && !values.empty(); ++i) rows.push_back(values[std::size_t(ids[i])]);
  return rows;
}

// Finds the row of a vertex.
class Rows {
 public:
  Rows(const std::vector<int>& ids, std::ptrdiff_t vertices) : row_(std::size_t(vertices), -1) {
    for (std::size_t i = 0; i < ids.size(); ++i) row_[std::size_t(ids[i])] = int(i);
  }
  int of(int vertex) const { return row_[std::size_t(vertex)]; }

 private:
  std::vector<int> row_;
};

template <std::size_t N, class Get>
std::vector<int> known(std::ptrdiff_t count, const Get& get, const std::vector<int>& rank_of, int rank) {
  std::vector<int> ids;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (const int v : get(i))
      if (rank_of[std::size_t(v)] == rank) {
        ids.push_back(int(i));
        break;
      }
  std::reverse(ids.begin(), ids.end());
  return ids;
}

}  // namespace

std::vector<int> ranks_of_vertices(const Eigen::MatrixXd& x, Partition partition, int ranks, unsigned seed) {
  const std::size_t n = std::size_t(x.rows());
  std::vector<int> rank_of(n, 0);
  std::mt19937 random(seed);
  if (partition == Partition::rcb) {
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    bisect(x, all.begin(), all.end(), 0, ranks, rank_of);
    return rank_of;
  }
  for (std::size_t v = 0; v < n; ++v)
    rank_of[v] =
        partition == Partition::random ? int(random() % unsigned(ranks)) : int(v * std::size_t(ranks) / n);
  return rank_of;
}

onset::mpi::MeshPart part_of(const onset::Mesh& mesh, const std::vector<int>& rank_of, int rank,
                             bool gives_edges) {
  const onset::CollisionRules& rules = mesh.rules();
  onset::mpi::MeshPart part;
  part.dimension = mesh.dimension();
  for (std::size_t v = 0; v < rank_of.size(); ++v)
    if (rank_of[v] == rank) part.vertex_ids.push_back(int(v));
  std::mt19937 random(unsigned(rank) + 1);
  std::shuffle(part.vertex_ids.begin(), part.vertex_ids.end(), random);
  part.owned = std::ptrdiff_t(part.vertex_ids.size());

  const std::ptrdiff_t edges = mesh.num_edges() - mesh.num_points();
  part.face_ids = known<3>(
      mesh.num_faces(), [&](auto f) { return mesh.face(f); }, rank_of, rank);
  if (gives_edges)
    part.edge_ids = known<2>(
        edges, [&](auto e) { return mesh.edge(e); }, rank_of, rank);
  std::vector<int> ghosts;
  const auto want = [&](int v) {
    if (rank_of[std::size_t(v)] != rank) ghosts.push_back(v);
  };
  for (const int f : part.face_ids)
    for (const int v : mesh.face(f)) want(v);
  for (const int e : part.edge_ids)
    for (const int v : mesh.edge(e)) want(v);
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  part.vertex_ids.insert(part.vertex_ids.end(), ghosts.begin(), ghosts.end());

  const Rows rows(part.vertex_ids, mesh.num_vertices());
  Eigen::MatrixXi F(Eigen::Index(part.face_ids.size()), 3), E(Eigen::Index(part.edge_ids.size()), 2);
  for (Eigen::Index r = 0; r < F.rows(); ++r)
    for (int c = 0; c < 3; ++c) F(r, c) = rows.of(mesh.face(part.face_ids[std::size_t(r)])[std::size_t(c)]);
  for (Eigen::Index r = 0; r < E.rows(); ++r)
    for (int c = 0; c < 2; ++c) E(r, c) = rows.of(mesh.edge(part.edge_ids[std::size_t(r)])[std::size_t(c)]);
  part.faces = onset::Indices(F), part.edges = onset::Indices(E);

  part.rules = rules;
  part.rules.points = {};
  for (std::size_t i = 0; i < rules.points.size(); ++i)
    if (rank_of[std::size_t(rules.points[i])] == rank) {
      part.rules.points.push_back(rows.of(rules.points[i]));
      part.point_ids.push_back(int(i));
    }
  part.rules.thickness = of_rows(rules.thickness, part.vertex_ids);
  part.rules.bodies = of_rows(rules.bodies, part.vertex_ids);
  part.rules.groups = of_rows(rules.groups, part.vertex_ids);
  part.rules.masks = of_rows(rules.masks, part.vertex_ids);
  part.rules.static_vertices = of_rows(rules.static_vertices, part.vertex_ids);
  return part;
}

Eigen::MatrixXd rows_of(const onset::mpi::MeshPart& part, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(Eigen::Index(part.vertex_ids.size()), x.cols(),
                                                   std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index r = 0; r < part.owned; ++r) rows.row(r) = x.row(part.vertex_ids[std::size_t(r)]);
  return rows;
}

}  // namespace app
