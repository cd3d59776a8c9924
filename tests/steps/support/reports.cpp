// What the calls say about a step: times, outcomes, pairs, and that they agree.
#include "tests/oracle/walk.hpp"
#include "tests/scenes/families.hpp"
#include "tests/steps/support/promises.hpp"

namespace onset::tests {

static bool decides_exactly(const Asked& asked) {
  return asked.options.exactness == Exactness::exact && asked.options.min_separation == 0 &&
         asked.thickness.empty() && !asked.keeps;
}

static bool same_pair(const Pair& p, const Key& q) { return p.kind == q.kind && p.a == q.a && p.b == q.b; }

static std::string wrong_start(const Asked& asked, const SceneTruth& truth, const StepResult& r) {
  const PairTruth* first = truth.touching();
  if (asked.options.touching_may_pass_through || !first) return {};
  if (r.step != 0) return "moves though a pair touches";
  if (r.outcome != Outcome::initial_contact)
    return std::string("touches at the start, but the outcome is ") + to_string(r.outcome);
  if (r.toi != 0) return "touches at the start, but toi is not 0";
  if (!r.limiting) return "a pair that touches limits, but none is named";
  const Key named{r.limiting->kind, r.limiting->a, r.limiting->b};
  if (first->key < named) return "the limiting pair is not the first that touches";
  const bool blocks = std::any_of(truth.contacts.begin(), truth.contacts.end(), [&](const PairTruth& pair) {
    return same_pair(*r.limiting, pair.key) && pair.initial();
  });
  return blocks ? "" : "the limiting pair does not touch";
}

static std::string wrong_toi(const Asked& asked, const SceneTruth& truth, const StepResult& r, Call call) {
  const oracle::Truth first = truth.first_met();
  if (first.collides && !(r.toi <= first.toi_lo)) return "toi is later than the contact";
  if (!(r.step <= r.toi)) return "step beyond toi";
  if (truth.initial()) return {};  // parting: toi is the next contact
  if (call != Call::whole || !decides_exactly(asked)) return {};
  if (r.toi != first.toi_lo) return "toi is not the exact time";
  return r.toi_hi == first.toi_hi ? "" : "toi_hi is not the exact time";
}

static std::string wrong_outcome(const SceneTruth& truth, const StepResult& r, bool bounded) {
  const bool named = r.limiting.has_value();
  switch (r.outcome) {
    case Outcome::free:
      if (named) return "free, but a pair limits";
      if (bounded) return {};
      if (truth.first_met().collides) return "free, but there is a contact";
      if (r.step < 1) return "free, but the step is shorter";
      return r.toi == INFINITY ? "" : "free, but toi is finite";
    case Outcome::contact:
    case Outcome::initial_contact:
    case Outcome::max_checks:
    case Outcome::below_rounding:
      if (!named) return "a pair limits, but none is named";
      return r.step < 1 ? "" : "a pair limits, but the step is 1";
    default:
      return "an outcome of bad positions or budgets";
  }
}

// A mesh that welds and copies that part: close pairs at rest do not hold what these keep from each other, so
// the step is 0 and names one of them.
static bool names_torn_copy(const Asked& asked, const StepResult& r, Call call) {
  if (call != Call::close || !asked.weld || r.vertex < 0 || r.step != 0 || r.toi != 0) return false;
  for (Eigen::Index v = 0; v < asked.x_t0.rows(); ++v)
    if (asked.x_t0.row(v) == asked.x_t0.row(r.vertex) && asked.x_t1.row(v) != asked.x_t1.row(r.vertex))
      return true;
  return false;
}

std::string wrong_report(const Asked& asked, const SceneTruth& truth, const StepResult& r, Call call) {
  if (names_torn_copy(asked, r, call)) return {};
  if (asked.options.touching_may_pass_through && truth.touching()) return {};  // it may go on, or not
  std::string wrong = wrong_start(asked, truth, r);
  if (wrong.empty()) wrong = wrong_outcome(truth, r, call == Call::close && r.step < 1);
  return wrong.empty() ? wrong_toi(asked, truth, r, call) : wrong;
}

static std::string wrong_row(const Asked& asked, const PairTruth& pair, const Contact& row) {
  if (!(row.toi <= pair.within.toi_lo)) return "a row is late";
  if (row.toi_hi < pair.within.toi_hi) return "toi_hi of a row is early";
  const bool starts =
      row.outcome == PairOutcome::initial_contact || row.outcome == PairOutcome::initial_separating;
  if (pair.initial() && !starts) return "a contact at the start is not called so";
  if (!pair.touching || asked.options.touching_may_pass_through) return {};
  if (row.outcome != PairOutcome::initial_contact) return "a pair that touches does not block";
  return row.degenerate ? "" : "the normal of a touching pair is not called degenerate";
}

std::string wrong_set(const Asked& asked, const SceneTruth& truth, const ActiveSet& set) {
  std::size_t found = 0;
  for (const PairTruth& pair : truth.contacts) {
    const std::size_t i = row_of(set, pair.key);
    const std::string which = ": " + to_text(pair.motion);
    if (i == set.size()) {
      if (pair.within.toi_lo < set.complete_until) return "misses a contact" + which;
      continue;
    }
    ++found;
    if (std::string wrong = wrong_row(asked, pair, set[i]); !wrong.empty()) return wrong + which;
  }
  if (decides_exactly(asked) && found < set.size()) return "a row that is no contact";
  for (const Contact& row : set)
    if (!(row.toi >= 0 && row.toi <= 1)) return "toi of a row outside [0, 1]";
  const bool whole = asked.options.window == INFINITY && set.outcome != Outcome::out_of_memory;
  if (whole && set.complete_until != INFINITY) return "not complete without a reason";
  return {};
}

std::string disagreement(const StepResult& r, const ActiveSet& set, bool free) {
  double limit = INFINITY;
  for (const Contact& row : set) limit = std::min(limit, row.step_limit);
  if (r.step > limit) return "the step is beyond a row's step_limit";
  if (r.toi != limit) return "toi is not the least step_limit of the active set";
  if (r.outcome == Outcome::free && !free) return "the step is free, is_step_collision_free is false";
  if (free && r.toi < INFINITY) return "is_step_collision_free, but toi is finite";
  if (free && limit <= 1) return "is_step_collision_free, but the active set has rows that limit it";
  return {};
}

static std::string by(const char* call, const std::string& broken) {
  return broken.empty() ? broken : std::string(call) + ": " + broken;
}

namespace {

// A step that was found to be safe for the motion asked about: what needs not be looked at again.
struct Safe {
  double step, rounding;
};

std::string broken_by_call(const Asked& asked, const SceneTruth& truth, const Calls& calls, Call call,
                           double d_hat, double gap_share, std::vector<Safe>& safe) {
  const CallStep step = calls.ask(call, asked.x_t0, asked.x_t1, asked.options, d_hat, gap_share);
  const StepResult& r = step.result;
  const Eigen::MatrixXd end = end_of(call, asked.x_t0, asked.x_t1);
  const Asked told{calls.mesh(call), asked.x_t0, end,        asked.options,
                   asked.thickness,  asked.weld, asked.lets, asked.keeps};
  const bool another = end != asked.x_t1 || told.mesh.num_points() > 0;
  const SceneTruth of_end = another ? SceneTruth(told) : truth;
  const bool known = !another && std::any_of(safe.begin(), safe.end(), [&](const Safe& s) {
    return r.step == s.step && r.rounding >= s.rounding;
  });
  std::string broken = known ? "" : broken_by_moving(told, of_end, r.step, r.rounding);
  if (broken.empty() && !another) safe.push_back({r.step, r.rounding});
  if (broken.empty() && !step.blind() && !names_torn_copy(told, r, call)) broken = stuck(told, r);
  if (broken.empty() && step.says_outcome) broken = wrong_report(told, of_end, r, call);
  if (broken.empty()) broken = share_lost(told, step);
  return by(name(call), broken);
}

}  // namespace

std::string broken_promise(const Asked& asked, const Calls& calls, double d_hat, double gap_share) {
  const SceneTruth truth(asked);
  std::vector<Safe> safe;
  for (Call call : kCalls) {
    const bool plain = asked.options.norm == Norm::euclidean && asked.thickness.empty() && !asked.weld &&
                       !asked.lets && !asked.keeps;
    if (Calls::is_adapter(call) && !plain) continue;
    if (std::string broken = broken_by_call(asked, truth, calls, call, d_hat, gap_share, safe);
        !broken.empty())
      return broken;
  }
  const StepResult r = compute_collision_free_stepsize(asked.mesh, asked.x_t0, asked.x_t1, asked.options);
  const ActiveSet set = construct_active_set(asked.mesh, asked.x_t0, asked.x_t1, asked.options);
  const bool free = is_step_collision_free(asked.mesh, asked.x_t0, asked.x_t1, asked.options);
  if (std::string broken = by("active set", wrong_set(asked, truth, set)); !broken.empty()) return broken;
  const bool may_pass = asked.options.touching_may_pass_through && truth.touching();
  return may_pass ? std::string() : disagreement(r, set, free);
}

}  // namespace onset::tests
