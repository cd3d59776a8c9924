// The values of options, as text: numbers in their range and nothing behind them, paths that are not empty.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace app {

enum class Zero { allowed, refused };

// Each throws CLI::ValidationError naming the option, the range and the text.
double parse_real(const std::string& option, const std::string& text, Zero zero);
std::int64_t parse_whole(const std::string& option, const std::string& text, std::int64_t lowest,
                         std::int64_t highest);

// Adds an option that takes such a value.
template <class Number>
CLI::Option* add_real(CLI::App& command, const std::string& name, Number& value, const std::string& type,
                      const std::string& help, Zero zero) {
  const auto take = [name, zero, &value](const std::string& text) { value = parse_real(name, text, zero); };
  return command.add_option_function<std::string>(name, take, help)->type_name(type);
}
template <class Number>
CLI::Option* add_whole(CLI::App& command, const std::string& name, Number& value, const std::string& type,
                       const std::string& help, std::int64_t lowest, std::int64_t highest) {
  const auto take = [=, &value](const std::string& text) {
    value = Number(parse_whole(name, text, lowest, highest));
  };
  return command.add_option_function<std::string>(name, take, help)->type_name(type);
}

// Checks for CLI::Option::check: of a path, and of each number of a list.
std::string path_fault(const std::string& text);
CLI::Validator whole_numbers(std::int64_t lowest, std::int64_t highest);

}  // namespace app
