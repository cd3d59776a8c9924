#include "tests/oracle/promises.hpp"

#include <cstdio>

#include "tests/oracle/walk.hpp"

namespace onset::oracle {

std::string broken_promise(const scenes::Query&, const Options&, const QueryResult& result,
                           const Known& truth) {
  if (result.outcome == PairOutcome::free) {
    if (result.toi != INFINITY || result.step_limit != INFINITY) return "free, but not for ever";
  } else if (!(result.toi >= 0 && result.toi <= 1)) {
    return "toi outside [0, 1]";
  }
  if (truth.contact && !result.collides()) return "missed a contact";
  if (truth.contact && !(result.toi <= truth.latest)) return "toi later than the contact";
  return {};
}

bool silent_zero(const scenes::Query& query, const Options& options, const QueryResult& result) {
  if (result.toi > 0) return false;
  const double d = options.min_separation, ulps = 0x1p-40 * (extent(query) + d);
  return compare_distance(query, 0, d + ulps, options.norm) > 0;
}

static std::string wrong_outcome(const scenes::Query& query, const Options& options,
                                 const QueryResult& result) {
  const PairOutcome outcome = result.outcome;
  const bool initial = outcome == PairOutcome::initial_contact || outcome == PairOutcome::initial_separating;
  if (outcome == PairOutcome::non_finite || outcome == PairOutcome::out_of_range)
    return "an outcome for bad positions";
  if (initial && result.toi != 0) return "starts in contact, but toi is not 0";
  if (outcome == PairOutcome::contact && result.toi == 0)
    return "a contact at toi 0 that is not called initial";
  const bool within = compare_distance(query, 0, options.min_separation, options.norm) <= 0;
  if (within && !initial) return "starts within the separation, not said";
  if (outcome == PairOutcome::initial_separating) {
    const double rounding = 0x1p-45 * extent(query), start = distance(query, 0, options.norm).lo - rounding;
    for (double part : {0x1p-20, 0.125, 0.25, 0.5, 0.75, 1.0})
      if (start > 0 &&
          compare_distance(query, part * std::min(1.0, result.step_limit), start, options.norm) < 0)
        return "called separating, but comes closer before step_limit";
  }
  return {};
}

bool tolerance_understated(const scenes::Query& query, const Options& options, const QueryResult& result) {
  const double d = options.min_separation, rounding = 0x1p-42 * (extent(query) + d) + 0x1p-1070;
  return !(result.tolerance >= 0) ||
         compare_distance(query, result.toi, d + result.tolerance + rounding, options.norm) > 0;
}

std::string wrong_report(const scenes::Query& query, const Options& options, const QueryResult& result) {
  const std::string wrong = wrong_outcome(query, options, result);
  if (!wrong.empty()) return wrong;

  if (!result.collides()) return {};

  if (result.outcome == PairOutcome::max_checks) return {};
  if (tolerance_understated(query, options, result))
    return "farther apart at toi than the reported tolerance";
  const double size = extent(query), rounding = 0x1p-42 * (size + options.min_separation) + 0x1p-1070;
  const double asked = options.tolerance ? *options.tolerance : options.relative_tolerance * size;
  return result.tolerance > asked + rounding ? "reported beyond the tolerance" : std::string();
}

std::string to_text(const Options& options, const QueryResult& result) {
  char line[300];
  std::snprintf(line, sizeof line,
                "tolerance %s%g, max_checks %lld, separation %a %s, method %d, kernel %d -> %s, toi %a (%g), "
                "tolerance %g, "
                "%lld checks",
                options.tolerance ? "" : "relative ", options.tolerance.value_or(options.relative_tolerance),
                static_cast<long long>(options.max_checks), options.min_separation,
                options.norm == Norm::maximum ? "maximum" : "euclidean", int(options.narrow_phase),
                int(options.instruction_set), onset::to_string(result.outcome), result.toi, result.toi,
                result.tolerance, static_cast<long long>(result.checks));
  return line;
}

}  // namespace onset::oracle
