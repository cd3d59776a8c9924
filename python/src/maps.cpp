// Surface vertices as weighted means of degrees of freedom; sparse matrices are triplets (row, column,
// value).
#include <onset/vertex_map.hpp>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "conversion/arrays.hpp"

namespace onset_python {
namespace {

using onset::VertexMap;
using Sparse = Eigen::SparseMatrix<double>;

// Triplets of one place are added up.
Sparse sparse(nb::handle row, nb::handle column, nb::handle value, std::ptrdiff_t rows,
              std::ptrdiff_t columns) {
  const std::vector<int> r = ids("row", row), c = ids("column", column);
  const std::vector<double> v = doubles("value", value);
  if (r.size() != c.size() || r.size() != v.size())
    throw std::invalid_argument("row, column and value have " + std::to_string(r.size()) + ", " +
                                std::to_string(c.size()) + " and " + std::to_string(v.size()) + " entries");
  if (rows < 0 || columns < 0) throw std::invalid_argument("the shape is negative");
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < r.size(); ++k) {
    if (r[k] < 0 || r[k] >= rows || c[k] < 0 || c[k] >= columns)
      throw std::invalid_argument("entry " + std::to_string(k) + " is at (" + std::to_string(r[k]) + ", " +
                                  std::to_string(c[k]) + "), beyond " + std::to_string(rows) + " x " +
                                  std::to_string(columns));
    entries.emplace_back(r[k], c[k], v[k]);
  }
  Sparse m(rows, columns);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

nb::tuple triplets(const Sparse& m) {
  std::vector<int> row, column;
  std::vector<double> value;
  for (int outer = 0; outer < m.outerSize(); ++outer)
    for (Sparse::InnerIterator i(m, outer); i; ++i)
      row.push_back(int(i.row())), column.push_back(int(i.col())), value.push_back(i.value());
  return nb::make_tuple(taken_array(std::move(row)), taken_array(std::move(column)),
                        taken_array(std::move(value)));
}

Eigen::MatrixXd matrix_of(const char* name, nb::handle values) {
  const DoublesArgument x(name, values);
  Eigen::MatrixXd m(x.rows(), x.cols());
  for (Eigen::Index r = 0; r < m.rows(); ++r)
    for (Eigen::Index c = 0; c < m.cols(); ++c) m(r, c) = x(r, c);
  return m;
}

#define ONSET_TRIPLETS                                                           \
  "tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.int32], " \
  "numpy.typing.NDArray[numpy.float64]]"

}  // namespace

void bind_maps(nb::module_& m) {
  nb::class_<VertexMap>(m, "VertexMap", doc("VertexMap"))
      .def(
          "__init__",
          [](VertexMap* map, std::ptrdiff_t vertices, nb::handle row, nb::handle column, nb::handle value,
             std::pair<std::ptrdiff_t, std::ptrdiff_t> shape, int dimension) {
            new (map) VertexMap(vertices, sparse(row, column, value, shape.first, shape.second), dimension);
          },
          nb::arg("vertices"), nb::arg("row"), nb::arg("column"), nb::arg("value"), nb::arg("shape"),
          nb::arg("dimension") = 3,
          nb::sig("def __init__(self, vertices: int, row: numpy.typing.ArrayLike, column: "
                  "numpy.typing.ArrayLike, value: "
                  "numpy.typing.ArrayLike, shape: tuple[int, int], dimension: int = 3) -> None"),
          doc("VertexMap.VertexMap#2"))
      .def_prop_ro("num_vertices", &VertexMap::num_vertices)
      .def_prop_ro("num_dofs", &VertexMap::num_dofs)
      .def_prop_ro("dimension", &VertexMap::dimension)
      .def(
          "positions",
          [](const VertexMap& map, nb::handle q) {
            const Eigen::MatrixXd dofs = matrix_of("q", q);
            return taken_array(without_lock([&] { return map.positions(dofs); }))
                .attr("reshape")(map.num_vertices(), map.dimension());
          },
          nb::arg("q"),
          nb::sig("def positions(self, q: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"),
          doc("VertexMap.positions"))
      .def(
          "rounding",
          [](const VertexMap& map, nb::handle q0, nb::handle q1) {
            const Eigen::MatrixXd from = matrix_of("q0", q0), to = matrix_of("q1", q1);
            return without_lock([&] { return map.rounding(from, to); });
          },
          nb::arg("q0"), nb::arg("q1"),
          nb::sig("def rounding(self, q0: numpy.typing.ArrayLike, q1: numpy.typing.ArrayLike) -> float"),
          doc("VertexMap.rounding"))
      .def(
          "constraints",
          [](const VertexMap& map, const onset::Constraints& surface) {
            return without_lock([&] { return map.constraints(surface); });
          },
          nb::arg("surface"), doc("VertexMap.constraints"))
      .def(
          "to_dofs",
          [](const VertexMap& map, nb::handle gradient) {
            const Eigen::MatrixXd surface = matrix_of("gradient", gradient);
            const Eigen::VectorXd g = without_lock([&] { return Eigen::VectorXd(map.to_dofs(surface)); });
            return taken_array(std::vector<double>(g.data(), g.data() + g.size()));
          },
          nb::arg("gradient"),
          nb::sig(
              "def to_dofs(self, gradient: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"),
          doc("VertexMap.to_dofs"))
      .def(
          "hessian_to_dofs",
          [](const VertexMap& map, nb::handle row, nb::handle column, nb::handle value) {
            const std::ptrdiff_t n = map.dimension() * map.num_vertices();
            const Sparse surface = sparse(row, column, value, n, n);
            return triplets(without_lock([&] { return Sparse(map.to_dofs(surface)); }));
          },
          nb::arg("row"), nb::arg("column"), nb::arg("value"),
          nb::sig(
              "def hessian_to_dofs(self, row: numpy.typing.ArrayLike, column: numpy.typing.ArrayLike, value: "
              "numpy.typing.ArrayLike) -> " ONSET_TRIPLETS),
          doc("VertexMap.to_dofs#2"))
      .def(
          "matrix",
          [](const VertexMap& map) { return triplets(without_lock([&] { return Sparse(map.matrix()); })); },
          nb::sig("def matrix(self) -> " ONSET_TRIPLETS), doc("VertexMap.matrix"));
}

}  // namespace onset_python
