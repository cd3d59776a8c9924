// Pairs as structured arrays of numpy: the library's own memory, with named fields.
#pragma once

#include <nanobind/nanobind.h>

#include <onset/close_pairs.hpp>
#include <onset/result.hpp>
#include <vector>

#include "conversion/arrays.hpp"

namespace onset_python {

namespace nb = nanobind;

// The structured types of numpy that lie in memory as the library's own do.
nb::object dtype_of(const onset::Pair&);
nb::object dtype_of(const onset::Contact&);
nb::object dtype_of(const onset::ClosePair&);
nb::object dtype_of(const onset::Intersection&);

// A read-only array of what `owner` holds, without a copy.
template <class T>
nb::object records_of(const std::vector<T>& list, nb::handle owner) {
  const nb::object bytes =
      array_of(reinterpret_cast<const std::uint8_t*>(list.data()), {list.size() * sizeof(T)}, owner);
  return bytes.attr("view")(dtype_of(T{}));
}

// An array of its own.
template <class T>
nb::object owned_records(const std::vector<T>& list) {
  auto* kept = new std::vector<T>(list);
  return records_of(*kept,
                    nb::capsule(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); }));
}

// Pairs out of a structured array that has fields kind, a and b, or a list of Pair; intersections likewise
// (edge, face).
std::vector<onset::Pair> pairs_of(const char* name, nb::handle values);
std::vector<onset::Intersection> intersections_of(const char* name, nb::handle values);

}  // namespace onset_python
