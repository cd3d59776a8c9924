// onset replay: the queries of a dump once more.
#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "files/error.hpp"
#include "files/queries/query_kind.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/exports/query_dump.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

struct Replayed {
  std::string file;
  onset::PairKind kind;
  std::size_t index;
  onset::QueryResult result;
  std::string verdict;  // "same", "differs: ...", or "" where the dump expects nothing
};

std::string compare(const onset::QueryResult& r, const Expectation::Answer& e) {
  if (e.outcome != outcome_name(r.outcome)) return "differs: outcome was " + e.outcome;
  if (e.toi != r.toi) return format("differs: toi was %.17g", e.toi);
  if (e.checks != r.checks) return format("differs: took %lld checks", static_cast<long long>(e.checks));
  return "same";
}

// Options out of a file may be out of range.
onset::QueryResult answer(const std::string& file, onset::PairKind kind, const TruthQuery& query,
                          const onset::Options& options, bool has_expectation) {
  try {
    return ask(kind, query, options);
  } catch (const std::invalid_argument& e) {
    if (has_expectation) throw InputError(expectation_file(file) + ": " + e.what());
    throw;
  }
}

void replay(const std::string& file, const std::string& kind_name, const onset::Options& given,
            std::vector<Replayed>& rows) {
  const std::vector<TruthQuery> queries = read_queries(file);
  const std::optional<Expectation> expected = read_expectation(file);
  if (expected && expected->answers.size() != queries.size())
    throw InputError(file + ": " + std::to_string(queries.size()) + " queries, answers beside it to " +
                     std::to_string(expected->answers.size()));
  const onset::PairKind kind = kind_of_file(file, kind_name);
  onset::Options options = expected ? expected->options : given;
  options.instruction_set = given.instruction_set;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const onset::QueryResult r = answer(file, kind, queries[i], options, expected.has_value());
    rows.push_back({file, kind, i, r, expected ? compare(r, expected->answers[i]) : ""});
  }
}

Json to_json(const std::vector<Replayed>& rows, std::size_t differing) {
  Json json = {{"queries", Json::array()}, {"differing", differing}};
  for (const Replayed& r : rows)
    json["queries"].push_back({{"file", r.file},
                               {"index", r.index},
                               {"kind", kind_name(r.kind)},
                               {"outcome", outcome_name(r.result.outcome)},
                               {"toi", r.result.toi},
                               {"checks", r.result.checks},
                               {"verdict", r.verdict.empty() ? Json() : Json(r.verdict)}});
  return json;
}

std::string describe(const std::vector<Replayed>& rows, std::size_t differing) {
  std::string text = "kind outcome            toi                      checks  verdict\n";
  for (const Replayed& r : rows)
    text += format("%-4s %-18s %-23.17g %7lld  %s  %s %zu\n", kind_name(r.kind),
                   outcome_name(r.result.outcome), r.result.toi, static_cast<long long>(r.result.checks),
                   r.verdict.empty() ? "-" : r.verdict.c_str(), r.file.c_str(), r.index);
  return text + format("%zu queries, %zu differ from their dump\n", rows.size(), differing);
}

struct Inputs : Arguments {
  std::vector<std::string> files;
  std::string kind;
};

void run_replay(const Inputs& inputs) {
  const onset::Options options = to_options(inputs);
  std::vector<std::string> read = inputs.files;
  for (const std::string& file : inputs.files) read.push_back(expectation_file(file));
  Outputs outputs(inputs, read);
  std::vector<Replayed> rows;
  {
    const Progress progress("replay");
    for (const std::string& file : inputs.files) replay(file, inputs.kind, options, rows);
  }
  std::size_t differing = 0;
  for (const Replayed& r : rows) differing += !r.verdict.empty() && r.verdict != "same";
  if (outputs.csv()) {
    outputs.csv()->write("index,kind,outcome,toi,checks,verdict\n");
    for (const Replayed& r : rows)
      outputs.csv()->write(format("%zu,%s,%s,%.17g,%lld,%s\n", r.index, kind_name(r.kind),
                                  outcome_name(r.result.outcome), r.result.toi,
                                  static_cast<long long>(r.result.checks), r.verdict.c_str()));
  }
  outputs.finish(to_json(rows, differing), describe(rows, differing));
}

}  // namespace

void add_replay(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command =
      app.add_subcommand("replay", "Ask the queries of a dump again, and compare with its answers");
  command
      ->add_option("FILE", inputs->files, "NAME-vf.csv or NAME-ee.csv, from step or active-set --dump NAME")
      ->required()
      ->check(path_fault);
  add_kind(*command, inputs->kind, ": vf or ee");
  add_common_options(*command, *inputs, "index,kind,outcome,toi,checks,verdict");
  command->footer(
      "Where NAME-vf.json lies beside its CSV, the queries are asked with the options in it (the kernel is "
      "the one asked "
      "for).\nThe same version gives the same bits: outcome, toi, checks.");
  command->callback([&run, inputs] { run = [inputs] { run_replay(*inputs); }; });
}

}  // namespace app
