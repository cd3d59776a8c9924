#include "onset/command_line/arguments.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>

#include "onset/command_line/values.hpp"

namespace app {
namespace {

void add_choice(CLI::App& command, const std::string& name, std::string& value,
                const std::vector<std::string>& choices, const std::string& help) {
  command.add_option(name, value, help)
      ->check(CLI::IsMember(choices))
      ->type_name("NAME")
      ->capture_default_str();
}

void add_accuracy(CLI::App& command, onset::Options& o) {
  CLI::Option* tolerance = add_real(
      command, "--tolerance", o.tolerance, "LENGTH",
      "Report a pair once it is closer than the separation plus LENGTH (model length, > 0)", Zero::refused);
  CLI::Option* relative = add_real(command, "--relative-tolerance", o.relative_tolerance, "FACTOR",
                                   "The same as FACTOR times the scene's R, the largest corner difference "
                                   "that an overlapping pair can have [1e-6]",
                                   Zero::refused);
  tolerance->excludes(relative);
  add_whole(command, "--max-checks", o.max_checks, "COUNT",
            "Checks that one pair may cost, >= 1; then its time so far counts [10000]", 1, INT64_MAX);
  command.add_flag(
      "--touching-may-pass-through", o.touching_may_pass_through,
      "What touches at the start may leave in any direction, as if that were the side it came from");
  add_real(command, "--min-separation", o.min_separation, "LENGTH",
           "Pairs must stay farther apart than this (model length, >= 0) [0]", Zero::allowed);
}

void add_budgets(CLI::App& command, onset::Options& o) {
  add_real(command, "--time-limit", o.time_limit, "SECONDS",
           "Then the answer is what is certain by then [none]", Zero::allowed);
  add_whole(command, "--check-limit", o.check_limit, "COUNT",
            "The same for the checks of all pairs together [none]", 0, INT64_MAX);
  add_whole(command, "--memory-limit", o.memory_limit, "BYTES",
            "The same for what is kept of each pair [none]", 0, INT64_MAX);
}

}  // namespace

void add_window(CLI::App& command, Arguments& a) {
  add_real(command, "--window", a.options.window, "TIME",
           "Only contacts with toi <= earliest toi + TIME [all]", Zero::allowed);
}

void add_json(CLI::App& command, Arguments& a) {
  command.add_option("--json", a.json, "Write the result as JSON to FILE, or to stdout for -")
      ->check(path_fault)
      ->type_name("FILE");
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
  add_whole(command, "--threads", a.options.threads, "COUNT",
            "At most COUNT threads; 0: all cores. The result is the same [0]", 0, 4096);
  add_choice(command, "--broad-phase", a.broad_phase, {"auto", "bvh", "hash", "brute"},
             "How pairs are found");
  add_choice(command, "--narrow-phase", a.narrow_phase, {"auto", "inclusion"},
             "How pairs are decided; inclusion: by the paper's root finder alone");
  add_choice(command, "--kernel", a.kernel, {"auto", "scalar", "avx2", "avx512"},
             "Instruction set. The result is the same");
  add_choice(command, "--certainty", a.certainty, {"conservative", "certify", "exact"},
             "How far to tell real contacts from those within the tolerance; exact: until it is known");
  add_json(command, a);
  command.add_option("--csv", a.csv, "Write CSV to FILE, or to stdout for -: " + csv_columns)
      ->check(path_fault)
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
      {"avx2", onset::InstructionSet::avx2},
      {"avx512", onset::InstructionSet::avx512}};
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
