// onset queries: single queries against their known truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/queries/query_kind.hpp"
#include "measure/timing.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/command_line/values.hpp"
#include "onset/exports/query_dump.hpp"
#include "onset/results/progress.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

struct Tally {
  std::int64_t queries = 0, positives = 0, false_negatives = 0, false_positives = 0, budget = 0;
  double total_us = 0, max_us = 0;
  double tolerance = 0;  // the largest that any query was answered at

  double mean_us() const { return queries ? total_us / double(queries) : 0; }
  void add(const onset::QueryResult& result, bool truth, double us) {
    ++queries, total_us += us, max_us = std::max(max_us, us);
    positives += result.collides();
    false_negatives += truth && !result.collides();
    false_positives += !truth && result.collides();
    budget += result.outcome == onset::PairOutcome::max_checks;
    tolerance = std::max(tolerance, result.tolerance);
  }
  void add(const Tally& other) {
    queries += other.queries, positives += other.positives, budget += other.budget;
    false_negatives += other.false_negatives, false_positives += other.false_positives;
    total_us += other.total_us, max_us = std::max(max_us, other.max_us);
    tolerance = std::max(tolerance, other.tolerance);
  }
};

struct FileTally {
  std::string file;
  onset::PairKind kind;
  Tally tally;
};

// Microseconds of one call; the shortest of three where it took long, so that being interrupted does not
// count.
template <class Call>
double timed(Call&& call) {
  double shortest = 0;
  for (int i = 0; i < 3; ++i) {
    const double us = microseconds(call);
    shortest = i == 0 ? us : std::min(shortest, us);
    if (shortest < 500) break;
  }
  return shortest;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

void run_file(FileTally& file, const onset::Options& options, Output* csv, Progress& progress) {
  const std::vector<TruthQuery> queries = read_queries(file.file);
  const std::string name = csv_field(file.file);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    onset::QueryResult result;
    const double us = timed([&] { result = ask(file.kind, queries[i], options); });
    file.tally.add(result, queries[i].collides, us);
    if (csv)
      csv->write(format("%s,%zu,%s,%s,%.17g\n", name.c_str(), i, kind_name(file.kind),
                        outcome_name(result.outcome), result.toi));
    progress.advance();
  }
}

// The kinds of all, and that all can be opened, before the first is run.
std::vector<FileTally> plan(const std::vector<std::string>& files, const std::string& kind) {
  std::vector<FileTally> tallies;
  for (const std::string& file : files) {
    check_input(file);
    tallies.push_back({file, kind_of_file(file, kind), {}});
  }
  return tallies;
}

void add_numbers(Json& json, const Tally& t) {
  json["queries"] = t.queries;
  json["positives"] = t.positives;
  json["false_negatives"] = t.false_negatives;
  json["false_positives"] = t.false_positives;
  json["mean_us"] = t.mean_us();
  json["max_us"] = t.max_us;
  json["budget"] = t.budget;
  json["tolerance"] = t.tolerance;
}

Json to_json(const std::vector<FileTally>& files, const Tally& total) {
  Json json = {{"files", Json::array()}};
  for (const FileTally& f : files) {
    Json row = {{"file", f.file}, {"kind", kind_name(f.kind)}};
    add_numbers(row, f.tally);
    json["files"].push_back(row);
  }
  add_numbers(json["total"], total);
  return json;
}

std::string row(const std::string& name, const char* kind, const Tally& t) {
  return format("%9lld %9lld %9lld %9lld %9.2f %9.1f  %s  %s\n", static_cast<long long>(t.queries),
                static_cast<long long>(t.positives), static_cast<long long>(t.false_negatives),
                static_cast<long long>(t.false_positives), t.mean_us(), t.max_us, kind, name.c_str());
}

std::string describe(const std::vector<FileTally>& files, const Tally& total) {
  std::string text = "  queries positives false neg false pos   mean us    max us      file\n";
  for (const FileTally& f : files) text += row(f.file, kind_name(f.kind), f.tally);
  return text + row("total", "  ", total);
}

struct Inputs : Arguments {
  std::vector<std::string> files;
  std::string kind;
};

void run_queries(const Inputs& inputs) {
  const onset::Options options = to_options(inputs);
  std::vector<FileTally> files = plan(inputs.files, inputs.kind);
  Outputs outputs(inputs, inputs.files);
  Tally total;
  if (outputs.csv()) outputs.csv()->write("file,index,kind,outcome,toi\n");
  {
    Progress progress("queries");
    for (FileTally& file : files) {
      file.tally.tolerance = options.tolerance.value_or(0);
      run_file(file, options, outputs.csv(), progress);
      total.add(file.tally);
    }
  }
  outputs.finish(to_json(files, total), describe(files, total));
}

}  // namespace

void add_queries(CLI::App& app, Run& run) {
  const auto inputs = std::make_shared<Inputs>();
  CLI::App* command =
      app.add_subcommand("queries", "Answer queries with known truth, and count and time the answers");
  command->add_option("FILE", inputs->files, "CSV, eight rows a query: xn,xd,yn,yd,zn,zd,truth")
      ->required()
      ->check(path_fault);
  add_kind(*command, inputs->kind, ": vertex-face, vf or edge-edge, ee");
  add_common_options(*command, *inputs, "file,index,kind,outcome,toi");
  command->footer(
      "One query is asked after another, for the times are those of single queries: --threads and "
      "--broad-phase change "
      "nothing.\nA relative tolerance is relative to each query's own extent.");
  command->callback([&run, inputs] { run = [inputs] { run_queries(*inputs); }; });
}

}  // namespace app
