#include "onset/command_line/values.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>

#include "files/text_lines.hpp"

namespace app {
namespace {

bool is_whole(const std::string& text, std::int64_t lowest, std::int64_t highest) {
  const std::optional<std::int64_t> value = app::parse_whole(text);
  return value && *value >= lowest && *value <= highest;
}

std::string expected(std::int64_t lowest, std::int64_t highest, const std::string& text) {
  return "a whole number in [" + std::to_string(lowest) + ", " + std::to_string(highest) +
         "] expected, not '" + text + "'";
}

}  // namespace

// Hexadecimal too, as C writes doubles exactly.
double parse_real(const std::string& option, const std::string& text, Zero zero) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool number = !text.empty() && end == text.c_str() + text.size();
  if (number && std::isfinite(value) && (value > 0 || (value == 0 && zero == Zero::allowed))) return value;
  const char* range = zero == Zero::allowed ? ">= 0" : "> 0";
  throw CLI::ValidationError(option,
                             std::string("a finite number ") + range + " expected, not '" + text + "'");
}

std::int64_t parse_whole(const std::string& option, const std::string& text, std::int64_t lowest,
                         std::int64_t highest) {
  if (!is_whole(text, lowest, highest)) throw CLI::ValidationError(option, expected(lowest, highest, text));
  return *app::parse_whole(text);
}

std::string path_fault(const std::string& text) { return text.empty() ? "a path expected, not ''" : ""; }

CLI::Validator whole_numbers(std::int64_t lowest, std::int64_t highest) {
  return {[=](const std::string& text) {
            return is_whole(text, lowest, highest) ? std::string() : expected(lowest, highest, text);
          },
          ""};
}

}  // namespace app
