#include "onset/vertex_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/float_environment.hpp"

namespace onset {
namespace {

std::string shape(std::ptrdiff_t rows, std::ptrdiff_t cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

void check_count(std::size_t got, std::ptrdiff_t wanted, const char* of) {
  if (got != std::size_t(wanted))
    throw std::invalid_argument("got " + std::to_string(got) + " values; the map has " +
                                std::to_string(wanted) + " " + of);
}

}  // namespace

VertexMap::VertexMap(std::ptrdiff_t vertices, int dimension, std::ptrdiff_t rows, std::ptrdiff_t columns,
                     const std::vector<Entry>& entries)
    : vertices_(vertices), dofs_(columns), dimension_(dimension), by_vertex_(rows == vertices) {
  if (dimension != 2 && dimension != 3)
    throw std::invalid_argument("the map has " + std::to_string(dimension) + " dimensions, neither 2 nor 3");
  constexpr std::ptrdiff_t kMost = std::numeric_limits<int>::max() / 3;
  if (vertices < 0 || vertices > kMost || columns > kMost ||
      (rows != vertices && rows != dimension * vertices))
    throw std::invalid_argument("the map is " + shape(rows, columns) + ": for " + std::to_string(vertices) +
                                " vertices it is " + std::to_string(vertices) + " x #nodes or " +
                                std::to_string(dimension * vertices) + " x #dof");
  if (by_vertex_) dofs_ = dimension * columns;
  start_.assign(std::size_t(rows) + 1, 0);
  for (const Entry& e : entries) {
    if (!std::isfinite(e.weight))
      throw std::invalid_argument("the weight in row " + std::to_string(e.row) + ", column " +
                                  std::to_string(e.column) + " is not finite");
    ++start_[std::size_t(e.row) + 1];
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  column_.resize(entries.size()), weight_.resize(entries.size());
  std::vector<std::size_t> place(start_.begin(), start_.end());
  for (const Entry& e : entries) {  // by columns, so that those of a row ascend
    const std::size_t k = place[std::size_t(e.row)]++;
    column_[k] = e.column, weight_[k] = e.weight;
  }
}

std::vector<double> VertexMap::product(const std::vector<double>& q) const {
  const FloatEnvironment environment;
  check_count(q.size(), dofs_, "dofs");
  std::vector<double> x(std::size_t(dimension_ * vertices_));
  for (std::ptrdiff_t row = 0; row < dimension_ * vertices_; ++row) {
    double sum = 0;
    each_weight(row, [&](std::ptrdiff_t dof, double w) { sum += w * q[std::size_t(dof)]; });
    x[std::size_t(row)] = sum;
  }
  return x;
}

std::vector<double> VertexMap::transposed(const std::vector<double>& gradient) const {
  const FloatEnvironment environment;
  check_count(gradient.size(), dimension_ * vertices_, "coordinates of the surface");
  std::vector<double> g(std::size_t(dofs_), 0.0);
  for (std::ptrdiff_t row = 0; row < dimension_ * vertices_; ++row)
    each_weight(row,
                [&](std::ptrdiff_t dof, double w) { g[std::size_t(dof)] += w * gradient[std::size_t(row)]; });
  return g;
}

// A stored dof is within 5u Q of the exact one, Q being its larger magnitude at both ends (docs/theory.md,
// L47), and n weights and as many roundings make that (5 + n)u S of a coordinate, S = sum |w| Q. Positions at
// the ends are off by n u S, and so is the motion between them: (2n + 5)u S. Two points of a pair move apart
// or together by sqrt(3) times as much each: 2 sqrt(3) < 3.4642. What underflows is below (2n + 4) 2^-1074 of
// a coordinate where weights are at most 1, and the sum of the weights times 2^-1072 more where they are not.
double VertexMap::rounding_of(const std::vector<double>& q0, const std::vector<double>& q1) const {
  const FloatEnvironment environment;
  check_count(q0.size(), dofs_, "dofs"), check_count(q1.size(), dofs_, "dofs");
  double most = 0;
  for (std::ptrdiff_t row = 0; row < dimension_ * vertices_; ++row) {
    double size = 0, weights = 0, count = 0;
    bool finite = true;
    each_weight(row, [&](std::ptrdiff_t dof, double w) {
      const double a = std::fabs(q0[std::size_t(dof)]), b = std::fabs(q1[std::size_t(dof)]);
      finite = finite && std::isfinite(a) && std::isfinite(b);
      size += std::fabs(w) * std::max(a, b), weights += std::fabs(w), ++count;
    });
    if (!finite) return INFINITY;
    most = std::max(most, (2 * count + 5) * 0x1p-53 * size + (2 * count + 4 + 4 * weights) * 0x1p-1074);
  }
  return 3.4642 * most * (1 + 0x1p-20) + 0x1p-1070;
}

void VertexMap::require_square(std::ptrdiff_t rows, std::ptrdiff_t cols) const {
  if (rows != dimension_ * vertices_ || cols != rows)
    throw std::invalid_argument("got a Hessian of " + shape(rows, cols) + "; the surface has " +
                                std::to_string(dimension_ * vertices_) + " coordinates");
}

void VertexMap::require_columns(std::ptrdiff_t rows, std::ptrdiff_t cols) const {
  if (cols != dimension_)
    throw std::invalid_argument("got " + shape(rows, cols) + " values; a vector, or " +
                                std::to_string(dimension_) + " columns, are expected");
}

void VertexMap::require_dimension(int dimension) const {
  if (dimension != dimension_)
    throw std::invalid_argument("the map has " + std::to_string(dimension_) + " dimensions, the contacts " +
                                std::to_string(dimension));
}

Constraints VertexMap::constraints(const Constraints& surface) const {
  const FloatEnvironment environment;
  if (surface.row.size() != surface.value.size() || surface.dof.size() != surface.value.size())
    throw std::invalid_argument("the constraints have " + std::to_string(surface.row.size()) + " rows, " +
                                std::to_string(surface.dof.size()) + " dofs and " +
                                std::to_string(surface.value.size()) + " values");
  struct Term {
    int row, dof;
    std::size_t order;
    double value;
    bool operator<(const Term& o) const {
      return row != o.row ? row < o.row : dof != o.dof ? dof < o.dof : order < o.order;
    }
  };
  std::vector<Term> terms;
  for (std::size_t k = 0; k < surface.value.size(); ++k) {
    const int of = surface.dof[k];
    if (of < 0 || of >= dimension_ * vertices_)
      throw std::invalid_argument("entry " + std::to_string(k) + " of the constraints is of dof " +
                                  std::to_string(of) + "; the surface has " +
                                  std::to_string(dimension_ * vertices_) + " coordinates");
    each_weight(of, [&](std::ptrdiff_t dof, double w) {
      terms.push_back({surface.row[k], int(dof), terms.size(), surface.value[k] * w});
    });
  }
  std::sort(terms.begin(), terms.end());
  Constraints c;
  c.bound = surface.bound;
  for (const Term& t : terms) {
    if (!c.row.empty() && c.row.back() == t.row && c.dof.back() == t.dof) {
      c.value.back() += t.value;
      continue;
    }
    c.row.push_back(t.row), c.dof.push_back(t.dof), c.value.push_back(t.value);
  }
  return c;
}

}  // namespace onset
