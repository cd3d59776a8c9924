// What the step itself promises: how far the motion may go, and where it leaves the pairs.
#include "tests/oracle/quick.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/scenes/families.hpp"
#include "tests/steps/support/promises.hpp"

namespace onset::tests {

using scenes::Query;

static std::string at(const char* what, const Key& pair, const Query& motion) {
  return std::string(what) + ": " + std::to_string(pair.a) + " and " + std::to_string(pair.b) + ", " +
         to_text(motion);
}

// What starts within its separation, and parts, comes no closer than at the start but for rounding.
static bool comes_closer(const PairTruth& pair, double step, Norm norm) {
  const double start = oracle::distance(pair.motion, 0, norm).lo - 0x1p-45 * oracle::extent(pair.motion);
  const oracle::Truth closer = oracle::exact_within(pair.motion, std::max(start, 0.0), norm);
  return closer.collides && closer.toi_hi <= step;
}

// Beyond a separation d > 0 by no more than 2^-44 of its size a pair may be taken to start within it.
static double slack(const Query& motion, double d) { return d > 0 ? 0x1p-44 * oracle::extent(motion) : 0; }

static std::string broken_by_contact(const Asked& asked, const PairTruth& pair, double step) {
  const Norm norm = asked.options.norm;
  const double d = pair.separation;
  if (step == 0) return {};
  if (pair.touching)
    return asked.options.touching_may_pass_through ? "" : at("moves while in touch", pair.key, pair.motion);
  if (oracle::compare_distance(pair.motion, 0, d + slack(pair.motion, d), norm) <= 0)
    return comes_closer(pair, step, norm) ? at("comes closer", pair.key, pair.motion) : "";
  const bool before =
      pair.within.toi_hi == pair.within.toi_lo ? step < pair.within.toi_lo : step <= pair.within.toi_lo;
  return before ? std::string() : at("steps into a contact", pair.key, pair.motion);
}

// By more than storing can change: at the start beyond d by twice the rounding.
static bool starts_beyond(const Query& motion, double d, double rounding, Norm norm) {
  return oracle::compare_distance(motion, 0, std::nextafter(d + 2 * rounding, INFINITY), norm) > 0;
}

static const char* broken_by_storing(const Query& motion, double d, double step, double rounding, Norm norm) {
  if (oracle::boxes_apart(motion, d + 2 * rounding)) return "";
  std::array<Point, 4> last{};
  for (oracle::Rounding how : oracle::kRoundings) {
    const auto end = oracle::stored(how, motion, step);
    if (how != oracle::Rounding::product && end == last) continue;
    last = end;
    if (const char* broken = oracle::broken_on_the_way(motion, step, end); *broken) return broken;
    if (d > 0 && starts_beyond(motion, d, std::max(rounding, slack(motion, d) / 2), norm) &&
        oracle::compare_distance_at_rest(motion.kind, end, d, norm) <= 0)
      return "is stored within the separation";
  }
  return "";
}

std::string broken_by_moving(const Asked& asked, const SceneTruth& truth, double step, double rounding) {
  if (!(step >= 0 && step <= 1)) return "a step outside [0, 1]";
  for (const PairTruth& pair : truth.contacts)
    if (std::string broken = broken_by_contact(asked, pair, step); !broken.empty()) return broken;
  std::string broken;
  if (step == 0 || truth.touching()) return broken;
  asked.for_pairs([&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    if (!broken.empty()) return;
    const Query motion = query_of(kind, v, asked.x_t0, asked.x_t1);
    const char* how =
        broken_by_storing(motion, asked.separation(kind, v), step, rounding, asked.options.norm);
    if (*how) broken = at(how, {kind, a, b}, motion);
  });
  return broken;
}

std::string stuck(const Asked& asked, const StepResult& r) {
  if (r.step > 0) return {};
  if (!(r.rounding >= 0 && r.rounding < INFINITY)) return "a step of 0 without a rounding";
  const auto has_room = [&](PairKind kind, const std::array<int, 4>& v) {
    const Query motion = query_of(kind, v, asked.x_t0, asked.x_t1),
                at_rest = query_of(kind, v, asked.x_t0, asked.x_t0);
    const double d = asked.separation(kind, v), gap = std::max(r.rounding, slack(motion, d) / 2);
    return oracle::boxes_apart(at_rest, d + 2 * gap) || starts_beyond(motion, d, gap, asked.options.norm);
  };
  bool near = r.limiting && !has_room(r.limiting->kind, r.limiting->vertices);
  asked.for_pairs(
      [&](PairKind kind, int, int, const std::array<int, 4>& v) { near = near || !has_room(kind, v); });
  return near ? "" : "a step of 0 though every gap is more than twice the rounding";
}

static bool is_looked_at(const CallStep& step, PairKind kind, int a, int b) {
  if (!step.only) return true;
  const auto& list = kind == PairKind::vertex_face ? step.only->vertex_face : step.only->edge_edge;
  return std::binary_search(list.begin(), list.end(), std::array<int, 2>{a, b});
}

std::string share_lost(const Asked& asked, const CallStep& step) {
  std::string lost;
  const StepResult& r = step.result;
  if (step.gap_share == 0 || r.step == 0) return lost;
  asked.for_pairs([&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    const Query motion = query_of(kind, v, asked.x_t0, asked.x_t1);
    const double d = asked.separation(kind, v);
    if (!lost.empty() || oracle::boxes_apart(motion, d + step.reach + 2 * r.rounding)) return;
    if (!is_looked_at(step, kind, a, b)) return;
    const double gap = oracle::distance(motion, 0, asked.options.norm).lo - d;
    if (!(gap > 2 * r.rounding / (1 - step.gap_share))) return;
    const double left = std::min(step.gap_share * gap, step.reach) * (1 - 0x1p-40) - r.rounding;
    const auto end = oracle::stored(oracle::Rounding::product, motion, r.step);
    if (left > 0 && !oracle::boxes_apart({kind, end, end}, d + left) &&
        oracle::compare_distance_at_rest(kind, end, d + left, asked.options.norm) < 0)
      lost = at("keeps less of its gap", {kind, a, b}, motion);
  });
  return lost;
}

}  // namespace onset::tests
