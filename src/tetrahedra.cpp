#include "onset/tetrahedra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/float_environment.hpp"
#include "narrowphase/exact/grid.hpp"
#include "narrowphase/exact/integer_polynomial.hpp"
#include "narrowphase/exact/orientation.hpp"
#include "narrowphase/exact/static.hpp"
#include "scene/rules.hpp"

namespace onset {
namespace {

using Tetrahedron = std::array<int, 4>;

// Outward where the tetrahedron is positive, opposite to corners 0 to 3.
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

std::vector<Tetrahedron> checked(const Indices& ids, std::ptrdiff_t vertices) {
  if (vertices < 0 || vertices > std::numeric_limits<int>::max())
    throw std::invalid_argument("a mesh cannot have " + std::to_string(vertices) + " vertices");
  if (ids.rows() > 0 && ids.cols() != 4)
    throw std::invalid_argument("tetrahedra have " + std::to_string(ids.cols()) + " columns, not 4");
  if (ids.rows() > std::numeric_limits<int>::max() / 4)
    throw std::invalid_argument("there are " + std::to_string(ids.rows()) + " tetrahedra");
  std::vector<Tetrahedron> all(std::size_t(ids.rows()));
  for (std::ptrdiff_t r = 0; r < ids.rows(); ++r)
    for (std::size_t c = 0; c < 4; ++c) {
      const long long v = ids(r, std::ptrdiff_t(c));
      if (v < 0 || v >= vertices)
        reject_row("tetrahedron", r,
                   "vertex " + std::to_string(v) + " is out of range, there are " + std::to_string(vertices));
      Tetrahedron& t = all[std::size_t(r)];
      for (std::size_t k = 0; k < c; ++k)
        if (t[k] == v) reject_row("tetrahedron", r, "vertex " + std::to_string(v) + " is repeated");
      t[c] = int(v);
    }
  return all;
}

template <std::size_t N>
struct Sorted {
  std::array<int, N> vertices;
  int row;
  bool operator<(const Sorted& o) const {
    return vertices != o.vertices ? vertices < o.vertices : row < o.row;
  }
};
template <std::size_t N>
Sorted<N> sorted(std::array<int, N> vertices, std::size_t row) {
  std::sort(vertices.begin(), vertices.end());
  return {vertices, int(row)};
}

void reject_copies(const std::vector<Tetrahedron>& all) {
  std::vector<Sorted<4>> list;
  for (std::size_t r = 0; r < all.size(); ++r) list.push_back(sorted(all[r], r));
  std::sort(list.begin(), list.end());
  int copy = -1, first = -1;
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i].vertices == list[i - 1].vertices && (copy < 0 || list[i].row < copy))
      copy = list[i].row, first = list[i - 1].row;
  if (copy >= 0) reject_row("tetrahedron", copy, "is that of row " + std::to_string(first) + " again");
}

std::array<int, 3> face_of(const Tetrahedron& t, int opposite) {
  const auto& f = kFaces[opposite];
  return {t[std::size_t(f[0])], t[std::size_t(f[1])], t[std::size_t(f[2])]};
}

// For each tetrahedron a bit for each face that no other one has.
std::vector<std::uint8_t> single_faces(const std::vector<Tetrahedron>& all) {
  std::vector<Sorted<3>> list;
  list.reserve(4 * all.size());
  for (std::size_t i = 0; i < 4 * all.size(); ++i) list.push_back(sorted(face_of(all[i / 4], int(i % 4)), i));
  std::sort(list.begin(), list.end());
  std::vector<std::uint8_t> single(all.size());
  for (std::size_t i = 0, end; i < list.size(); i = end) {
    for (end = i + 1; end < list.size() && list[end].vertices == list[i].vertices;) ++end;
    const auto& v = list[i].vertices;
    if (end - i > 2)
      reject_row("tetrahedron", list[i + 2].row / 4,
                 "its face " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " +
                     std::to_string(v[2]) + " is one of rows " + std::to_string(list[i].row / 4) + " and " +
                     std::to_string(list[i + 1].row / 4) + " already");
    if (end - i == 1) single[std::size_t(list[i].row / 4)] |= std::uint8_t(1 << (list[i].row % 4));
  }
  return single;
}

void renumber(std::ptrdiff_t vertices, TetrahedraSurface& s) {
  s.surface_vertices.assign(std::size_t(vertices), -1);
  for (const auto& f : s.faces)
    for (const int v : f) s.surface_vertices[std::size_t(v)] = 0;
  for (std::size_t v = 0; v < s.surface_vertices.size(); ++v)
    if (s.surface_vertices[v] == 0)
      s.surface_vertices[v] = int(s.full_vertices.size()), s.full_vertices.push_back(int(v));
  Eigen::MatrixXi F(s.faces.size(), 3);
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      F(Eigen::Index(f), Eigen::Index(c)) = s.faces[f][c] = s.surface_vertices[std::size_t(s.faces[f][c])];
  s.edges = edge_list(F);
}

template <class Turned>
TetrahedraSurface surface(const Indices& ids, std::ptrdiff_t vertices, Turned&& turned) {
  const std::vector<Tetrahedron> all = checked(ids, vertices);
  reject_copies(all);
  const std::vector<std::uint8_t> single = single_faces(all);
  TetrahedraSurface s;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (single[r] == 0) continue;
    const bool inside_out = turned(all[r]);
    for (int k = 0; k < 4; ++k) {
      if ((single[r] >> k & 1) == 0) continue;
      std::array<int, 3> face = face_of(all[r], k);
      if (inside_out) std::swap(face[1], face[2]);
      s.faces.push_back(face);
    }
  }
  renumber(vertices, s);
  return s;
}

// The exact sign of det[a - d, b - d, c - d], of any magnitudes.
int exact_orientation(const double* a, const double* b, const double* c, const double* d) {
  const int quick = orientation(a, b, c, d);
  if (quick != kUnknownSide) return quick;
  Grid grid;
  for (const double* p : {a, b, c, d}) grid.add(p);
  const auto from = on_grid<Integer>(d, grid.last);
  const auto at = [&](const double* p) { return difference(on_grid<Integer>(p, grid.last), from); };
  const std::array<Integer, 3> x = at(a), n = exact_cross<Integer>(at(b), at(c));
  return sign_of(x[0] * n[0] + x[1] * n[1] + x[2] * n[2]);
}

}  // namespace

TetrahedraSurface surface_of_tetrahedra(const Indices& tetrahedra, std::ptrdiff_t vertices) {
  return surface(tetrahedra, vertices, [](const Tetrahedron&) { return false; });
}

TetrahedraSurface surface_of_tetrahedra(const Indices& tetrahedra, const Positions& x) {
  const FloatEnvironment environment;
  if (x.cols() != 3) throw std::invalid_argument("x has " + std::to_string(x.cols()) + " columns, not 3");
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (int a = 0; a < 3; ++a)
      if (!std::isfinite(x(v, a)))
        throw std::invalid_argument("x row " + std::to_string(v) + ": not all of it is finite");
  return surface(tetrahedra, x.rows(), [&](const Tetrahedron& t) {
    double p[4][3];
    for (std::size_t k = 0; k < 4; ++k)
      for (int a = 0; a < 3; ++a) p[k][a] = x(t[k], a);
    return exact_orientation(p[1], p[2], p[3], p[0]) == -1;
  });
}

}  // namespace onset
