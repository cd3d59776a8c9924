// The options that the simulators share, and what the others must be, in words.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "files/text_lines.hpp"
#include "simulation/filter.hpp"

namespace simulation {

// CLI11's own checks let NaN pass, and take an empty word for 0.
inline CLI::Validator number(double least, bool is_whole, const std::string& words, double below = INFINITY) {
  return {[=](const std::string& text) {
            const std::optional<double> value = app::parse_double(text);
            const bool fits = value && std::isfinite(*value) && *value >= least && *value < below;
            if (fits && (!is_whole || app::parse_whole(text))) return std::string();
            return words + " expected, not '" + text + "'";
          },
          ""};
}
inline CLI::Validator count() { return number(0, true, "a whole number >= 0"); }
inline CLI::Validator positive() {
  return number(std::numeric_limits<double>::min(), false, "a finite number > 0");
}
inline CLI::Validator not_negative() { return number(0, false, "a finite number >= 0"); }
inline CLI::Validator share() { return number(0, false, "a number in [0, 1)", 1); }

// How long a run goes, and what it leaves.
struct RunOptions {
  std::string out, json, restart;
  int steps = 100;
  bool check = false;
};

void add_run_options(CLI::App& app, RunOptions& run);
void add_filter_options(CLI::App& app, FilterSettings& filter);

}  // namespace simulation
