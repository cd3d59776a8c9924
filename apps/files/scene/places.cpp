#include "files/scene/places.hpp"

#include <algorithm>
#include <numeric>

#include "files/error.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

template <class Before>
std::vector<Eigen::Index> first_of_equals(Eigen::Index rows, Before&& before) {
  std::vector<Eigen::Index> order(std::size_t(rows), 0), first(order);
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  std::stable_sort(order.begin(), order.end(), before);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && !before(order[i - 1], order[i]);
    first[std::size_t(order[i])] = same ? first[std::size_t(order[i - 1])] : order[i];
  }
  return first;
}

// -1, 0 or 1.
int compare(const Points& x, Eigen::Index a, Eigen::Index b) {
  for (int c = 0; c < 3; ++c)
    if (x(a, c) != x(b, c)) return x(a, c) < x(b, c) ? -1 : 1;
  return 0;
}

std::string corner(Eigen::Index v) {
  return "corner " + std::to_string(v % 3) + " of face " + std::to_string(v / 3);
}

void check_still_together(const std::vector<Eigen::Index>& first, const MeshFile& t0, const MeshFile& t1) {
  for (std::size_t v = 0; v < first.size(); ++v)
    if (t1.positions.row(Eigen::Index(v)) != t1.positions.row(first[v]))
      throw InputError(
          t0.path + " and " + t1.path + ": " + corner(first[v]) + " and " + corner(Eigen::Index(v)) +
          " are at one place in the first and not in the second, and STL does not tell whether they are "
          "one vertex: write .ply or .obj");
}

// The element that a face becomes whose vertices are ids.
void add_face(MeshFile& mesh, std::array<std::int64_t, 3> ids) {
  if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0]) {
    std::sort(ids.begin(), ids.end());
    if (ids[0] == ids[2])
      mesh.points.push_back(ids[0]);
    else
      mesh.wires.push_back({ids[0], ids[2]});
    return;
  }
  mesh.polygons.corners.insert(mesh.polygons.corners.end(), ids.begin(), ids.end());
  mesh.polygons.ends.push_back(mesh.polygons.corners.size());
}

void merge(MeshFile& file, const std::vector<Eigen::Index>& first) {
  std::vector<std::int64_t> id(first.size());
  std::int64_t count = 0;
  for (std::size_t v = 0; v < first.size(); ++v) {
    const bool kept = first[v] == Eigen::Index(v);
    id[v] = kept ? count++ : id[std::size_t(first[v])];
    if (kept) file.positions.row(id[v]) = file.positions.row(Eigen::Index(v)).eval();
  }
  file.positions.conservativeResize(count, Eigen::NoChange);
  file.polygons = {};
  for (std::size_t v = 0; v < first.size(); v += 3) add_face(file, {id[v], id[v + 1], id[v + 2]});
  const std::size_t thin = file.wires.size() + file.points.size();
  file.notes.push_back("merged " + std::to_string(first.size()) + " corners into " + std::to_string(count) +
                       " vertices" +
                       (thin > 0 ? "; wires or points for " + counted(thin, "face") + " without area" : ""));
  file.shares_vertices = true;
}

}  // namespace

std::vector<Eigen::Index> first_at_place(const Points& x) {
  return first_of_equals(x.rows(), [&](Eigen::Index a, Eigen::Index b) { return compare(x, a, b) < 0; });
}

std::vector<std::array<int, 2>> copies_together(const Points& x_t0, const Points& x_t1) {
  const auto before = [&](Eigen::Index a, Eigen::Index b) {
    const int order = compare(x_t0, a, b);
    return order < 0 || (order == 0 && compare(x_t1, a, b) < 0);
  };
  const std::vector<Eigen::Index> first = first_of_equals(x_t0.rows(), before);
  std::vector<std::array<int, 2>> copies;
  for (std::size_t v = 0; v < first.size(); ++v)
    if (first[v] != Eigen::Index(v)) copies.push_back({int(first[v]), int(v)});
  std::sort(copies.begin(), copies.end());
  return copies;
}

void merge_corners(MeshFile& t0, MeshFile& t1) {
  if (!t0.shares_vertices) {
    const std::vector<Eigen::Index> first = first_at_place(t0.positions);
    if (!t1.shares_vertices && t1.positions.rows() == t0.positions.rows()) {
      check_still_together(first, t0, t1);
      merge(t1, first);
    }
    merge(t0, first);
  }
  if (!t1.shares_vertices) merge(t1, first_at_place(t1.positions));
}

}  // namespace app
