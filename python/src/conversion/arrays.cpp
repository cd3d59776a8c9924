#include "conversion/arrays.hpp"

#include <nanobind/stl/string.h>

#include <Eigen/Core>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace onset_python {
namespace {

nb::object numpy() { return nb::module_::import_("numpy"); }

// `values` as numpy sees them; what it cannot read is a ValueError with the argument's name.
nb::object as_array(const char* name, nb::handle values) {
  try {
    return numpy().attr("asarray")(values);
  } catch (nb::python_error& e) {
    if (!e.matches(PyExc_ValueError) && !e.matches(PyExc_TypeError)) throw;
    nb::raise_from(e, PyExc_ValueError, "%s is not an array of numbers", name);
  }
}

std::string type_of(const nb::object& array) {
  return nb::cast<std::string>(array.attr("dtype").attr("name"));
}

std::string shape_of(const nb::object& array) {
  return nb::cast<std::string>(array.attr("shape").attr("__str__")());
}

bool is_of_kind(const nb::object& array, const char* kinds) {
  return std::string(kinds).find(nb::cast<std::string>(array.attr("dtype").attr("kind"))) !=
         std::string::npos;
}

[[noreturn]] void reject(const char* name, const std::string& what) {
  throw std::invalid_argument(std::string(name) + " " + what);
}

// Of masked arrays numpy hands out what lies behind the mask, too.
void require_unmasked(const char* name, nb::handle values) {
  if (nb::hasattr(values, "mask") && nb::hasattr(values, "filled") &&
      PyObject_IsTrue(numpy().attr("any")(values.attr("mask")).ptr()) == 1)
    reject(name, "is a masked array with elements that are masked");
}

using Doubles = nb::ndarray<const double, nb::device::cpu>;

// Doubles need to be aligned: numpy gives views of packed records that are not.
bool view(nb::handle x, Doubles& into) {
  return nb::try_cast(x, into, false) && reinterpret_cast<std::uintptr_t>(into.data()) % alignof(double) == 0;
}

Doubles viewed_or_copied(const char* name, nb::handle x) {
  Doubles array;
  if (std::strcmp(Py_TYPE(x.ptr())->tp_name, "numpy.ndarray") != 0) require_unmasked(name, x);
  if (view(x, array)) return array;
  const nb::object given = as_array(name, x);
  const nb::object dtype = numpy().attr("float64");
  if (nb::cast<std::size_t>(given.attr("size")) > 0 &&
      (!is_of_kind(given, "fiub") ||
       !nb::cast<bool>(numpy().attr("can_cast")(given.attr("dtype"), dtype, "safe"))))
    reject(name, "is an array of " + type_of(given) + ", which float64 does not hold");
  if (is_of_kind(given, "iu") && nb::cast<int>(given.attr("itemsize")) > 4) {
    const nb::object quiet = numpy().attr("errstate")(nb::arg("invalid") = "ignore");
    quiet.attr("__enter__")();
    const nb::object back = given.attr("astype")(dtype).attr("astype")(given.attr("dtype"));
    quiet.attr("__exit__")(nb::none(), nb::none(), nb::none());
    if (!nb::cast<bool>(numpy().attr("array_equal")(back, given)))
      reject(name, "has whole numbers that float64 does not hold");
  }
  const nb::object copy = nb::cast<std::size_t>(given.attr("size")) > 0
                              ? numpy().attr("array")(given, dtype, nb::arg("order") = "C")
                              : numpy().attr("zeros")(given.attr("shape"));
  if (!view(copy, array)) reject(name, "cannot be read as an array of float64");
  return array;
}

// numpy wraps what is too large around, with a warning at most.
void require_int64(const char* name, const nb::object& given) {
  if (!is_of_kind(given, "u") || nb::cast<std::size_t>(given.attr("itemsize")) < 8) return;
  const auto largest = nb::cast<std::uint64_t>(given.attr("max")());
  if (largest <= std::uint64_t(std::numeric_limits<std::int64_t>::max())) return;
  const nb::object shape = given.attr("shape");
  const std::size_t columns = nb::len(shape) < 2 ? 1 : nb::cast<std::size_t>(shape[1]);
  const std::size_t row = nb::cast<std::size_t>(given.attr("argmax")()) / columns;
  reject(name, "row " + std::to_string(row) + ": " + std::to_string(largest) + " is out of range");
}

// Integers as an array of int64, without elements also where they were of another type.
nb::ndarray<const std::int64_t, nb::device::cpu> integers(const char* name, nb::handle values,
                                                          std::size_t axes) {
  const nb::object given = as_array(name, values);
  const std::size_t size = nb::cast<std::size_t>(given.attr("size"));
  if (size > 0 && !is_of_kind(given, "iu"))
    reject(name, "is an array of " + type_of(given) + "; it must be one of integers");
  if (size > 0 && nb::cast<std::size_t>(given.attr("ndim")) != axes)
    reject(name,
           "is of shape " + shape_of(given) + "; it must have " + (axes == 1 ? "one axis" : "two axes"));
  require_unmasked(name, values);
  if (size > 0) require_int64(name, given);
  nb::ndarray<const std::int64_t, nb::device::cpu> array;
  const nb::object type = numpy().attr("int64");
  const nb::object as_int64 = size > 0 ? numpy().attr("ascontiguousarray")(given, type)
                                       : numpy().attr("zeros")(given.attr("shape"), type);
  if (!nb::try_cast(as_int64, array, false)) reject(name, "cannot be read as an array of integers");
  return array;
}

int narrowed(const char* name, std::size_t row, std::int64_t value) {
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    reject(name, "row " + std::to_string(row) + ": " + std::to_string(value) + " is out of range");
  return int(value);
}

}  // namespace

std::optional<double> real_number(nb::handle value) {
  const bool plain = nb::isinstance<nb::float_>(value) || PyIndex_Check(value.ptr()) != 0;
  if (!plain && !(nb::hasattr(value, "dtype") && is_of_kind(nb::borrow(value), "f"))) return std::nullopt;
  double number = 0;
  return nb::try_cast(value, number) ? std::optional<double>(number) : std::nullopt;
}

std::optional<bool> numpy_flag(nb::handle value) {
  if (!nb::hasattr(value, "dtype") || !is_of_kind(nb::borrow(value), "b")) return std::nullopt;
  return PyObject_IsTrue(value.ptr()) == 1;
}

bool is_whole_number(nb::handle value) {
  if (nb::isinstance<nb::int_>(value)) return true;
  return PyIndex_Check(value.ptr()) != 0 && nb::hasattr(value, "ndim") &&
         nb::cast<int>(value.attr("ndim")) == 0;
}

std::ptrdiff_t whole_number(const char* name, nb::handle value) {
  std::ptrdiff_t number = 0;
  if (!nb::try_cast(value, number))
    reject(name, nb::cast<std::string>(value.attr("__str__")()) + " does not fit into 64 bits");
  return number;
}

DoublesArgument::DoublesArgument(const char* name, nb::handle x) : array_(viewed_or_copied(name, x)) {
  if (array_.ndim() != 1 && array_.ndim() != 2)
    reject(name, "has " + std::to_string(array_.ndim()) + " axes; it must have two, or be flat");
}

void DoublesArgument::require_shape(const char* name, std::ptrdiff_t wanted_rows,
                                    std::ptrdiff_t wanted_cols) const {
  if (axes() != 2 || rows() != wanted_rows || cols() != wanted_cols)
    reject(name, "is " + std::to_string(rows()) + " x " + std::to_string(cols()) + "; it must be " +
                     std::to_string(wanted_rows) + " x " + std::to_string(wanted_cols));
}

onset::Positions DoublesArgument::positions() const {
  const std::ptrdiff_t count = rows() * cols(), row_stride = array_.stride(0);
  const std::ptrdiff_t col_stride = axes() == 2 ? array_.stride(1) : 1;
  const bool one_line = rows() == 1 || cols() == 1,
             flat = one_line && count % 3 == 0 && !(rows() == 1 && cols() == 3);
  if (!flat) return {array_.data(), rows(), cols(), row_stride, col_stride};
  const std::ptrdiff_t stride = cols() == 1 ? row_stride : col_stride;
  return {array_.data(), count / 3, 3, 3 * stride, stride};
}

std::vector<double> DoublesArgument::list() const {
  std::vector<double> values;
  values.reserve(array_.size());
  for (std::ptrdiff_t r = 0; r < rows(); ++r)
    for (std::ptrdiff_t c = 0; c < cols(); ++c) values.push_back((*this)(r, c));
  return values;
}

onset::Indices indices(const char* name, nb::handle values, int columns) {
  using Rows = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if (values.is_none()) return Rows(0, columns);
  const auto array = integers(name, values, 2);
  if (array.size() == 0)
    return Rows(0, array.ndim() == 2 && array.shape(1) > 0 ? int(array.shape(1)) : columns);
  return Eigen::Map<const Rows>(array.data(), Eigen::Index(array.shape(0)), Eigen::Index(array.shape(1)));
}

std::vector<int> ids(const char* name, nb::handle values) {
  std::vector<int> list;
  if (values.is_none()) return list;
  const auto array = integers(name, values, 1);
  list.reserve(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) list.push_back(narrowed(name, i, array.data()[i]));
  return list;
}

std::vector<std::array<int, 2>> id_pairs(const char* name, nb::handle values) {
  std::vector<std::array<int, 2>> list;
  if (values.is_none()) return list;
  const auto array = integers(name, values, 2);
  if (array.size() == 0) return list;
  if (array.shape(1) != 2) reject(name, "has " + std::to_string(array.shape(1)) + " columns; it must have 2");
  list.reserve(array.shape(0));
  for (std::size_t i = 0; i < array.shape(0); ++i)
    list.push_back({narrowed(name, i, array.data()[2 * i]), narrowed(name, i, array.data()[2 * i + 1])});
  return list;
}

std::vector<double> doubles(const char* name, nb::handle values) {
  if (values.is_none()) return {};
  const DoublesArgument array(name, values);
  if (array.axes() != 1 && array.rows() * array.cols() > 0) reject(name, "has two axes; it must have one");
  return array.list();
}

std::vector<bool> flags(const char* name, nb::handle values) {
  std::vector<bool> list;
  if (values.is_none()) return list;
  const nb::object given = as_array(name, values);
  if (nb::cast<std::size_t>(given.attr("size")) == 0) return list;
  if (!is_of_kind(given, "b")) reject(name, "is an array of " + type_of(given) + "; it must be one of bool");
  if (nb::cast<std::size_t>(given.attr("ndim")) != 1)
    reject(name, "is of shape " + shape_of(given) + "; it must have one axis");
  for (const std::int64_t flag : ids(name, given.attr("astype")("int8"))) list.push_back(flag != 0);
  return list;
}

std::vector<std::uint32_t> bits(const char* name, nb::handle values) {
  std::vector<std::uint32_t> list;
  if (values.is_none()) return list;
  const auto array = integers(name, values, 1);
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::int64_t value = array.data()[i];
    if (value < 0 || value > std::numeric_limits<std::uint32_t>::max())
      reject(name, "row " + std::to_string(i) + ": " + std::to_string(value) + " does not fit into 32 bits");
    list.push_back(std::uint32_t(value));
  }
  return list;
}

std::array<double, 3> vector3(const char* name, nb::handle values) {
  const DoublesArgument array(name, values);
  if (array.rows() * array.cols() != 3) reject(name, "must have three components");
  const std::vector<double> list = array.list();
  return {list[0], list[1], list[2]};
}

}  // namespace onset_python
