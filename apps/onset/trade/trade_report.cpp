#include "onset/trade/trade_report.hpp"

#include <algorithm>
#include <cmath>

#include "measure/system.hpp"
#include "onset/results/report.hpp"

namespace app {
namespace {

// Bins a factor of 10 in the histogram of times, the first from kFirstUs.
constexpr int kBins = 8;
constexpr double kFirstUs = 0.01;

template <class T>
Json or_null(const std::optional<T>& x) {
  return x ? Json(*x) : Json();
}
std::string or_dash(const std::optional<std::int64_t>& x) {
  return x ? std::to_string(*x) : std::string("-");
}

std::vector<std::int64_t> binned(const Measured& m, bool collides) {
  std::vector<std::int64_t> bins;
  for (std::size_t i = 0; i < m.best_us.size(); ++i) {
    if (m.collides[i] != collides) continue;
    const auto bin = std::size_t(std::max(0.0, kBins * std::log10(m.best_us[i] / kFirstUs)));
    if (bin >= bins.size()) bins.resize(bin + 1);
    ++bins[bin];
  }
  return bins;
}

Json histogram_json(const Measured& m) {
  if (m.best_us.empty()) return nullptr;
  return {{"first_us", kFirstUs},
          {"bins_a_decade", kBins},
          {"positive", binned(m, true)},
          {"negative", binned(m, false)},
          {"slowest_us", *std::max_element(m.best_us.begin(), m.best_us.end())}};
}

Json early_json(const std::optional<Earliness>& e) {
  if (!e) return nullptr;
  return {{"pairs", e->pairs}, {"mean", e->mean()}, {"max", e->most}, {"zero", e->zero}, {"late", e->late}};
}

Json options_json(const onset::Options& o) {
  return {{"tolerance", or_null(o.tolerance)},
          {"relative_tolerance", o.relative_tolerance},
          {"min_separation", o.min_separation},
          {"norm", norm_name(o.norm)},
          {"max_checks", o.max_checks},
          {"certainty", exactness_name(o.exactness)},
          {"threads", o.threads}};
}

Json measured_json(const Measured& m, bool on_front) {
  const Answers& a = m.answers;
  return {{"axis", m.setting.axis},
          {"value", m.setting.value},
          {"options", in_words(m.setting.options)},
          {"numbers", options_json(m.setting.options)},
          {"same_question", m.setting.same_question},
          {"on_front", on_front},
          {"us", spread_json(spread(m.us))},
          {"wall_us", spread_json(spread(m.wall))},
          {"cpu_us", spread_json(spread(m.cpu))},
          {"asked", a.asked},
          {"positives", a.positives},
          {"certain", a.certain},
          {"false_positives", or_null(a.false_positives)},
          {"false_negatives", or_null(a.false_negatives)},
          {"early", early_json(a.early)},
          {"budget", a.budget},
          {"inclusion", a.inclusion},
          {"checks", a.checks},
          {"tolerance", a.tolerance},
          {"achieved_tolerance", a.achieved_tolerance},
          {"earliest", a.earliest},
          {"peak_bytes", or_null(a.peak_bytes)},
          {"incomplete", a.incomplete ? Json(outcome_name(*a.incomplete)) : Json()},
          {"complete_until", time_json(a.complete_until)},
          {"histogram", histogram_json(m)}};
}

bool contains(const std::vector<std::size_t>& front, std::size_t i) {
  return std::find(front.begin(), front.end(), i) != front.end();
}

std::string early_text(const std::optional<Earliness>& e) {
  return e ? format("%9.2g %9.2g", e->mean(), e->most) : format("%9s %9s", "-", "-");
}

std::string memory_text(const std::optional<std::int64_t>& bytes) {
  return bytes ? format("%8.1f", double(*bytes) / (1 << 20)) : format("%8s", "-");
}

std::string row(const Measured& m, bool on_front) {
  const Answers& a = m.answers;
  const Spread t = spread(m.us);
  return format("%c %-14s %-29s %11.4g [%.4g, %.4g]  %9lld %9s %9s %s %9lld %9.2g %s%s\n",
                on_front ? '*' : ' ', m.setting.axis.c_str(), m.setting.value.c_str(), t.median, t.least,
                t.most, static_cast<long long>(a.positives), or_dash(a.false_positives).c_str(),
                or_dash(a.false_negatives).c_str(), early_text(a.early).c_str(),
                static_cast<long long>(a.budget), a.achieved_tolerance, memory_text(a.peak_bytes).c_str(),
                a.incomplete ? format("  incomplete: %s", outcome_name(*a.incomplete)).c_str() : "");
}

std::string table(const TradeReport& r) {
  std::string text =
      format("  %-14s %-29s %11s [least, most]    positives false pos false neg %9s %9s %9s %9s %8s\n",
             "axis", "value", "us, median", "early", "at most", "budget", "reached", "MiB");
  for (std::size_t i = 0; i < r.settings.size(); ++i) text += row(r.settings[i], contains(r.front, i));
  return text;
}

std::string incomplete_text(const TradeReport& r) {
  const auto is_incomplete = [](const Measured& m) { return m.answers.incomplete.has_value(); };
  if (std::none_of(r.settings.begin(), r.settings.end(), is_incomplete)) return "";
  return "incomplete: a budget ended the call. Contacts that it could not find by then are no false "
         "negatives, and "
         "the setting is\nnot on the front.\n";
}

std::string legend(const TradeReport& r) {
  return format(
             "us: %s. early: how much sooner than %s a pair is said to touch, mean and at most, in "
             "units\n"
             "of the step. budget: pairs that spent max_checks. reached: the largest distance beyond the "
             "separation "
             "at\n"
             "which a pair was reported. *: on the Pareto front of time, false positives (else positives), "
             "earliness "
             "and budget.\n",
             r.subject.unit(), r.subject.reference().c_str()) +
         incomplete_text(r);
}

std::string words(const Measured& m) {
  const Answers& a = m.answers;
  return format("%s: %.4g us, %lld positives%s", in_words(m.setting.options).c_str(), spread(m.us).median,
                static_cast<long long>(a.positives),
                a.false_positives
                    ? format(", %lld of them false", static_cast<long long>(*a.false_positives)).c_str()
                    : "") +
         (a.early ? format(", %.2g early", a.early->mean()) : "");
}

std::string front_text(const TradeReport& r) {
  std::string text = "Pareto front, fastest first\n";
  for (const std::size_t i : r.front) text += "  " + words(r.settings[i]) + "\n";
  return text + (r.base_on_front() ? "The base is on the front.\n" : "The base is NOT on the front.\n");
}

std::string recommendation_text(const TradeReport& r) {
  if (!r.target.any()) return "";
  if (!r.recommended) return "Recommended: none of these settings meets the target.\n";
  return "Recommended: " + words(r.settings[*r.recommended]) + "\n";
}

std::string missed_text(const TradeReport& r) {
  std::int64_t missed = 0, late = 0;
  bool known = false;
  for (const Measured& m : r.settings) {
    known |= m.answers.false_negatives.has_value();
    missed += m.answers.false_negatives.value_or(0);
    if (m.answers.early) late += m.answers.early->late;
  }
  if (!known) return "";
  return format("False negatives in all settings together: %lld; times later than the exact ones: %lld\n",
                static_cast<long long>(missed), static_cast<long long>(late));
}

}  // namespace

const char* const kTradeColumns =
    "axis,value,us,us_min,us_max,cpu_us,asked,positives,false_positives,false_negatives,"
    "early_mean,early_max,budget,tolerance,achieved_tolerance,peak_bytes,on_front,incomplete";

bool TradeReport::base_on_front() const { return contains(front, 0); }

Json to_json(const TradeReport& r) {
  Json json = {{"subject", r.subject.describe()},
               {"machine", machine()},
               {"time_of", r.subject.unit()},
               {"reference", r.subject.reference()},
               {"base_on_front", r.base_on_front()}};
  json["recommended"] = r.recommended ? Json(in_words(r.settings[*r.recommended].setting.options)) : Json();
  json["settings"] = Json::array();
  for (std::size_t i = 0; i < r.settings.size(); ++i)
    json["settings"].push_back(measured_json(r.settings[i], contains(r.front, i)));
  return json;
}

std::string describe(const TradeReport& r) {
  return r.subject.describe() + machine() + "\n\n" + table(r) + "\n" + legend(r) + missed_text(r) + "\n" +
         front_text(r) + recommendation_text(r);
}

void write_csv(Output& csv, const TradeReport& r) {
  csv.write(std::string(kTradeColumns) + "\n");
  const auto number = [](const std::optional<std::int64_t>& x) { return x ? std::to_string(*x) : ""; };
  for (std::size_t i = 0; i < r.settings.size(); ++i) {
    const Measured& m = r.settings[i];
    const Answers& a = m.answers;
    const Spread us = spread(m.us);
    const std::string early = a.early ? format("%.9g,%.9g", a.early->mean(), a.early->most) : ",";
    csv.write(format("%s,\"%s\",%.9g,%.9g,%.9g,%.9g,%lld,%lld,%s,%s,%s,%lld,%.9g,%.9g,%s,%d,%s\n",
                     m.setting.axis.c_str(), m.setting.value.c_str(), us.median, us.least, us.most,
                     spread(m.cpu).median, static_cast<long long>(a.asked),
                     static_cast<long long>(a.positives), number(a.false_positives).c_str(),
                     number(a.false_negatives).c_str(), early.c_str(), static_cast<long long>(a.budget),
                     a.tolerance, a.achieved_tolerance, number(a.peak_bytes).c_str(),
                     int(contains(r.front, i)), a.incomplete ? outcome_name(*a.incomplete) : ""));
  }
}

}  // namespace app
