// The Newton system of the free vertices, assembled from 3 x 3 blocks.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <vector>

namespace simulation {

// Positions, velocities and gradients are flat: x y z of vertex 0, x y z of vertex 1, ...
using Vector = Eigen::VectorXd;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

inline Vec3 at(const Vector& x, int v) { return x.segment<3>(3 * v); }

// H dx = -g for the free vertices, where the others move by a given dx.
class System {
 public:
  System(const std::vector<char>& is_free, const Vector& moved) : row_(is_free.size(), -1), moved_(moved) {
    for (std::size_t v = 0; v < is_free.size(); ++v)
      if (is_free[v]) row_[v] = 3 * free_++;
    rhs_ = Vector::Zero(3 * free_);
  }

  void add_gradient(int v, const Vec3& g) {
    if (row_[std::size_t(v)] >= 0) rhs_.segment<3>(row_[std::size_t(v)]) -= g;
  }

  // The block of vertices i and j; call it for (i, j) and (j, i).
  void add_block(int i, int j, const Mat3& block) {
    const int r = row_[std::size_t(i)], c = row_[std::size_t(j)];
    if (r < 0) return;
    if (c < 0) {
      rhs_.segment<3>(r) -= block * at(moved_, j);
      return;
    }
    if (r < c) return;  // the factorization reads the lower triangle
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        if (r + a >= c + b) entries_.emplace_back(r + a, c + b, block(a, b));
  }

  // Its lower triangle, where all blocks are added.
  Eigen::SparseMatrix<double> lower() const {
    Eigen::SparseMatrix<double> H(rhs_.size(), rhs_.size());
    H.setFromTriplets(entries_.begin(), entries_.end());
    return H;
  }
  const Vector& rhs() const { return rhs_; }  // -g
  int row(int v) const { return row_[std::size_t(v)]; }

  // A direction for all vertices, out of that of the free ones.
  Vector of_all(const Vector& of_free) const {
    Vector dx = moved_;
    for (std::size_t v = 0; v < row_.size(); ++v)
      if (row_[v] >= 0) dx.segment<3>(3 * Eigen::Index(v)) = of_free.segment<3>(row_[v]);
    return dx;
  }

  // The direction, for all vertices. The blocks added must make up a positive definite matrix.
  Vector solve() const {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(lower());
    return of_all(factor.solve(rhs_));
  }

 private:
  std::vector<int> row_;  // -1: not free
  int free_ = 0;
  Vector moved_, rhs_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace simulation
