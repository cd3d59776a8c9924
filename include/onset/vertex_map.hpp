// Surface vertices as weighted means of degrees of freedom: surfaces of high-order elements, and embedded
// ones.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <onset/active_set.hpp>
#include <onset/constraints.hpp>
#include <onset/export.hpp>
#include <onset/step_size.hpp>
#include <vector>

namespace onset {

// A sparse map from degrees of freedom (dofs) to the coordinates of surface vertices, x = M q, for positions
// and displacements alike, and what its transpose takes back: constraints, gradients and Hessians. Positions
// are what calls are asked about: they are evaluated once, and kept.
//
// Immutable; safe to use from several threads. All is computed in the floating-point environment of the
// library, and is the same bytes on every host.
class ONSET_API VertexMap {
 public:
  // Of no vertices: to be assigned to.
  VertexMap() = default;
  // vertices: #V, those of the surface.
  // weights: #V x #N, a weight for each vertex and node, where a node has three dofs (x y z of node 0, ...);
  // or 3 #V x #dof, a weight for each coordinate and dof. Explicit zeros are kept.
  // dimension: 3, or 2 of a mesh in the plane, where all that is 3 here is 2.
  // Throws std::invalid_argument for another number of rows or dimensions, and naming the row and column of a
  // weight that is not finite.
  VertexMap(std::ptrdiff_t vertices, const Eigen::SparseMatrix<double>& weights, int dimension = 3)
      : VertexMap(vertices, dimension, weights.rows(), weights.cols(), entries_of(weights)) {}

  std::ptrdiff_t num_vertices() const noexcept { return vertices_; }
  std::ptrdiff_t num_dofs() const noexcept { return dofs_; }
  int dimension() const noexcept { return int(dimension_); }

  // Evaluates M q: x y z of each vertex, `Positions(p.data(), num_vertices())`.
  // q: a vector of num_dofs() values, or a matrix of #N x 3. Throws std::invalid_argument for another shape.
  //
  // Guarantee: products are added in the order of columns, each rounded: with n weights in a row, a
  // coordinate is within n u sum |w| |q| (1 + n u) of the exact one, u = 2^-53, where nothing underflows.
  template <class Derived>
  std::vector<double> positions(const Eigen::DenseBase<Derived>& q) const {
    return product(flat(q));
  }

  // Returns a length, in the unit of q: where the dofs q0 + s (q1 - q0) are what a simulator stores, in one
  // of the orders of operations that docs/steps.md names, and positions are evaluated from them, the distance
  // of a pair differs by less than this from that on the straight motion between positions(q0) and
  // positions(q1). A min_separation of this much keeps pairs apart all the same, if they start farther apart
  // than that; one that starts nearer is an initial contact, or parts or rests, and what is evaluated of it
  // may touch. Infinite where q is not finite.
  template <class Derived, class Other>
  double rounding(const Eigen::DenseBase<Derived>& q0, const Eigen::DenseBase<Other>& q1) const {
    return rounding_of(flat(q0), flat(q1));
  }

  // Returns the rows of constraints of the surface (assemble_constraints without full_vertex) as rows in the
  // dofs: A_q = A_x M. Entries are ordered by row, then by dof, each dof once a row; `bound` is that of the
  // surface. Throws std::invalid_argument for an entry that is not of the surface's coordinates, and for
  // lists of different lengths.
  Constraints constraints(const Constraints& surface) const;

  // Takes a gradient in the surface's coordinates (3 #V values: x y z of vertex 0, ...) to the dofs: M^T g.
  // Throws std::invalid_argument for another size.
  template <class Derived>
  Eigen::VectorXd to_dofs(const Eigen::DenseBase<Derived>& gradient) const {
    const std::vector<double> g = transposed(flat(gradient));
    return Eigen::Map<const Eigen::VectorXd>(g.data(), Eigen::Index(g.size()));
  }
  // Takes a Hessian (3 #V x 3 #V) to the dofs: M^T H M. Throws std::invalid_argument for another size.
  Eigen::SparseMatrix<double> to_dofs(const Eigen::SparseMatrix<double>& hessian) const {
    require_square(hessian.rows(), hessian.cols());
    Eigen::SparseMatrix<double> r;
    in_default_float_environment([&] {
      const Eigen::SparseMatrix<double> m = matrix();
      r = m.transpose() * hessian * m;
    });
    return r;
  }

  // M, 3 #V x #dof.
  Eigen::SparseMatrix<double> matrix() const {
    Eigen::SparseMatrix<double> m(Eigen::Index(dimension_ * vertices_), Eigen::Index(dofs_));
    std::vector<Eigen::Triplet<double>> entries;
    for (std::ptrdiff_t row = 0; row < dimension_ * vertices_; ++row)
      each_weight(row, [&](std::ptrdiff_t dof, double w) { entries.emplace_back(int(row), int(dof), w); });
    m.setFromTriplets(entries.begin(), entries.end());
    return m;
  }

  // Throws std::invalid_argument for a set or mesh of another dimension.
  void require_dimension(int dimension) const;

 private:
  struct Entry {
    std::ptrdiff_t row, column;
    double weight;
  };
  VertexMap(std::ptrdiff_t vertices, int dimension, std::ptrdiff_t rows, std::ptrdiff_t columns,
            const std::vector<Entry>& entries);
  static std::vector<Entry> entries_of(const Eigen::SparseMatrix<double>& weights) {
    std::vector<Entry> all;
    for (int column = 0; column < weights.outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator i(weights, column); i; ++i)
        all.push_back({i.row(), i.col(), i.value()});
    return all;
  }
  template <class Derived>
  std::vector<double> flat(const Eigen::DenseBase<Derived>& m) const {
    const auto& e = m.derived().eval();
    if (e.rows() != 1 && e.cols() != 1) require_columns(e.rows(), e.cols());
    std::vector<double> values;
    values.reserve(std::size_t(e.size()));
    for (Eigen::Index r = 0; r < e.rows(); ++r)
      for (Eigen::Index c = 0; c < e.cols(); ++c) values.push_back(double(e(r, c)));
    return values;
  }
  // f(dof, weight) for each weight of a coordinate, by ascending dof.
  template <class F>
  void each_weight(std::ptrdiff_t row, F&& f) const {
    const std::ptrdiff_t stride = by_vertex_ ? dimension_ : 1, axis = by_vertex_ ? row % dimension_ : 0;
    const std::size_t from = std::size_t(row / stride);
    for (std::size_t k = start_[from]; k < start_[from + 1]; ++k) f(stride * column_[k] + axis, weight_[k]);
  }
  std::vector<double> product(const std::vector<double>& q) const;
  std::vector<double> transposed(const std::vector<double>& gradient) const;
  double rounding_of(const std::vector<double>& q0, const std::vector<double>& q1) const;
  void require_square(std::ptrdiff_t rows, std::ptrdiff_t cols) const;
  void require_columns(std::ptrdiff_t rows, std::ptrdiff_t cols) const;

  std::ptrdiff_t vertices_ = 0, dofs_ = 0, dimension_ = 3;
  // Whether a weight is that of all three coordinates.
  bool by_vertex_ = true;
  // Compressed rows.
  std::vector<std::size_t> start_{0};
  std::vector<std::ptrdiff_t> column_;
  std::vector<double> weight_;
};

// As assemble_constraints, in the dofs of a map: `map.constraints(assemble_constraints(set, eta))`.
inline Constraints assemble_constraints(const ActiveSet& set, double eta, const VertexMap& map) {
  map.require_dimension(set.dimension);
  return map.constraints(assemble_constraints(set, eta));
}

}  // namespace onset
