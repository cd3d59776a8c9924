// Vertices against planes, random motions of every size: steps and active sets against rational numbers.
#include <cstdio>
#include <map>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/planes/plane_scenes.hpp"
#include "tests/planes/plane_truth.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

struct Counts {
  long long motions = 0, contacts = 0, late = 0, missed = 0, extra = 0, steps = 0, stopped = 0, broken = 0;
};

std::string text_of(const PlaneScene& s, int v, std::size_t p) {
  char text[512];
  const Plane& n = s.rules.planes[p];
  std::snprintf(
      text, sizeof text, "vertex %d: %a %a %a -> %a %a %a, plane %zu: %a %a %a, %a, separation %a, norm %d",
      v, s.x_t0(v, 0), s.x_t0(v, 1), s.x_t0(v, 2), s.x_t1(v, 0), s.x_t1(v, 1), s.x_t1(v, 2), p, n.normal[0],
      n.normal[1], n.normal[2], n.offset, s.options.min_separation, int(s.options.norm));
  return text;
}

struct Case {
  const PlaneScene& scene;
  int v;
  std::size_t p;
  HalfSpaceTruth truth;
  PlaneWay way;

  Case(const PlaneScene& s, int vertex, std::size_t plane)
      : scene(s),
        v(vertex),
        p(plane),
        truth(s.rules.planes[plane], s.options.min_separation, s.options.norm),
        way{truth.value(s.x_t0.row(vertex)), truth.value(s.x_t1.row(vertex))} {}

  int start() const { return truth.side(way.start); }
  bool contact() const { return start() <= 0 || truth.side(way.end) <= 0; }
  bool parts() const {
    return oracle::sign(way.start) > 0 && start() <= 0 && oracle::sign(Rational(way.end - way.start)) >= 0;
  }
  std::string text() const { return text_of(scene, v, p); }
};

std::vector<Case> cases_of(const PlaneScene& s) {
  std::vector<Case> all;
  for (int v = 0; v < s.x_t0.rows(); ++v)
    for (std::size_t p = 0; p < s.rules.planes.size(); ++p) all.emplace_back(s, v, p);
  return all;
}

// Empty, or what is wrong with a contact.
std::string wrong(const Case& c, const Contact& r) {
  if (c.start() <= 0) {
    if (r.toi != 0 || r.toi_hi != 0 || r.certainty != Certainty::touching_at_start) return "not at the start";
    if ((r.outcome == PairOutcome::initial_separating) != c.parts()) return "parts, or does not";
    return r.step_limit == (c.parts() ? INFINITY : 0) ? "" : "step_limit";
  }
  if (r.outcome != PairOutcome::contact || r.certainty != Certainty::certain) return "outcome";
  if (!(r.toi_hi == r.toi || r.toi_hi == std::nextafter(r.toi, 2))) return "not adjacent doubles";
  if (c.truth.side(c.way.at(r.toi)) < 0) return "late";
  if (c.truth.side(c.way.at(r.toi_hi)) > 0) return "not yet at toi_hi";
  return r.step_limit == r.toi ? "" : "step_limit";
}

void check_set(const PlaneScene& s, const std::vector<Case>& cases, Counts& counts) {
  const ActiveSet set = construct_active_set(s.mesh(), s.x_t0, s.x_t1, s.options);
  std::map<std::pair<int, int>, const Contact*> found;
  for (const Contact& c : set) found[{c.a, c.b}] = &c;
  CHECK(found.size() == set.size());
  std::size_t contacts = 0;
  for (const Case& c : cases) {
    ++counts.motions;
    const auto at = found.find({c.v, int(c.p)});
    if (!c.contact()) {
      if (at == found.end()) continue;
      ++counts.extra;
      FAIL_CHECK("reported, though free: " << c.text());
      continue;
    }
    ++contacts, ++counts.contacts;
    if (at == found.end()) {
      ++counts.missed;
      FAIL_CHECK("missed: " << c.text());
      continue;
    }
    const std::string why = wrong(c, *at->second);
    counts.late += why == "late";
    if (!why.empty()) FAIL_CHECK(why << ": " << c.text() << ", toi " << at->second->toi);
  }
  CHECK(set.size() == contacts);
}

// As stored in one of the orders of operations that docs/steps.md names.
Eigen::RowVector3d stored(const Case& c, int how, double s) {
  Eigen::RowVector3d x;
  for (int a = 0; a < 3; ++a)
    x[a] = oracle::stored(oracle::kRoundings[how], c.scene.x_t0(c.v, a), c.scene.x_t1(c.v, a), s);
  return x;
}

// Empty, or how a step breaks what it promises of a pair.
std::string broken(const Case& c, const StepResult& r, double s) {
  if (c.start() > 0 && c.truth.side(c.way.at(s)) <= 0) return "not free along the exact motion";
  const bool moves = c.scene.x_t0.row(c.v) != c.scene.x_t1.row(c.v);
  if (s == 0 || !moves) return "";
  if (c.start() <= 0 && !c.parts()) return "blocked pair, and a step of more than 0";
  for (int how = 0; how < 3; ++how) {
    const Rational f = c.truth.value(stored(c, how, s));
    if (c.start() > 0 ? c.truth.side(f) <= 0 : oracle::sign(f) <= 0) return "not free as stored";
  }
  return s > r.toi ? "step later than toi" : "";
}

// Whether a pair starts apart by more than so much.
bool has_room(const Case& c, double room) {
  const HalfSpaceTruth wider(c.scene.rules.planes[c.p], c.scene.options.min_separation + room,
                             c.scene.options.norm);
  return wider.side(c.way.start) > 0;
}

void check_step(const StepResult& r, const std::vector<Case>& cases, Random& random, Counts& counts) {
  ++counts.steps;
  counts.stopped += r.step == 0;
  const double between = r.shortest + scenes::unit(random) * (r.step - r.shortest);
  for (const Case& c : cases)
    for (const double s : {r.step, std::min(between, r.step)}) {
      const std::string why = broken(c, r, s);
      counts.broken += !why.empty();
      if (!why.empty())
        FAIL_CHECK(why << ": " << c.text() << ", step " << s << ", toi " << r.toi << ", "
                       << to_string(r.outcome));
    }
  if (r.step > 0) return;
  bool room = true;
  for (const Case& c : cases) room = room && has_room(c, 2 * r.rounding);
  counts.broken += room;
  if (room) FAIL_CHECK("stuck with room: " << cases[0].text());
}

void check_first(const StepResult& r, const std::vector<Case>& cases, const ActiveSet& set) {
  double first = INFINITY;
  for (const Contact& c : set) first = std::min(first, c.step_limit);
  CHECK(r.toi == first);
  for (const Case& c : cases)
    if (r.limiting && r.limiting->a == c.v && r.limiting->b == int(c.p)) return;
  CHECK(!r.limiting);
}

}  // namespace

TEST_CASE("contacts with planes are those of exact arithmetic, at the adjacent doubles", "[planes][oracle]") {
  for (const bool plain : {true, false}) {
    Random random(oracle::fuzz_seed() * 1000 + 71 + plain);
    Counts counts;
    for (int i = 0; i < oracle::fuzz(500); ++i) {
      const PlaneScene s = random_plane_scene(random, plain);
      check_set(s, cases_of(s), counts);
    }
    std::printf("%s sizes: %lld motions, %lld contacts, %lld late, %lld missed, %lld in vain\n",
                plain ? "plain" : "all", counts.motions, counts.contacts, counts.late, counts.missed,
                counts.extra);
    CHECK(counts.late + counts.missed + counts.extra == 0);
    CHECK(counts.contacts * 10 > counts.motions);
  }
}

TEST_CASE("steps towards planes are free, exactly and as stored", "[planes][oracle]") {
  for (const bool plain : {true, false}) {
    Random random(oracle::fuzz_seed() * 1000 + 73 + plain);
    Counts counts;
    for (int i = 0; i < oracle::fuzz(500); ++i) {
      const PlaneScene s = random_plane_scene(random, plain);
      const Mesh mesh = s.mesh();
      const std::vector<Case> cases = cases_of(s);
      const StepResult r = compute_collision_free_stepsize(mesh, s.x_t0, s.x_t1, s.options);
      check_step(r, cases, random, counts);
      check_first(r, cases, construct_active_set(mesh, s.x_t0, s.x_t1, s.options));
      bool free = true;
      for (const Case& c : cases) free = free && (!c.contact() || c.parts());
      CHECK(is_step_collision_free(mesh, s.x_t0, s.x_t1, s.options) == free);
      const Candidates all = compute_candidates(mesh, s.x_t0, s.x_t1, s.options);
      const StepResult listed = compute_collision_free_stepsize(mesh, all, s.x_t0, s.x_t1, s.options);
      CHECK((listed.step == r.step && listed.toi == r.toi && listed.outcome == r.outcome));
    }
    std::printf("%s sizes: %lld steps, %lld of 0, %lld promises broken\n", plain ? "plain" : "all",
                counts.steps, counts.stopped, counts.broken);
    CHECK(counts.broken == 0);
    CHECK(counts.stopped < counts.steps);
  }
}

// Positions as large as they may be, before a plane that is as far as doubles go: n.x - offset overflows, or
// just does not.
TEST_CASE("steps towards planes are free where heights overflow", "[planes][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 77);
  Counts counts;
  int infinite = 0;
  for (int i = 0; i < oracle::fuzz(500); ++i) {
    const PlaneScene s = plane_scene_at_the_largest_numbers(random);
    const std::vector<Case> cases = cases_of(s);
    const Plane& n = s.rules.planes[0];
    const Eigen::RowVector3d x = s.x_t0.row(0);
    infinite += std::isinf(n.normal[0] * x[0] + n.normal[1] * x[1] + n.normal[2] * x[2] - n.offset);
    check_set(s, cases, counts);
    const StepResult r = compute_collision_free_stepsize(s.mesh(), s.x_t0, s.x_t1, s.options);
    check_step(r, cases, random, counts);
    check_first(r, cases, construct_active_set(s.mesh(), s.x_t0, s.x_t1, s.options));
  }
  std::printf("largest numbers: %lld steps, %lld of 0, %d from infinity, %lld promises broken\n",
              counts.steps, counts.stopped, infinite, counts.broken);
  CHECK(counts.broken == 0);
  CHECK(infinite > counts.steps / 8);
}

TEST_CASE("a vertex whose height overflows hides no other that comes within the separation first",
          "[planes][property]") {
  PlaneScene s;
  const double n = std::nextafter(2.0, 0.0);
  s.rules.planes.push_back({{n, n, n}, -0x1.4000000003512p+1023});
  s.options.norm = Norm::maximum, s.options.min_separation = 0x1p1020;
  const Eigen::RowVector3d x(0x1.fffffffffe532p+1019, 0x1.fffffffff5c6fp+1019, 0x1.fffffffff15ccp+1019);
  s.x_t0.resize(2, 3), s.x_t1.resize(2, 3);
  s.x_t0 << x, 0.5 * x;
  s.x_t1 << -x, -x;
  const StepResult r = compute_collision_free_stepsize(s.mesh(), s.x_t0, s.x_t1, s.options);
  check_first(r, cases_of(s), construct_active_set(s.mesh(), s.x_t0, s.x_t1, s.options));
  REQUIRE(r.limiting);
  CHECK((r.limiting->a == 1 && r.toi > 0.77 && r.toi < 0.78));
}

TEST_CASE("a line search keeps a share of what vertices have above planes", "[planes][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 75);
  Counts counts;
  for (int i = 0; i < oracle::fuzz(300); ++i) {
    PlaneScene s = random_plane_scene(random, scenes::coin(random));
    LineSearchOptions o = s.options;
    o.gap_share = scenes::uniform(random, 0, 0.9);
    const Eigen::MatrixXd dx = s.x_t1 - s.x_t0;
    s.x_t1 = s.x_t0 + dx;
    const LineSearch search(s.mesh(), s.x_t0, dx, o);
    const LineSearchStep r = search.largest_step();
    const std::vector<Case> cases = cases_of(s);
    check_step(r, cases, random, counts);
    CHECK((r.gap_share <= o.gap_share && r.gap_share_reduced == (r.gap_share < o.gap_share)));
    if (s.options.min_separation > 0 || r.step == 0) continue;
    for (const Case& c : cases) {
      if (c.start() <= 0) continue;
      for (int how = 0; how < 3; ++how)
        CHECK(c.truth.value(stored(c, how, r.step)) >= Rational(r.gap_share) * c.way.start);
    }
  }
  std::printf("%lld steps of a line search, %lld of 0, %lld promises broken\n", counts.steps, counts.stopped,
              counts.broken);
  CHECK(counts.broken == 0);
}

// The second vertex ends the step soon, while the first slides, and rises by little more than rounding.
TEST_CASE("a share of a gap of a few roundings is kept, or is said to be less", "[planes][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 78);
  int kept = 0, broken = 0;
  for (int i = 0; i < oracle::fuzz(5000); ++i) {
    PlaneScene s;
    s.x_t0.resize(2, 3), s.x_t1.resize(2, 3);
    for (int a = 0; a < 3; ++a) s.x_t0(0, a) = scenes::uniform(random, 0.5, 1);
    s.x_t0.row(1) << 50, 50, 0;
    const double f = s.x_t0.row(0).sum(), a = scenes::uniform(random, -0.5, 0.5),
                 b = scenes::uniform(random, -0.5, 0.5);
    s.rules.planes = {{{1, 1, 1}, f - scenes::uniform(random, 60, 80) * 0x1p-52 * f}, {{0, 0, 1}, -100}};
    Eigen::MatrixXd dx = Eigen::MatrixXd::Zero(2, 3);
    dx.row(0) << a, b, scenes::uniform(random, 1, 3) * 0x1p-44 - a - b;
    dx(1, 2) = -150;
    s.x_t1 = s.x_t0 + dx;
    LineSearchOptions o;
    o.gap_share = 1 - scenes::power_of_ten(random, -6, -1);
    const LineSearchStep r = LineSearch(s.mesh(), s.x_t0, dx, o).largest_step();
    if (r.step == 0) continue;
    const Case c(s, 0, 0);
    ++kept;
    for (int how = 0; how < 3; ++how)
      broken += c.truth.value(stored(c, how, r.step)) < Rational(r.gap_share) * c.way.start;
  }
  CHECK(kept > oracle::fuzz(5000) / 8);
  CHECK(broken == 0);
}
