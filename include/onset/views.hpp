// Views of the caller's positions and indices: what crosses the library's boundary instead of Eigen objects.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace onset {

// #V x 3 positions (model length), one row a vertex; #V x 2 for a mesh in the plane.
//
// Guarantee: dense double storage is viewed without a copy and must outlive the view, which in a call means
// the call; anything else (expressions such as `x + dx`, float matrices) is evaluated into a copy that the
// view owns. Nothing is checked here: the call that gets the view throws std::invalid_argument for a wrong
// shape. Reading a view is safe from several threads.
class Positions {
 public:
  // From interleaved memory: xyz of vertex 0, xyz of vertex 1, ..., 3 `vertices` doubles; xy with 2
  // `columns`.
  Positions(const double* xyz, std::ptrdiff_t vertices, int columns = 3) noexcept
      : data_(xyz), rows_(vertices), cols_(columns), row_stride_(columns), col_stride_(1) {}

  // From memory of any layout: (r, c) is at data + r row_stride + c col_stride, in doubles, which may be
  // below 0.
  Positions(const double* data, std::ptrdiff_t rows, std::ptrdiff_t cols, std::ptrdiff_t row_stride,
            std::ptrdiff_t col_stride) noexcept
      : data_(data), rows_(rows), cols_(cols), row_stride_(row_stride), col_stride_(col_stride) {}

  // From any Eigen matrix (column- or row-major, a Map, a block, float or double) of #V x 3, or from a flat
  // vector of 3 #V degrees of freedom (x y z of vertex 0, x y z of vertex 1, ...). Those of a mesh in the
  // plane are not flat.
  template <class Derived>
  Positions(const Eigen::DenseBase<Derived>& m) {  // NOLINT: implicit by design
    constexpr bool viewable = std::is_same_v<typename Derived::Scalar, double> &&
                              (int(Derived::Flags) & Eigen::DirectAccessBit) != 0;
    if constexpr (viewable) {
      const bool row_major = Derived::IsRowMajor;
      assign(m.derived().data(), m.rows(), m.cols(),
             row_major ? m.derived().outerStride() : m.derived().innerStride(),
             row_major ? m.derived().innerStride() : m.derived().outerStride());
    } else {
      const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic> evaluated =
          m.derived().template cast<double>();
      owned_ = std::make_shared<std::vector<double>>(evaluated.data(), evaluated.data() + evaluated.size());
      assign(owned_->data(), evaluated.rows(), evaluated.cols(), 1, evaluated.rows());
    }
  }

  std::ptrdiff_t rows() const noexcept { return rows_; }
  // 3 or 2, or what the caller passed by mistake.
  std::ptrdiff_t cols() const noexcept { return cols_; }
  double operator()(std::ptrdiff_t row, std::ptrdiff_t col) const noexcept {
    return data_[row * row_stride_ + col * col_stride_];
  }
  // Where (0, 0) is, and how many doubles on the next row and column are.
  const double* data() const noexcept { return data_; }
  std::ptrdiff_t row_stride() const noexcept { return row_stride_; }
  std::ptrdiff_t col_stride() const noexcept { return col_stride_; }

  // The same points at z = 0: three columns, in a copy that the result owns.
  Positions in_space() const {
    auto copy = std::make_shared<std::vector<double>>(std::size_t(3 * rows_), 0.0);
    for (std::ptrdiff_t v = 0; v < rows_; ++v)
      for (std::ptrdiff_t a = 0; a < 2; ++a) (*copy)[std::size_t(3 * v + a)] = (*this)(v, a);
    Positions r(copy->data(), rows_);
    r.owned_ = std::move(copy);
    return r;
  }

 private:
  void assign(const double* data, std::ptrdiff_t rows, std::ptrdiff_t cols, std::ptrdiff_t row_stride,
              std::ptrdiff_t col_stride) {
    data_ = data;
    if ((cols == 1 || rows == 1) && (rows * cols) % 3 == 0 && !(rows == 1 && cols == 3)) {  // flat
      const std::ptrdiff_t stride = cols == 1 ? row_stride : col_stride;
      rows_ = rows * cols / 3, cols_ = 3, row_stride_ = 3 * stride, col_stride_ = stride;
    } else {
      rows_ = rows, cols_ = cols, row_stride_ = row_stride, col_stride_ = col_stride;
    }
  }

  std::shared_ptr<std::vector<double>> owned_;
  const double* data_ = nullptr;
  std::ptrdiff_t rows_ = 0, cols_ = 3, row_stride_ = 3, col_stride_ = 1;
};

// #V x 3 (in the plane #V x 2) positions that are kept: a copy of what Positions views, in memory of the
// standard library, which unlike Eigen's is the same on both sides of the library's boundary under any flags.
class StoredPositions {
 public:
  StoredPositions() noexcept = default;
  template <class Derived>
  StoredPositions(const Eigen::DenseBase<Derived>& m)  // NOLINT: implicit by design
      : StoredPositions(Positions(m)) {}
  explicit StoredPositions(const Positions& x) : rows_(x.rows()), cols_(x.cols()) {
    values_.reserve(std::size_t(rows_ * cols_));
    for (std::ptrdiff_t r = 0; r < rows_; ++r)
      for (std::ptrdiff_t c = 0; c < cols_; ++c) values_.push_back(x(r, c));
  }
  std::ptrdiff_t rows() const noexcept { return rows_; }
  std::ptrdiff_t cols() const noexcept { return cols_; }
  std::ptrdiff_t size() const noexcept { return rows_ * cols_; }
  double operator()(std::ptrdiff_t row, std::ptrdiff_t col) const noexcept {
    return values_[std::size_t(row * cols_ + col)];
  }
  operator Eigen::MatrixXd() const {  // NOLINT: implicit by design
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const Rows>(values_.data(), rows_, cols_);
  }

 private:
  std::vector<double> values_;
  std::ptrdiff_t rows_ = 0, cols_ = 0;
};

// #E x 2 or #F x 3 vertex ids, one row an element, from any Eigen matrix of integers. Guarantee: it owns a
// copy. The mesh that gets it checks ids and shape.
class Indices {
 public:
  Indices() noexcept = default;
  template <class Derived>
  Indices(const Eigen::DenseBase<Derived>& m)
      : rows_(m.rows()), cols_(m.cols()) {  // NOLINT: implicit by design
    static_assert(std::is_integral_v<typename Derived::Scalar>, "vertex ids are integers");
    const auto& e = m.derived().eval();
    ids_.reserve(std::size_t(e.size()));
    for (std::ptrdiff_t r = 0; r < rows_; ++r)
      for (std::ptrdiff_t c = 0; c < cols_; ++c) ids_.push_back(static_cast<long long>(e(r, c)));
  }
  std::ptrdiff_t rows() const noexcept { return rows_; }
  std::ptrdiff_t cols() const noexcept { return cols_; }
  long long operator()(std::ptrdiff_t row, std::ptrdiff_t col) const noexcept {
    return ids_[std::size_t(row * cols_ + col)];
  }

 private:
  std::vector<long long> ids_;
  std::ptrdiff_t rows_ = 0, cols_ = 0;
};

}  // namespace onset
