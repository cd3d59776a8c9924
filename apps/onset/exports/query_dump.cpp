#include "onset/exports/query_dump.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "files/error.hpp"
#include "files/queries/query_kind.hpp"
#include "files/queries/rational.hpp"
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
          {"touching_may_pass_through", o.touching_may_pass_through},
          {"narrow_phase", o.narrow_phase == onset::NarrowPhaseMethod::inclusion ? "inclusion" : "auto"}};
}

onset::Options to_options(const Json& json) {
  onset::Options o;
  o.tolerance = json.at("tolerance").get<double>();
  o.min_separation = json.at("min_separation").get<double>();
  o.norm = json.at("norm") == "maximum" ? onset::Norm::maximum : onset::Norm::euclidean;
  o.max_checks = json.at("max_checks").get<std::int64_t>();
  o.touching_may_pass_through = json.value("touching_may_pass_through", false);
  if (json.at("narrow_phase") == "inclusion") o.narrow_phase = onset::NarrowPhaseMethod::inclusion;
  return o;
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
  onset::Options options = given;
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
  try {
    std::ifstream in(name);
    const Json json = Json::parse(in);
    Expectation e;
    e.options = to_options(json.at("options"));
    for (const Json& q : json.at("queries")) {
      const Json& toi = q.at("toi");  // JSON has no infinity: null
      e.answers.push_back({q.at("outcome").get<std::string>(), toi.is_null() ? INFINITY : toi.get<double>(),
                           q.at("checks").get<std::int64_t>()});
    }
    return e;
  } catch (const Json::exception& error) {
    throw InputError(name + ": " + error.what());
  }
}

}  // namespace app
