#include "onset/command_line/arguments.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>

namespace app {
namespace {

enum class Zero { allowed, refused };

double parse_real(const std::string& name, const std::string& text, Zero zero) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool number = !text.empty() && end == text.c_str() + text.size();
  if (number && std::isfinite(value) && (value > 0 || (value == 0 && zero == Zero::allowed))) return value;
  const char* range = zero == Zero::allowed ? ">= 0" : "> 0";
  throw CLI::ValidationError(name, std::string("a finite number ") + range + " expected, not '" + text + "'");
}

std::int64_t parse_whole(const std::string& name, const std::string& text, std::int64_t lowest,
                         std::int64_t highest) {
  std::int64_t value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool number = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
  if (number && value >= lowest && value <= highest) return value;
  throw CLI::ValidationError(name, "a whole number in [" + std::to_string(lowest) + ", " +
                                       std::to_string(highest) + "] expected, not '" + text + "'");
}

// One option whose text is parsed by `take`.
CLI::Option* add(CLI::App& command, const std::string& name, const std::string& type, const std::string& help,
                 std::function<void(const std::string&)> take) {
  return command.add_option_function<std::string>(name, std::move(take), help)->type_name(type);
}

void add_choice(CLI::App& command, const std::string& name, std::string& value,
                const std::vector<std::string>& choices, const std::string& help) {
  command.add_option(name, value, help)
      ->check(CLI::IsMember(choices))
      ->type_name("NAME")
      ->capture_default_str();
}

void add_accuracy(CLI::App& command, onset::Options& o) {
  CLI::Option* tolerance =
      add(command, "--tolerance", "LENGTH",
          "Report a pair once it is closer than the separation plus LENGTH (model length, > 0)",
          [&o](const std::string& s) { o.tolerance = parse_real("--tolerance", s, Zero::refused); });
  CLI::Option* relative = add(command, "--relative-tolerance", "FACTOR",
                              "The same as FACTOR times the scene's R, the largest corner difference that an "
                              "overlapping pair can have "
                              "[1e-6]",
                              [&o](const std::string& s) {
                                o.relative_tolerance = parse_real("--relative-tolerance", s, Zero::refused);
                              });
  tolerance->excludes(relative);
  add(command, "--max-checks", "COUNT",
      "Checks that one pair may cost, >= 1; then its time so far counts [10000]",
      [&o](const std::string& s) { o.max_checks = parse_whole("--max-checks", s, 1, INT64_MAX); });
  command.add_flag(
      "--touching-may-pass-through", o.touching_may_pass_through,
      "What touches at the start may leave in any direction, as if that were the side it came from");
  add(command, "--min-separation", "LENGTH",
      "Pairs must stay farther apart than this (model length, >= 0) [0]",
      [&o](const std::string& s) { o.min_separation = parse_real("--min-separation", s, Zero::allowed); });
}

void add_budgets(CLI::App& command, onset::Options& o) {
  add(command, "--time-limit", "SECONDS", "Then the answer is what is certain by then [none]",
      [&o](const std::string& s) { o.time_limit = parse_real("--time-limit", s, Zero::allowed); });
  add(command, "--check-limit", "COUNT", "The same for the checks of all pairs together [none]",
      [&o](const std::string& s) { o.check_limit = parse_whole("--check-limit", s, 0, INT64_MAX); });
  add(command, "--memory-limit", "BYTES", "The same for what is kept of each pair [none]",
      [&o](const std::string& s) { o.memory_limit = parse_whole("--memory-limit", s, 0, INT64_MAX); });
}

}  // namespace

void add_window(CLI::App& command, Arguments& a) {
  add(command, "--window", "TIME", "Only contacts with toi <= earliest toi + TIME [all]",
      [&a](const std::string& s) { a.options.window = parse_real("--window", s, Zero::allowed); });
}

void add_kind(CLI::App& command, std::string& kind, const std::string& how) {
  command.add_option("--kind", kind, "Kind of all queries; otherwise each path tells" + how)
      ->check(CLI::IsMember({"vf", "ee"}))
      ->type_name("NAME");
}

void add_common_options(CLI::App& command, Arguments& a, const std::string& csv_columns) {
  add_accuracy(command, a.options);
  add_budgets(command, a.options);
  add_choice(command, "--norm", a.norm, {"euclidean", "maximum"}, "Norm of the minimum separation");
  add(command, "--threads", "COUNT", "At most COUNT threads; 0: all cores. The result is the same [0]",
      [&a](const std::string& s) { a.options.threads = int(parse_whole("--threads", s, 0, 4096)); });
  add_choice(command, "--broad-phase", a.broad_phase, {"auto", "bvh", "hash", "brute"},
             "How pairs are found");
  add_choice(command, "--narrow-phase", a.narrow_phase, {"auto", "inclusion"},
             "How pairs are decided; inclusion: by the paper's root finder alone");
  add_choice(command, "--kernel", a.kernel, {"auto", "scalar", "avx2"},
             "Instruction set. The result is the same");
  add_choice(command, "--certainty", a.certainty, {"conservative", "certify", "exact"},
             "How far to tell real contacts from those within the tolerance; exact: until it is known");
  command.add_option("--json", a.json, "Write the result as JSON to FILE, or to stdout for -")
      ->type_name("FILE");
  command.add_option("--csv", a.csv, "Write CSV to FILE, or to stdout for -: " + csv_columns)
      ->type_name("FILE");
}

onset::Options to_options(const Arguments& a) {
  static const std::map<std::string, onset::BroadPhaseMethod> broad = {
      {"auto", onset::BroadPhaseMethod::automatic},
      {"bvh", onset::BroadPhaseMethod::bvh},
      {"hash", onset::BroadPhaseMethod::hash},
      {"brute", onset::BroadPhaseMethod::brute}};
  static const std::map<std::string, onset::InstructionSet> kernels = {
      {"auto", onset::InstructionSet::automatic},
      {"scalar", onset::InstructionSet::scalar},
      {"avx2", onset::InstructionSet::avx2}};
  static const std::map<std::string, onset::Exactness> levels = {
      {"conservative", onset::Exactness::conservative},
      {"certify", onset::Exactness::certify},
      {"exact", onset::Exactness::exact}};
  onset::Options o = a.options;
  o.norm = a.norm == "maximum" ? onset::Norm::maximum : onset::Norm::euclidean;
  o.broad_phase = broad.at(a.broad_phase);
  o.narrow_phase = a.narrow_phase == "inclusion" ? onset::NarrowPhaseMethod::inclusion
                                                 : onset::NarrowPhaseMethod::automatic;
  o.instruction_set = kernels.at(a.kernel);
  o.exactness = levels.at(a.certainty);
  return o;
}

}  // namespace app
