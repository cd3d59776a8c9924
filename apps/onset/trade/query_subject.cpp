#include <algorithm>
#include <cmath>

#include "files/output.hpp"
#include "files/queries/query_file.hpp"
#include "files/queries/query_kind.hpp"
#include "files/queries/truth_file.hpp"
#include "measure/system.hpp"
#include "onset/trade/subject.hpp"

namespace app {
namespace {

struct Asked {
  onset::PairKind kind;
  TruthQuery query;
  ExactToi toi;  // exact, or that of the reference on both sides
};

double extent(const TruthQuery& query) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double least = query.t0[0][std::size_t(axis)], most = least;
    for (const auto* points : {&query.t0, &query.t1})
      for (const onset::Point& p : *points)
        least = std::min(least, p[std::size_t(axis)]), most = std::max(most, p[std::size_t(axis)]);
    largest = std::max(largest, most - least);
  }
  return largest;
}

class QuerySubject : public Subject {
 public:
  QuerySubject(const std::vector<std::string>& files, const std::string& kind, const onset::Options& base) {
    for (const std::string& file : files) read(file, kind);
    exact_times_ = std::all_of(queries_.begin(), queries_.end(),
                               [](const Asked& q) { return !q.query.collides || q.toi.known(); });
    reference_options_ = finest(base);
    if (!exact_times_)
      for (Asked& q : queries_) q.toi.lo = q.toi.hi = ask(q.kind, q.query, reference_options_).toi;
    std::vector<double> extents;
    for (const Asked& q : queries_) extents.push_back(extent(q.query));
    extent_ = spread(extents).median;
    name_ = files.size() == 1 ? files.front() : format("%zu files", files.size());
  }

  Grounds grounds() const override { return {extent_, 0, 1}; }
  std::string describe() const override {
    const auto hits =
        std::count_if(queries_.begin(), queries_.end(), [](auto& q) { return q.query.collides; });
    return format("%s: %zu queries, %lld collide\n", name_.c_str(), queries_.size(),
                  static_cast<long long>(hits));
  }
  std::string reference() const override {
    return exact_times_ ? "the exact times" : "the times at " + in_words(reference_options_);
  }
  const char* unit() const override { return "CPU time of one query"; }

  void answer(Measured& m) override {
    Answers& a = m.answers;
    std::vector<onset::QueryResult> results(queries_.size());
    a.peak_bytes = peak_bytes([&] {
      for (std::size_t i = 0; i < queries_.size(); ++i)
        results[i] = ask(queries_[i].kind, queries_[i].query, m.setting.options);
    });
    const bool has_times = exact_times_ || same_question(m.setting.options, reference_options_);
    if (has_times) a.early.emplace();
    a.false_negatives = 0;
    if (m.setting.options.min_separation == 0) a.false_positives = 0;
    for (std::size_t i = 0; i < queries_.size(); ++i) add(a, queries_[i], results[i]);
    a.asked = std::int64_t(queries_.size());
    a.tolerance = m.setting.options.tolerance.value_or(m.setting.options.relative_tolerance * extent_);
  }

  void time(Measured& m) override {
    m.best_us.resize(queries_.size(), INFINITY);
    m.collides.resize(queries_.size());
    const Stopwatch watch;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      const double us = microseconds(
          [&] { m.collides[i] = ask(queries_[i].kind, queries_[i].query, m.setting.options).collides(); });
      m.best_us[i] = std::min(m.best_us[i], us);
    }
    const Seconds seconds = watch.elapsed();
    const double each = 1e6 / double(queries_.size());
    m.wall.push_back(each * seconds.wall), m.cpu.push_back(each * seconds.cpu);
    m.us = m.cpu;
  }

 private:
  void read(const std::string& file, const std::string& kind) {
    const onset::PairKind k = kind_of_file(file, kind);
    std::vector<bool> collides;
    const std::vector<TruthQuery> queries = read_queries(file);
    for (const TruthQuery& query : queries) collides.push_back(query.collides);
    const std::vector<ExactToi> times = read_query_toi(file, collides);
    for (std::size_t i = 0; i < queries.size(); ++i)
      queries_.push_back({k, queries[i], times.empty() ? ExactToi() : times[i]});
  }

  void add(Answers& a, const Asked& q, const onset::QueryResult& r) const {
    a.positives += r.collides(), a.budget += r.outcome == onset::PairOutcome::max_checks,
        a.checks += r.checks;
    a.certain += r.collides() && r.certainty != onset::Certainty::within_tolerance;
    a.achieved_tolerance = std::max(a.achieved_tolerance, r.tolerance);
    if (r.collides()) a.earliest = std::min(a.earliest, r.toi);
    a.false_negatives = *a.false_negatives + (q.query.collides && !r.collides());
    if (a.false_positives) a.false_positives = *a.false_positives + (!q.query.collides && r.collides());
    if (a.early && q.query.collides && r.collides())
      a.early->add(r.toi, q.toi.lo, exact_times_ ? q.toi.hi : 1);
  }

  std::string name_;
  std::vector<Asked> queries_;
  bool exact_times_ = false;
  double extent_ = 1;
  onset::Options reference_options_;
};

}  // namespace

std::unique_ptr<Subject> query_subject(const std::vector<std::string>& files, const std::string& kind,
                                       const onset::Options& base) {
  return std::make_unique<QuerySubject>(files, kind, base);
}

}  // namespace app
