// Every budget tried down to nothing: a conservative answer, its own outcome, the same bytes where that is
// promised.
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <onset/onset.hpp>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using tests::same_bytes;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

struct Case {
  scenes::Scene scene = scenes::sphere_onto_sphere(16, 24, 0.01, 0.5);
  Mesh mesh{scene.x_t0, scene.faces};
  ActiveSet full = construct_active_set(mesh, scene.x_t0, scene.x_t1);
  StepResult step = compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1);

  ActiveSet active_set(const Options& o) const {
    return construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
  }
  StepResult step_with(const Options& o) const {
    return compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1, o);
  }
  LineSearchStep line_search(const Options& o) const {
    return LineSearch(mesh, scene.x_t0, Eigen::MatrixXd(scene.x_t1 - scene.x_t0), o).largest_step();
  }
  // Rows of the full set, and all of those before complete_until.
  void check_rows(const ActiveSet& set) const {
    std::size_t k = 0, before = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
      const bool here =
          k < set.size() && set[k].kind == full[i].kind && set[k].a == full[i].a && set[k].b == full[i].b;
      if (here) {
        CHECK(set[k].toi == full[i].toi);
        CHECK(set[k].normal == full[i].normal);
        ++k;
      } else if (full[i].toi < set.complete_until) {
        ++before;
      }
    }
    CHECK(k == set.size());
    CHECK(before == 0);
    CHECK(set.stats.contacts.total() == std::int64_t(set.size()));
  }
};

// All calls with a budget of nothing.
void check_spent(const Case& c, const Options& o, Outcome why) {
  CAPTURE(to_string(why));
  const StepResult step = c.step_with(o);
  CHECK(step.step == 0);
  CHECK(step.outcome == why);
  CHECK_FALSE(step.limiting);
  CHECK(step.stats.looked_at == 0);
  CHECK_FALSE(is_step_collision_free(c.mesh, c.scene.x_t0, c.scene.x_t0, o));
  const ActiveSet set = c.active_set(o);
  CHECK(set.size() == 0);
  CHECK(set.outcome == why);
  CHECK(set.complete_until == 0);
  const LineSearchStep search = c.line_search(o);
  CHECK(search.step == 0);
  CHECK(search.outcome == why);
  CHECK(search.stats.looked_at == 0);
}

}  // namespace

TEST_CASE("with no time at all nothing is certified", "[unit]") {
  const Case c;
  Options o;
  o.time_limit = 0;
  check_spent(c, o, Outcome::out_of_time);
  const Candidates pairs = compute_candidates(c.mesh, c.scene.x_t0, c.scene.x_t1, o);
  CHECK(pairs.outcome == Outcome::out_of_time);
  CHECK(pairs.vertex_face.empty());
}

TEST_CASE("with no checks at all nothing is certified", "[unit]") {
  Options o;
  o.check_limit = 0;
  check_spent(Case(), o, Outcome::out_of_checks);
}

TEST_CASE("a call cancelled before it begins certifies nothing", "[unit]") {
  const Case c;
  Options o;
  o.progress = [](double share) { return share > 0; };
  check_spent(c, o, Outcome::cancelled);
  CHECK(compute_candidates(c.mesh, c.scene.x_t0, c.scene.x_t1, o).outcome == Outcome::cancelled);
}

TEST_CASE("any time limit gives the whole answer or a conservative one", "[property]") {
  const Case c;
  bool spent = false, done = false;
  for (double limit = 1e-6; limit < 100 && !done; limit *= 2) {
    Options o;
    o.time_limit = limit;
    const StepResult step = c.step_with(o);
    done = step.outcome != Outcome::out_of_time;
    if (done)
      CHECK(same_bytes(step, c.step));
    else
      CHECK(step.step == 0);
    spent |= !done;
    const ActiveSet set = c.active_set(o);
    c.check_rows(set);
    CHECK((set.outcome == Outcome::out_of_time || same_bytes(set, c.full)));
    CHECK((set.complete_until == 0) == (set.outcome == Outcome::out_of_time));
  }
  CHECK((spent && done));
}

TEST_CASE("a budget of checks gives the same bytes for any number of threads", "[determinism]") {
  const Case c;
  int spent = 0, done = 0, partial = 0;
  for (std::int64_t limit = 1; limit < 1 << 30; limit *= 3) {
    Options o;
    o.check_limit = limit;
    o.threads = 1;
    const StepResult step = c.step_with(o);
    const ActiveSet set = c.active_set(o);
    CAPTURE(limit);
    c.check_rows(set);
    spent += set.outcome == Outcome::out_of_checks, done += set.outcome == Outcome::contact;
    partial += set.outcome == Outcome::out_of_checks && set.size() > 0;
    if (step.outcome == Outcome::out_of_checks)
      CHECK(step.step == 0);
    else
      CHECK(same_bytes(step, c.step));
    for (const int threads : {2, 4}) {
      o.threads = threads;
      CHECK(same_bytes(step, c.step_with(o)));
      const ActiveSet again = c.active_set(o);
      CHECK(same_bytes(set, again));
      CHECK(set.stats.checks == again.stats.checks);
      CHECK(set.stats.looked_at == again.stats.looked_at);
    }
  }
  CHECK((spent > 2 && done > 2 && partial > 0));
}

TEST_CASE("a memory limit keeps the earliest contacts, the same for any number of threads", "[determinism]") {
  const Case c;
  REQUIRE(c.full.size() > 100);
  for (const std::size_t rows : {std::size_t(0), std::size_t(1), std::size_t(7), c.full.size() / 2,
                                 c.full.size() - 1, c.full.size()}) {
    Options o;
    o.memory_limit = 256 * std::int64_t(rows) + 255;
    CAPTURE(rows, c.full.size());
    for (const double window : {HUGE_VAL, 0.01}) {
      o.window = window;
      o.threads = 1;
      const ActiveSet set = c.active_set(o);
      c.check_rows(set);
      if (std::isinf(window)) {
        CHECK(set.size() == rows);
        CHECK(set.outcome == (rows < c.full.size() ? Outcome::out_of_memory : Outcome::contact));
        CHECK(std::isinf(set.complete_until) == (rows == c.full.size()));
      }
      for (const int threads : {2, 4}) {
        o.threads = threads;
        const ActiveSet again = c.active_set(o);
        CHECK(same_bytes(set, again));
        CHECK(set.complete_until == again.complete_until);
      }
    }
    o = Options();
    o.memory_limit = 256 * std::int64_t(rows);
    CHECK(same_bytes(c.step_with(o), c.step));  // which keeps no pairs
  }
}

TEST_CASE("a line search without memory for its pairs gives the same answers", "[unit]") {
  const Case c;
  const Eigen::MatrixXd dx = c.scene.x_t1 - c.scene.x_t0;
  const LineSearch holds(c.mesh, c.scene.x_t0, dx);
  Options o;
  o.memory_limit = 100;
  const LineSearch finds(c.mesh, c.scene.x_t0, dx, o);
  CHECK(holds.candidates().total() > 100);
  CHECK(finds.candidates().total() == 0);
  for (const double upper : {1.0, 0.5, 0.01}) {
    const LineSearchStep a = holds.largest_step(upper), b = finds.largest_step(upper);
    CHECK(same_bytes(a, b));
    CHECK(a.gap_share == b.gap_share);
  }
}

TEST_CASE("candidates that would not fit are counted and not listed", "[unit]") {
  const Case c;
  const Candidates all = compute_candidates(c.mesh, c.scene.x_t0, c.scene.x_t1);
  Options o;
  o.memory_limit = 8 * all.counts.total();
  CHECK(compute_candidates(c.mesh, c.scene.x_t0, c.scene.x_t1, o).edge_edge == all.edge_edge);
  --o.memory_limit;
  const Candidates counted = compute_candidates(c.mesh, c.scene.x_t0, c.scene.x_t1, o);
  CHECK(counted.outcome == Outcome::out_of_memory);
  CHECK((counted.vertex_face.empty() && counted.edge_edge.empty()));
  CHECK(counted.counts.total() == all.counts.total());
}

TEST_CASE("progress goes from 0 to 1, and cancels wherever it says so", "[unit]") {
  const Case c;
  Options o;
  o.threads = 2;
  std::atomic<int> calls{0}, inside{0};
  double first = -1, last = 0;
  bool alone = true;
  o.progress = [&](double share) {
    alone = alone && inside++ == 0;
    if (first < 0) first = share;
    last = share;
    ++calls, --inside;
    return true;
  };
  CHECK(same_bytes(c.active_set(o), c.full));
  CHECK(first == 0);
  CHECK((last > 0.5 && last <= 1));
  CHECK(alone);
  const int all = calls;
  REQUIRE(all > 3);
  for (int stop = 1; stop < all; stop += 1 + all / 20) {
    calls = 0;
    o.progress = [&](double) { return ++calls < stop; };
    const ActiveSet set = c.active_set(o);
    if (set.outcome == Outcome::cancelled) c.check_rows(set);
    CHECK((set.outcome == Outcome::cancelled || calls < stop));
  }
  o.progress = [](double share) -> bool {
    if (share > 0) throw std::runtime_error("enough");
    return true;
  };
  CHECK_THROWS_AS(c.active_set(o), std::runtime_error);
}

TEST_CASE("budgets out of range are rejected", "[unit]") {
  const Case c;
  for (int i = 0; i < 6; ++i) {
    Options o;
    if (i == 0) o.window = -1;
    if (i == 1) o.window = NAN;
    if (i == 2) o.time_limit = -1;
    if (i == 3) o.time_limit = NAN;
    if (i == 4) o.check_limit = -1;
    if (i == 5) o.memory_limit = -1;
    CHECK_THROWS_AS(c.active_set(o), std::invalid_argument);
  }
}

TEST_CASE("the histogram counts every pair left by the culls, and the worst is one of them", "[unit]") {
  const Case c;
  const Stats& s = c.full.stats;
  std::int64_t pairs = 0, least = 0;
  for (std::size_t k = 0; k < s.checks_histogram.size(); ++k)
    pairs += s.checks_histogram[k], least += s.checks_histogram[k] << k;
  CHECK(pairs == s.after_culls.total());
  CHECK((least <= s.checks && s.checks < 2 * least));
  REQUIRE((s.worst && s.worst->a >= 0));
  Options o;
  o.threads = 1;
  const Stats again = c.active_set(o).stats;
  REQUIRE(again.worst);
  CHECK((again.worst->kind == s.worst->kind && again.worst->a == s.worst->a && again.worst->b == s.worst->b &&
         again.checks_histogram == s.checks_histogram));
  CHECK(s.looked_at == 1);
}

TEST_CASE("budgets of checks and of memory together give the same bytes for any number of threads",
          "[determinism]") {
  const scenes::Scene scene = scenes::sphere_onto_sphere(60, 90, 0.01, 0.8);
  const Mesh mesh(scene.x_t0, scene.faces);
  int partial = 0;
  for (const std::int64_t rows : {0, 20, 100, 500})
    for (const std::int64_t limit : {1000, 18900, 1 << 22}) {
      Options o;
      o.memory_limit = 256 * rows;
      o.check_limit = limit;
      o.threads = 1;
      const ActiveSet set = construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
      CAPTURE(rows, limit, set.size());
      partial += set.outcome == Outcome::out_of_checks && set.size() > 0;
      for (const int threads : {2, 4}) {
        o.threads = threads;
        const ActiveSet again = construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
        CHECK(same_bytes(set, again));
        CHECK(set.stats.checks == again.stats.checks);
      }
    }
  CHECK(partial > 0);
}
