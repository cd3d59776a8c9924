// The library and the root finders of other codes, asked the same queries with truth.
//
//   onset_baselines [--every N] [--boxes N] [--separation D | --tolerance D] FILE...
//
// --tolerance: only the finders that have one, at this: the width of the boxes that a root finder accepts,
// the tolerance of the library. FILE: eight rows a query, the path tells the kind; exact times from toi.csv
// beside it, if there. Of each file every N-th query. Prints JSON: the machine, and for each file what each
// finder answered and the microseconds it took, the better of two runs for each query, CPU time where it took
// long.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/root_finders/finder.hpp"
#include "files/error.hpp"
#include "files/queries/query_kind.hpp"
#include "files/queries/truth_file.hpp"
#include "files/text_lines.hpp"
#include "measure/system.hpp"
#include "measure/timing.hpp"

namespace {

using Json = nlohmann::ordered_json;
using Finder = std::function<app::FinderAnswer(onset::PairKind, const app::TruthQuery&)>;

struct NamedFinder {
  std::string name;
  Finder find;
};

struct Settings {
  std::size_t every = 1;
  double separation = 0;
  std::optional<double> tolerance;  // limits.width is the same
  app::FinderLimits limits;
};

Finder onset_with(const onset::Options& options) {
  return [options](onset::PairKind kind, const app::TruthQuery& query) {
    const onset::QueryResult r = app::ask(kind, query, options);
    return app::FinderAnswer{r.collides(), r.toi, r.outcome == onset::PairOutcome::max_checks};
  };
}

std::vector<NamedFinder> library(const Settings& s) {
  onset::Options options, inclusion;
  options.min_separation = inclusion.min_separation = s.separation;
  options.tolerance = s.tolerance;
  inclusion.narrow_phase = onset::NarrowPhaseMethod::inclusion;
  inclusion.tolerance = s.limits.width, inclusion.max_checks = s.limits.boxes;
  std::vector<NamedFinder> all{{"onset", onset_with(options)}};
  if (!s.tolerance) {
    onset::Options fine = options, exact = options;
    fine.relative_tolerance = 1e-12;
    exact.exactness = onset::Exactness::exact;
    all.push_back({"onset, 1e-12", onset_with(fine)});
    all.push_back({"onset, exact", onset_with(exact)});
  }
  all.push_back({"onset, inclusion alone", onset_with(inclusion)});
  return all;
}

std::vector<NamedFinder> finders(const Settings& s) {
  std::vector<NamedFinder> all = library(s);
  if (s.separation > 0) return all;  // the others know no separation
  const auto limits = s.limits;
  all.push_back({"IRF", [limits](auto kind, auto& q) { return interval_multivariate(kind, q, limits); }});
  all.push_back({"UIRF", [limits](auto kind, auto& q) { return interval_univariate(kind, q, limits); }});
  if (!s.tolerance)
    all.push_back({"cubic", [](auto kind, auto& q) { return app::floating_point_cubic(kind, q); }});
  return all;
}

// Counts of one finder on one file.
struct Tally {
  std::int64_t queries = 0, positives = 0, false_positives = 0, false_negatives = 0, late = 0, zero = 0,
               cut = 0;
  double total_us = 0, slowest_us = 0, early = 0, latest = 0;

  void add(const app::FinderAnswer& answer, bool truth, const app::ExactToi& exact, double us) {
    ++queries, positives += answer.collides, cut += answer.cut;
    false_positives += answer.collides && !truth, false_negatives += truth && !answer.collides;
    total_us += us, slowest_us = std::max(slowest_us, us);
    if (!truth || !answer.collides || !exact.known()) return;
    late += answer.toi > exact.hi, zero += answer.toi == 0 && exact.lo > 0;
    early += std::max(0.0, exact.lo - answer.toi), latest = std::max(latest, answer.toi - exact.hi);
  }
  Json json(const std::string& name) const {
    return {{"name", name},
            {"queries", queries},
            {"positives", positives},
            {"false_positives", false_positives},
            {"false_negatives", false_negatives},
            {"late", late},
            {"latest", latest},
            {"zero", zero},
            {"cut", cut},
            {"total_us", total_us},
            {"slowest_us", slowest_us},
            {"early_sum", early}};
  }
};

// The better of two; CPU time where it is so long that it may have been interrupted.
template <class Call>
double time_of(Call&& call) {
  constexpr double kLong = 200;
  const double first = app::microseconds(call);
  const app::Stopwatch watch;
  const double second = app::microseconds(call), cpu = 1e6 * watch.elapsed().cpu;
  return std::min({first, second, std::max(first, second) > kLong ? cpu : second});
}

Json measure(const NamedFinder& finder, onset::PairKind kind, const std::vector<app::TruthQuery>& queries,
             const std::vector<app::ExactToi>& times, std::size_t every) {
  Tally tally;
  for (std::size_t i = 0; i < queries.size(); i += every) {
    app::FinderAnswer answer;
    const double us = time_of([&] { answer = finder.find(kind, queries[i]); });
    tally.add(answer, queries[i].collides, times.empty() ? app::ExactToi() : times[i], us);
  }
  return tally.json(finder.name);
}

Json measure_file(const std::string& path, const Settings& settings) {
  const onset::PairKind kind = app::kind_from_path(path);
  const std::vector<app::TruthQuery> queries = app::read_queries(path);
  std::vector<bool> collides;
  for (const app::TruthQuery& q : queries) collides.push_back(q.collides);
  const std::vector<app::ExactToi> times = app::read_query_toi(path, collides);
  Json row = {{"file", path}, {"kind", app::kind_name(kind)}};
  for (const NamedFinder& finder : finders(settings))
    row["finders"].push_back(measure(finder, kind, queries, times, settings.every));
  return row;
}

std::size_t count(const char* option, const char* text) {
  const std::optional<std::int64_t> value = app::parse_whole(text);
  if (!value || *value < 1 || *value > INT32_MAX)
    throw app::UsageError(std::string(option) + ": a whole number of 1 or more, not " + text);
  return std::size_t(*value);
}

double length(const char* option, const char* text) {
  const std::optional<double> value = app::parse_double(text);
  if (!value || !std::isfinite(*value) || *value < 0)
    throw app::UsageError(std::string(option) + ": a length, not " + text);
  return *value;
}

}  // namespace

int main(int argc, char** argv) try {
  Settings settings;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const auto value = [&] {
      if (i + 1 == argc) throw app::UsageError(std::string(argv[i]) + ": a value is missing");
      return argv[++i];
    };
    if (!std::strcmp(argv[i], "--every"))
      settings.every = count("--every", value());
    else if (!std::strcmp(argv[i], "--boxes"))
      settings.limits.boxes = int(count("--boxes", value()));
    else if (!std::strcmp(argv[i], "--separation"))
      settings.separation = length("--separation", value());
    else if (!std::strcmp(argv[i], "--tolerance"))
      settings.tolerance = settings.limits.width = length("--tolerance", value());
    else
      files.push_back(argv[i]);
  }
  if (!(settings.limits.width > 0)) throw app::UsageError("--tolerance: a positive length");
  Json report = {{"machine", app::machine()},         {"every", settings.every},
                 {"boxes", settings.limits.boxes},    {"width", settings.limits.width},
                 {"separation", settings.separation}, {"files", Json::array()}};
  for (const std::string& file : files) report["files"].push_back(measure_file(file, settings));
  std::printf("%s\n", report.dump(1).c_str());
} catch (const std::exception& e) {
  std::fprintf(stderr, "onset_baselines: %s\n", e.what());
  return 1;
}
