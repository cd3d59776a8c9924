#include "onset/exports/query_dump.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/queries/query_kind.hpp"
#include "files/queries/rational.hpp"
#include "files/text_lines.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

std::string without_ending(const std::string& path, const std::string& ending) {
  const std::size_t size = path.size() - std::min(path.size(), ending.size());
  return path.substr(size) == ending ? path.substr(0, size) : path;
}

constexpr onset::PairKind kKinds[] = {onset::PairKind::vertex_face, onset::PairKind::edge_edge};

std::string file_of(const std::string& path, onset::PairKind kind) {
  return without_ending(path, ".csv") + "-" + kind_name(kind);
}

Json to_json(const onset::Options& o) {
  return {{"tolerance", *o.tolerance},
          {"min_separation", o.min_separation},
          {"norm", norm_name(o.norm)},
          {"max_checks", o.max_checks},
          {"certainty", exactness_name(o.exactness)},
          {"touching_may_pass_through", o.touching_may_pass_through},
          {"narrow_phase", o.narrow_phase == onset::NarrowPhaseMethod::inclusion ? "inclusion" : "auto"}};
}

std::int64_t whole(const Json& json) {
  if (!json.is_number_integer() || (json.is_number_unsigned() && json.get<std::uint64_t>() > INT64_MAX))
    throw InputError(json.dump() + ", a whole number expected");
  return json.get<std::int64_t>();
}

// The one of `values` whose name it is.
template <class Value, class Name>
Value named(const Json& json, std::initializer_list<Value> values, Name&& name) {
  for (const Value value : values)
    if (json == name(value)) return value;
  throw InputError(json.dump() + " is no name of an option");
}

onset::Options to_options(const Json& json) {
  using onset::Exactness, onset::NarrowPhaseMethod, onset::Norm;
  onset::Options o;
  o.tolerance = json.at("tolerance").get<double>();
  o.min_separation = json.at("min_separation").get<double>();
  o.norm = named(json.at("norm"), {Norm::euclidean, Norm::maximum}, norm_name);
  o.max_checks = whole(json.at("max_checks"));
  if (json.contains("certainty"))  // older dumps do not say
    o.exactness = named(json.at("certainty"), {Exactness::conservative, Exactness::certify, Exactness::exact},
                        exactness_name);
  o.touching_may_pass_through = json.value("touching_may_pass_through", false);
  o.narrow_phase =
      named(json.at("narrow_phase"), {NarrowPhaseMethod::automatic, NarrowPhaseMethod::inclusion},
            [](NarrowPhaseMethod m) { return m == NarrowPhaseMethod::inclusion ? "inclusion" : "auto"; });
  return o;
}

// Each query is asked alone, without what a call of many is cut off by.
onset::Options without_budgets(onset::Options o) {
  const onset::Options none;
  o.time_limit = none.time_limit, o.check_limit = none.check_limit, o.memory_limit = none.memory_limit;
  return o;
}

// A dump is a list in an object; more levels are none of ours, and would cost memory before they are refused.
Json parse(const std::string& text) {
  constexpr int kLevels = 8;
  return Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
    if (depth > kLevels) throw InputError("too many levels");
    return true;
  });
}

void write_query(Output& csv, const TruthQuery& query) {
  for (const auto* end : {&query.t0, &query.t1})
    for (const onset::Point& p : *end) {
      for (const double x : p) csv.write(exact_rational(x) + ",");
      csv.write(query.collides ? "1\n" : "0\n");
    }
}

}  // namespace

std::vector<std::string> dump_files(const std::string& path) {
  std::vector<std::string> files;
  for (const onset::PairKind kind : kKinds)
    for (const char* ending : {".csv", ".json"}) files.push_back(file_of(path, kind) + ending);
  return files;
}

void write_dump(const std::string& path, const std::vector<DumpedPair>& pairs, const Points& x_t0,
                const Points& x_t1, const onset::Options& given, double tolerance, Outputs& outputs) {
  onset::Options options = without_budgets(given);
  options.tolerance = tolerance;
  for (const onset::PairKind kind : kKinds) {
    const std::string name = file_of(path, kind);
    Json queries = Json::array();
    for (const DumpedPair& dumped : pairs) {
      if (dumped.pair.kind != kind) continue;
      TruthQuery query;
      for (std::size_t i = 0; i < 4; ++i) {
        query.t0[i] = point(x_t0, dumped.pair.vertices[i]);
        query.t1[i] = point(x_t1, dumped.pair.vertices[i]);
      }
      const onset::QueryResult r = ask(kind, query, options);
      query.collides = r.collides();
      write_query(outputs.file(name + ".csv"), query);
      queries.push_back({{"a", dumped.pair.a},
                         {"b", dumped.pair.b},
                         {"why", dumped.why},
                         {"outcome", outcome_name(r.outcome)},
                         {"toi", r.toi},
                         {"checks", r.checks}});
    }
    if (queries.empty()) continue;
    outputs.file(name + ".json")
        .write(Json({{"options", to_json(options)}, {"queries", queries}}).dump(2) + "\n");
  }
}

std::string expectation_file(const std::string& path) { return without_ending(path, ".csv") + ".json"; }

std::optional<Expectation> read_expectation(const std::string& path) {
  const std::string name = expectation_file(path);
  if (!std::filesystem::exists(name)) return std::nullopt;
  const std::string text = read_text(name);
  try {
    const Json json = parse(text);
    Expectation e;
    e.options = to_options(json.at("options"));
    for (const Json& q : json.at("queries")) {
      const Json& toi = q.at("toi");  // JSON has no infinity: null
      e.answers.push_back({q.at("outcome").get<std::string>(), toi.is_null() ? INFINITY : toi.get<double>(),
                           whole(q.at("checks"))});
    }
    return e;
  } catch (const std::exception& error) {
    throw InputError(name + ": " + shown(error.what()));
  }
}

}  // namespace app
