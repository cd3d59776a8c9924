#include "tests/narrowphase/separation.hpp"

#include <algorithm>
#include <cmath>

#include "tests/oracle/distance.hpp"

namespace onset::tests {

using scenes::Query;

double rough_distance(const Query& query, double t, Norm norm) {
  std::array<oracle::Vector<double>, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = scenes::lerp(query.t0[i], query.t1[i], t);
  const auto r = oracle::relative(query.kind, x);
  if (norm == Norm::maximum) return oracle::maximum_norm_distance(r);
  const auto d = oracle::shortest_difference(r);
  return std::hypot(d[0], d[1], d[2]);
}

double rough_closest_time(const Query& query, Norm norm) {
  constexpr int kSamples = 24;
  double best = 0, least = INFINITY;
  const auto look = [&](double t) {
    const double d = rough_distance(query, t, norm);
    if (d < least) least = d, best = t;
  };
  for (int i = 0; i <= kSamples; ++i) look(double(i) / kSamples);
  for (double step = 0.5 / kSamples; step > 1e-9; step *= 0.5) {
    const double middle = best;
    look(std::max(0.0, middle - step));
    look(std::min(1.0, middle + step));
  }
  return best;
}

oracle::Known known_within(const Query& query, double d, Norm norm) {
  constexpr int kSamples = 24;
  const auto within = [&](double t) { return rough_distance(query, t, norm) < d; };
  double late = rough_closest_time(query, norm);
  for (int i = kSamples; i >= 0; --i)
    if (const double t = double(i) / kSamples; t < late && within(t)) late = t;
  double early = std::max(0.0, late - 1.0 / kSamples);
  for (int i = 0; i < 40 && early < late; ++i) {
    const double middle = 0.5 * (early + late);
    (within(middle) ? late : early) = middle;
  }
  for (double t : {late, std::min(1.0, late * (1 + 0x1p-30)), std::min(1.0, late * (1 + 0x1p-10))})
    if (oracle::compare_distance(query, t, d, norm) < 0) return {true, t};
  return {};
}

std::string broken_promise(const Query& query, const Options& options, const QueryResult& result) {
  const double d = options.min_separation;
  const oracle::Known known =
      d > 0 ? known_within(query, d, options.norm) : oracle::known(oracle::exact_ccd(query));
  std::string broken = oracle::broken_promise(query, options, result, known);
  if (broken.empty()) broken = oracle::wrong_report(query, options, result);
  if (broken.empty() && oracle::silent_zero(query, options, result))
    broken = "a step of zero from a start that is apart";
  return broken;
}

}  // namespace onset::tests
