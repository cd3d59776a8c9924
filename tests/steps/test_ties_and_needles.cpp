// Separations of pairs whose closest features tie, and of needles: none is passed below, none that starts
// beyond is stopped at once, and a line search keeps the share of the gap that it says. Exact at every time
// that is looked at.
#include "tests/catch.hpp"
#include "tests/narrowphase/separation.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/oracle/within.hpp"
#include "tests/scenes/families.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/steps/support/calls.hpp"
#include "tests/steps/support/ties_and_needles.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

// Where the pair seems closest on [0, until].
double closest_time(const Query& query, double until, Norm norm) {
  double best = 0, least = INFINITY;
  for (int i = 0; i <= 12; ++i) {
    const double t = until * i / 12, distance = rough_distance(query, t, norm);
    if (distance < least) least = distance, best = t;
  }
  return best;
}

// What the separation d asks of a pair on its way.
struct Kept {
  double start;  // the distance at the start, rounded down
  double least;  // no less is allowed
  bool beyond;   // starts beyond d
  bool surely;   // ... by more than 2^-44 of the size; what is nearer may be taken to start within d
};
Kept kept(const Query& query, double d, Norm norm) {
  const double start = oracle::distance(query, 0, norm).lo, size = oracle::extent(query);
  const bool beyond = oracle::compare_distance(query, 0, d, norm) > 0;
  const bool surely = oracle::compare_distance(query, 0, d + 0x1p-44 * size, norm) > 0;
  return {start, surely ? d : std::max(0.0, std::min(d, start - 0x1p-45 * size)), beyond, surely};
}

// Until `end` the pair never comes below what it is to keep; at it neither, or, where it is a contact, to it.
bool keeps(const Query& query, const Kept& kept, double end, bool contact, Norm norm, Random& random) {
  for (double t : {end, closest_time(query, end, norm), end * scenes::unit(random), end * (1 - 0x1p-20)}) {
    const int s = oracle::compare_distance(query, t, kept.least, norm);
    if (s < 0 || (s == 0 && kept.surely && !(contact && t == end))) return false;
  }
  return true;
}

std::string broken_by_query(const Query& query, const Options& o, const Kept& kept, Random& random) {
  const QueryResult r = scenes::ccd(query, o);
  const bool initial =
      r.outcome == PairOutcome::initial_contact || r.outcome == PairOutcome::initial_separating;
  if (!kept.beyond && !initial) return "starts within the separation, not said";
  if (kept.surely && (initial || r.toi == 0)) return "starts beyond the separation, and is stopped at once";
  if (r.step_limit > 0 && !keeps(query, kept, std::min(r.step_limit, 1.0), r.collides(), o.norm, random))
    return kept.surely ? "below the separation before step_limit" : "comes closer before step_limit";
  return {};
}

std::string broken_by_step(const Query& query, const Options& o, const Kept& kept, Random& random) {
  const double d = o.min_separation;
  const Mesh mesh = mesh_of(query.kind);
  const StepResult r = compute_collision_free_stepsize(mesh, positions(query.t0), positions(query.t1), o);
  const bool room = oracle::compare_distance(query, 0, d + 2 * r.rounding, o.norm) > 0;
  if (r.step == 0) return kept.surely && room ? "a step of 0 from a start beyond the separation" : "";
  if (!keeps(query, kept, r.step, false, o.norm, random)) return "the step leads below";
  if (!room || !kept.surely) return {};
  const auto end = oracle::stored(oracle::kRoundings[scenes::integer(random, 0, 2)], query, r.step);
  return oracle::compare_distance_at_rest(query.kind, end, d, o.norm) > 0 ? ""
                                                                          : "is stored within the separation";
}

std::string broken_by_search(const Query& query, const Options& o, const Kept& kept, double gap_share) {
  if (!kept.beyond) return {};
  const Eigen::MatrixXd x = positions(query.t0), dx = positions(query.t1) - x;
  const LineSearchStep r = LineSearch(mesh_of(query.kind), x, dx, with_share(o, gap_share)).largest_step();
  const double gap = kept.start - o.min_separation, d = o.min_separation, tolerance = r.stats.tolerance;
  const bool room = oracle::compare_distance(query, 0, d + 2 * r.rounding / (1 - gap_share), o.norm) > 0;
  if (r.step == 0) return room ? "a search of 0 from a start beyond the separation" : "";
  if (room && (r.gap_share_reduced || !r.assured)) return "a share cut though there is room";
  const double left = std::min(r.gap_share * gap, tolerance) * (1 - 0x1p-30) - r.rounding;
  Query motion = query;
  const Eigen::MatrixXd x_t1 = x + dx;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) motion.t1[i][k] = x_t1(Eigen::Index(i), Eigen::Index(k));
  const auto end = oracle::stored(oracle::Rounding::product, motion, r.step);
  const bool kept_it = left <= 0 || oracle::compare_distance_at_rest(query.kind, end, d + left, o.norm) >= 0;
  return kept_it ? "" : "keeps less of its gap than reported";
}

void check_all(int pairs, std::uint64_t seed, Norm norm) {
  Random random(oracle::fuzz_seed() * 1000 + seed);
  int beyond = 0, within = 0;
  for (int i = 0; i < pairs; ++i) {
    const Query query =
        tie_or_needle(scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge, random);
    Options o;
    o.norm = norm;
    o.threads = 1;
    o.min_separation = separation_near(oracle::distance(query, 0, norm).lo, random);
    if (scenes::coin(random)) o.relative_tolerance = scenes::power_of_ten(random, -16, 0);
    if (scenes::integer(random, 0, 3) == 0) o.exactness = Exactness::exact;
    if (!(o.min_separation > 0)) continue;
    const Kept k = kept(query, o.min_separation, norm);
    (k.beyond ? beyond : within) += 1;
    std::string broken = broken_by_query(query, o, k, random);
    if (broken.empty()) broken = broken_by_step(query, o, k, random);
    if (broken.empty()) broken = broken_by_search(query, o, k, scenes::uniform(random, 0.1, 0.9));
    if (!broken.empty())
      FAIL_CHECK(broken << "\n  " << to_text(query) << "\n  " << oracle::to_text(o, scenes::ccd(query, o))
                        << ", starts at " << k.start);
  }
  CHECK((beyond > 0 && within > 0));
  if (pairs >= 100) CHECK((4 * beyond > pairs && 4 * within > pairs));
}

}  // namespace

TEST_CASE("separations of ties and needles are kept", "[property][oracle]") {
  check_all(oracle::fuzz(4000), 31, Norm::euclidean);
}

TEST_CASE("separations of ties and needles are kept in the maximum norm", "[property][oracle]") {
  check_all(oracle::fuzz(150), 32, Norm::maximum);
}

TEST_CASE("the exact first time within a separation is not passed by ties and needles",
          "[property][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 33);
  for (int i = 0; i < oracle::fuzz(300); ++i) {
    const Query query =
        tie_or_needle(scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge, random);
    Options o;
    o.min_separation = separation_near(oracle::distance(query, 0).lo, random);
    if (!(o.min_separation > 0)) continue;
    const oracle::Truth truth = oracle::exact_within(query, o.min_separation);
    const QueryResult r = scenes::ccd(query, o);
    INFO(to_text(query) << "\n  " << oracle::to_text(o, r) << "\n  exact " << truth.toi_lo);
    CHECK(oracle::broken_promise(query, o, r, oracle::known(truth)) == "");
  }
}
