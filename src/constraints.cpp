#include "onset/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/float_environment.hpp"

namespace onset {
namespace {

constexpr int kLargestVertex = (std::numeric_limits<int>::max() - 2) / 3;

int mapped(int vertex, const std::vector<int>& full_vertex) {
  if (!full_vertex.empty() && std::size_t(vertex) >= full_vertex.size())
    throw std::invalid_argument("full_vertex has " + std::to_string(full_vertex.size()) + " ids; vertex " +
                                std::to_string(vertex) + " has none");
  const int id = full_vertex.empty() ? vertex : full_vertex[std::size_t(vertex)];
  if (id < 0 || id > kLargestVertex)
    throw std::invalid_argument("full_vertex row " + std::to_string(vertex) + ": id " + std::to_string(id) +
                                " is not in [0, " + std::to_string(kLargestVertex) + "]");
  return id;
}

std::array<int, 4> mapped(const std::array<int, 4>& vertices, const std::vector<int>& full_vertex) {
  std::array<int, 4> r;
  for (std::size_t i = 0; i < 4; ++i) {
    r[i] = mapped(vertices[i], full_vertex);
    for (std::size_t j = 0; j < i; ++j)
      if (r[j] == r[i] && vertices[j] != vertices[i])
        throw std::invalid_argument("full_vertex rows " + std::to_string(vertices[j]) + " and " +
                                    std::to_string(vertices[i]) + " of one contact are both " +
                                    std::to_string(r[i]));
  }
  return r;
}

// Returns the place of a plane along its unit normal.
double place_of(const ActiveSet& set, int row) {
  if (row < 0 || std::size_t(row) >= set.planes.size())
    throw std::invalid_argument("a contact is with plane " + std::to_string(row) + "; the set has " +
                                std::to_string(set.planes.size()));
  const Plane& plane = set.planes[std::size_t(row)];
  double largest = 0, squares = 0;
  for (const double n : plane.normal) largest = std::max(largest, std::fabs(n));
  const int exponent = std::ilogb(largest);
  for (const double n : plane.normal) squares += std::ldexp(n, -exponent) * std::ldexp(n, -exponent);
  int e = 0;
  const double offset = std::frexp(plane.offset, &e);
  return std::ldexp(offset / std::sqrt(squares), e - exponent);
}

}  // namespace

Constraints assemble_constraints(const ActiveSet& set, double eta, const std::vector<int>& full_vertex) {
  const FloatEnvironment environment;
  if (!std::isfinite(eta)) throw std::invalid_argument("eta is not finite");
  Constraints c;
  c.bound.assign(set.size(), eta);
  const std::size_t columns = std::size_t(set.dimension), points = columns == 2 ? 3 : 4;
  for (std::vector<int>* ids : {&c.row, &c.dof}) ids->reserve(columns * points * set.size());
  c.value.reserve(columns * points * set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    std::array<int, 4> of_contact = set[i].vertices;
    if (set[i].kind == PairKind::vertex_plane) {
      of_contact.fill(set[i].a);
      c.bound[i] += place_of(set, set[i].b);
    }
    const std::array<int, 4> vertices = mapped(of_contact, full_vertex);
    for (std::size_t k = 0; k < points; ++k)
      for (std::size_t a = 0; a < columns; ++a) {
        c.row.push_back(int(i));
        c.dof.push_back(set.dimension * vertices[k] + int(a));
        c.value.push_back(set[i].weights[k] * set[i].normal[a]);
      }
  }
  return c;
}

}  // namespace onset
