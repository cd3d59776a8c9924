// Arrays of numpy as arguments of the library, and its lists as arrays of numpy.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstdint>
#include <onset/views.hpp>
#include <optional>
#include <vector>

namespace onset_python {

namespace nb = nanobind;

// A real array of one or two axes as doubles: float64 in host memory is viewed, whatever its strides are;
// what float64 holds exactly is copied; anything else is a ValueError that names the argument.
class DoublesArgument {
 public:
  DoublesArgument(const char* name, nb::handle x);
  std::size_t axes() const { return array_.ndim(); }
  std::ptrdiff_t rows() const { return std::ptrdiff_t(array_.shape(0)); }
  std::ptrdiff_t cols() const { return axes() == 2 ? std::ptrdiff_t(array_.shape(1)) : 1; }
  double operator()(std::ptrdiff_t row, std::ptrdiff_t col = 0) const {
    return array_.data()[row * array_.stride(0) + (axes() == 2 ? col * array_.stride(1) : 0)];
  }
  // ValueError where it is not rows x cols.
  void require_shape(const char* name, std::ptrdiff_t rows, std::ptrdiff_t cols) const;
  onset::Positions positions() const;
  std::vector<double> list() const;  // by rows

 private:
  nb::ndarray<const double, nb::device::cpu> array_;
};

// #V x 3, #V x 2, or flat. It keeps the array alive.
class PositionsArgument {
 public:
  PositionsArgument(const char* name, nb::handle x) : array_(name, x), view_(array_.positions()) {}
  operator const onset::Positions&() const { return view_; }
  const onset::Positions* operator->() const { return &view_; }

 private:
  DoublesArgument array_;
  onset::Positions view_;
};

// Integers of any width, at most 2^63 - 1 in magnitude; an array without elements may be of any kind.
// columns: of an array that has no elements.
onset::Indices indices(const char* name, nb::handle ids, int columns);
// One axis, each an int. None: empty.
std::vector<int> ids(const char* name, nb::handle values);
std::vector<double> doubles(const char* name, nb::handle values);
std::vector<bool> flags(const char* name, nb::handle values);
std::vector<std::uint32_t> bits(const char* name, nb::handle values);
// #pairs x 2.
std::vector<std::array<int, 2>> id_pairs(const char* name, nb::handle values);
std::array<double, 3> vector3(const char* name, nb::handle values);

// A real number, of Python or of numpy; none for anything else, complex numbers among it.
std::optional<double> real_number(nb::handle value);
// A bool_ of numpy.
std::optional<bool> numpy_flag(nb::handle value);
// An int of Python or numpy, not an array.
bool is_whole_number(nb::handle value);
// ValueError where it does not fit into 64 bits.
std::ptrdiff_t whole_number(const char* name, nb::handle value);

// A read-only array of what `owner` holds.
template <class T>
nb::object array_of(const T* data, std::initializer_list<std::size_t> shape, nb::handle owner) {
  static const T none{};
  return nb::ndarray<nb::numpy, const T>(data != nullptr ? data : &none, shape, owner).cast();
}
template <class T>
nb::object array_of(const std::vector<T>& values, nb::handle owner) {
  return array_of(values.data(), {values.size()}, owner);
}
template <class T, std::size_t N>
nb::object array_of(const std::vector<std::array<T, N>>& rows, nb::handle owner) {
  return array_of(rows.empty() ? nullptr : rows.front().data(), {rows.size(), N}, owner);
}

// An array of its own.
template <class List>
nb::object taken_array(List&& list) {
  auto* kept = new List(std::forward<List>(list));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<List*>(p); });
  return array_of(*kept, owner);
}

}  // namespace onset_python
