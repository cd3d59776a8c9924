// The settings that are compared: each axis of Options around a base.
#pragma once

#include <onset/options.hpp>
#include <string>
#include <vector>

namespace app {

struct Setting {
  std::string axis, value;  // "base", "" for the base itself
  onset::Options options;
  bool same_question = true;  // the separation and norm of the base: its answers can be compared with those
};

// What decides which settings make sense.
struct Grounds {
  double extent = 1;              // model length that separations are a share of
  std::ptrdiff_t primitives = 0;  // 0: single queries, for which broad phase and threads mean nothing
  int cores = 1;
};

// Names of the axes, in the order of the report.
const std::vector<std::string>& axis_names();

// The base first, then every axis in `axes`; values equal to the base's are left out.
std::vector<Setting> settings(const onset::Options& base, const std::vector<std::string>& axes,
                              const Grounds& grounds);

// As in C++, what differs from the defaults: "relative_tolerance = 1e-4, max_checks = 100"; "the defaults".
std::string in_words(const onset::Options& options);

}  // namespace app
