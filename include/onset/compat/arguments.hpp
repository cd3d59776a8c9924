// What the calls of onset/compat/ipc.hpp take matrices by, and the small vectors that they are written with.
//
// Source: the names of the types are those of ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace onset::ipc {

using index_t = std::int32_t;

template <class T, int max_size>
using VectorMax = Eigen::Matrix<T, Eigen::Dynamic, 1, Eigen::ColMajor, max_size, 1>;
// Points of two or three coordinates; weights of up to four vertices; the coordinates of up to four points.
using VectorMax3d = VectorMax<double, 3>;
using VectorMax4d = VectorMax<double, 4>;
using VectorMax12d = VectorMax<double, 12>;

// A matrix argument: any Eigen matrix, column- or row-major, a Map, a block, an expression, of any scalar
// that Scalar can hold.
//
// Guarantee: a MatrixXd (of ids: MatrixXi) is viewed without a copy and must outlive the view, which in a
// call means the call; all else is evaluated into a copy. Throws std::invalid_argument for an id beyond int.
template <class Scalar>
class Argument {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  // No rows and no columns.
  Argument() : matrix_(&copy_) {}
  Argument(const Matrix& m) : matrix_(&m) {}  // NOLINT: implicit by design
  template <class Derived>
  Argument(const Eigen::DenseBase<Derived>& m)  // NOLINT: implicit by design
      : copy_(converted(m.derived().eval())), matrix_(&copy_) {}
  Argument(const Argument&) = delete;
  Argument& operator=(const Argument&) = delete;

  operator const Matrix&() const { return *matrix_; }  // NOLINT: implicit by design
  const Matrix& operator*() const { return *matrix_; }
  const Matrix* operator->() const { return matrix_; }

 private:
  template <class M>
  static Matrix converted(const M& m) {
    if constexpr (std::is_integral_v<Scalar>) {
      static_assert(std::is_integral_v<typename M::Scalar>, "ids are integers");
      for (Eigen::Index c = 0; c < m.cols(); ++c)
        for (Eigen::Index r = 0; r < m.rows(); ++r)
          if (static_cast<long long>(m(r, c)) != static_cast<Scalar>(m(r, c)))
            throw std::invalid_argument("row " + std::to_string(r) + ": vertex " + std::to_string(m(r, c)) +
                                        " is beyond the range of int");
    }
    return m.template cast<Scalar>();
  }

  Matrix copy_;
  const Matrix* matrix_;
};
using Vertices = Argument<double>;
using Ids = Argument<int>;

// A vector argument of at most max_size coordinates: any vector of Eigen. A copy, since Eigen does not look
// at the size of what it converts but in debug builds.
// Throws std::invalid_argument for more coordinates.
template <int max_size>
class VectorArgument {
 public:
  template <class Derived>
  VectorArgument(const Eigen::MatrixBase<Derived>& v) {  // NOLINT: implicit by design
    static_assert(Derived::IsVectorAtCompileTime, "a vector");
    if (v.size() > max_size)
      throw std::invalid_argument(std::to_string(v.size()) + " coordinates; there are at most " +
                                  std::to_string(max_size));
    const typename Derived::PlainObject x = v;
    vector_.resize(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) vector_[i] = double(x[i]);
  }
  const VectorMax<double, max_size>& operator*() const { return vector_; }
  const VectorMax<double, max_size>* operator->() const { return &vector_; }

 private:
  VectorMax<double, max_size> vector_;
};
using Dofs = VectorArgument<12>;

}  // namespace onset::ipc

namespace onset::compat {

// Throws std::invalid_argument for positions of more than three coordinates.
inline void require_space(const Eigen::MatrixXd& x) {
  if (x.cols() > 3)
    throw std::invalid_argument("positions have " + std::to_string(x.cols()) + " columns, not 2 or 3");
}

}  // namespace onset::compat
