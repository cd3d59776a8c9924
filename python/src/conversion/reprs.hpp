// Results in words, for repr().
#pragma once

#include <nanobind/nanobind.h>

#include <onset/result.hpp>
#include <optional>
#include <string>

namespace onset_python {

// As Python writes a float.
inline std::string text_of(double x) { return nanobind::repr(nanobind::float_(x)).c_str(); }
inline std::string text_of(const onset::Pair& p) {
  return "Pair(" + std::string(onset::to_string(p.kind)) + ", a=" + std::to_string(p.a) +
         ", b=" + std::to_string(p.b) + ")";
}
inline std::string text_of(const std::optional<onset::Pair>& p) { return p ? text_of(*p) : "None"; }

}  // namespace onset_python
