// Every call ends wherever time or the caller ends it, looks often enough at both, and goes back to no work
// that is thrown away. A clock that counts its looks stands for time, so that every run is the same.
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <onset/onset.hpp>
#include <string>
#include <thread>

#include "base/clock.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/found_pairs.hpp"
#include "src/shared/pair_list.hpp"
#include "src/shared/visit_pairs.hpp"
#include "tests/catch.hpp"
#include "tests/counted_clock.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using tests::CountedClock;

namespace {

constexpr std::int64_t kPairsALook = 1 << 14;
constexpr double kDHat = 0.1;

// Triangles that all go through one place: most boxes overlap, and few cells hold them.
struct Crowd {
  scenes::Scene scene;
  Mesh mesh;
  Eigen::MatrixXd dx;
  Candidates listed;
  ClosePairs close;

  explicit Crowd(int faces) : scene(make(faces)), mesh(scene.x_t0, scene.faces), dx(scene.x_t1 - scene.x_t0) {
    listed = compute_candidates(mesh, scene.x_t0, scene.x_t1);
    close = close_pairs(mesh, scene.x_t0, kDHat);
  }
  static scenes::Scene make(int faces) {
    scenes::Random random(17);
    scenes::Scene crowd = scenes::triangle_soup(faces, 1, 0, random);
    for (Eigen::Index f = 0; f < faces; ++f)
      for (Eigen::Index a = 0; a < 3; ++a)
        for (Eigen::Index k = 0; k < 3; ++k)
          crowd.x_t0(3 * f + k, a) = scenes::uniform(random, 0.2, 1) * (k == a ? -1 : 1);
    crowd.x_t1 = crowd.x_t0;
    scenes::shake(crowd, 0.05, random);
    return crowd;
  }
};

// What is compared of an answer: its outcome, and how much there is of it.
struct Answer {
  Outcome outcome;
  double amount;
  std::int64_t pairs = 0;  // looked at, where the call tells
};

struct Call {
  const char* name;
  std::function<Answer(const Crowd&, const Options&)> run;
};

const std::vector<Call>& calls() {
  static const std::vector<Call> all{
      {"compute_collision_free_stepsize",
       [](const Crowd& c, const Options& o) {
         const StepResult r = compute_collision_free_stepsize(c.mesh, c.scene.x_t0, c.scene.x_t1, o);
         return Answer{r.outcome, r.step, r.stats.candidates.total()};
       }},
      {"compute_collision_free_stepsize of a list",
       [](const Crowd& c, const Options& o) {
         const StepResult r =
             compute_collision_free_stepsize(c.mesh, c.listed, c.scene.x_t0, c.scene.x_t1, o);
         return Answer{r.outcome, r.step, r.stats.candidates.total()};
       }},
      {"construct_active_set",
       [](const Crowd& c, const Options& o) {
         const ActiveSet r = construct_active_set(c.mesh, c.scene.x_t0, c.scene.x_t1, o);
         return Answer{r.outcome, r.complete_until, r.stats.candidates.total()};
       }},
      {"compute_candidates",
       [](const Crowd& c, const Options& o) {
         const Candidates r = compute_candidates(c.mesh, c.scene.x_t0, c.scene.x_t1, o);
         return Answer{r.outcome, double(r.vertex_face.size() + r.edge_edge.size()), r.counts.total()};
       }},
      {"close_pairs",
       [](const Crowd& c, const Options& o) {
         const ClosePairs r = close_pairs(c.mesh, c.scene.x_t0, kDHat, o);
         return Answer{r.outcome, double(r.size())};
       }},
      {"LineSearch",
       [](const Crowd& c, const Options& o) {
         LineSearchOptions with = o;
         with.d_hat = kDHat;
         const LineSearch search(c.mesh, c.scene.x_t0, c.dx, with);
         const LineSearchStep r = search.largest_step();
         return Answer{r.outcome, r.step};
       }},
      {"truncate_step",
       [](const Crowd& c, const Options& o) {
         const TruncatedStep r = truncate_step(c.mesh, c.scene.x_t0, c.scene.x_t1, o);
         return Answer{r.outcome, r.kept};
       }},
      {"check",
       [](const Crowd& c, const Options& o) {
         const StartReport r = check(c.mesh, c.scene.x_t0, o);
         const std::size_t rows = r.intersections.size() + r.touching.size() + r.within_separation.size();
         return Answer{r.outcome, r.outcome == Outcome::free ? double(rows) : 0};
       }},
      {"intersections",
       [](const Crowd& c, const Options& o) {
         const Intersections r = intersections(c.mesh, c.scene.x_t0, o);
         return Answer{r.outcome, r.outcome == Outcome::free ? double(r.size()) : 0};
       }},
      {"compute_cfl_stepsize",
       [](const Crowd& c, const Options& o) {
         const StepResult r = compute_cfl_stepsize(c.mesh, c.scene.x_t0, c.scene.x_t1, c.close, o);
         return Answer{r.outcome,
                       r.outcome == Outcome::out_of_time || r.outcome == Outcome::cancelled ? 0 : r.step};
       }},
  };
  return all;
}

constexpr BroadPhaseMethod kMethods[] = {BroadPhaseMethod::bvh, BroadPhaseMethod::hash,
                                         BroadPhaseMethod::brute};

Options with(BroadPhaseMethod method) {
  Options o;
  o.threads = 1;
  o.broad_phase = method;
  return o;
}

bool same(const Answer& a, const Answer& b) { return a.outcome == b.outcome && a.amount == b.amount; }

}  // namespace

TEST_CASE("every call ends at whichever look its time is over, and the next one is as if it never ran",
          "[property]") {
  const Crowd crowd(30);
  const CountedClock clock;
  for (const Call& call : calls())
    for (const BroadPhaseMethod method : kMethods) {
      CAPTURE(call.name, int(method));
      Options o = with(method);
      crowd.mesh.release_memory();
      o.time_limit = 1e12;
      const std::int64_t before = clock.looks();
      const Answer whole = call.run(crowd, o);
      const std::int64_t looks = clock.looks() - before;
      REQUIRE(whole.outcome != Outcome::out_of_time);
      REQUIRE(looks > 20);
      bool ended = true;
      int tried = 0;
      for (std::int64_t n = 0; ended && n < 2 * looks; n += 1 + n / 6) {
        CAPTURE(n, looks);
        const bool on_what_is_kept = ++tried % 2 == 0;
        if (!on_what_is_kept) crowd.mesh.release_memory();
        o.time_limit = double(n);
        const Answer cut = call.run(crowd, o);
        ended = cut.outcome == Outcome::out_of_time;
        if (ended) CHECK(cut.amount == 0);
        // Half of its looks end it, and whatever they are for, a few that set clocks going.
        if (n < looks / 2 && !on_what_is_kept) CHECK(ended);
        // What a call leaves that was cut off, is good for the next one.
        o.time_limit = HUGE_VAL;
        if (tried % 4 < 2) CHECK(same(call.run(crowd, o), whole));
      }
      CHECK_FALSE(ended);
    }
}

TEST_CASE("every call tells its progress every few thousand pairs, and no more once it is cancelled",
          "[property]") {
  const Crowd crowd(150);
  const std::int64_t pairs = crowd.listed.counts.total();
  REQUIRE(pairs > 4 * kPairsALook);
  const CountedClock clock;
  for (const Call& call : calls())
    for (const BroadPhaseMethod method : kMethods) {
      CAPTURE(call.name, int(method));
      Options o = with(method);
      std::int64_t told = 0, last = std::numeric_limits<std::int64_t>::max();
      o.progress = [&](double) { return ++told < last; };
      crowd.mesh.release_memory();
      call.run(crowd, o);
      const std::int64_t all = told;
      const bool all_pairs =
          std::string(call.name) != "compute_cfl_stepsize" && std::string(call.name) != "intersections";
      CHECK(all >= (all_pairs ? pairs : std::int64_t(crowd.close.size())) / kPairsALook);
      for (last = 1; last < all; last = 3 * last + 1) {
        CAPTURE(last, all);
        told = 0;
        crowd.mesh.release_memory();
        const Answer cut = call.run(crowd, o);
        CHECK(cut.outcome == Outcome::cancelled);
        CHECK(told == last);
        CHECK(cut.amount == 0);
        CHECK(cut.pairs <= last * kPairsALook);
      }
    }
}

namespace {

// Pairs (i, j), a list of `count`.
PairList pairs_in_order(int count) {
  PairList list;
  for (int i = 0; i < count; ++i) list.of(PairKind::vertex_face).push_back({i / 1000, i % 1000});
  return list;
}

}  // namespace

TEST_CASE("what a cancelled search found is not put in order but for some of it", "[unit]") {
  const int count = 400000;
  const PairList list = pairs_in_order(count);
  const CountedClock clock;
  for (const int last : {1, 2, 300, 380, 100000}) {  // progress is told once a batch of 1024
    CAPTURE(last);
    std::int64_t told = 0, visited = 0, visited_then = 0, keys = 0;
    Options o;
    o.progress = [&](double) {
      visited_then = visited;
      return ++told < last;
    };
    Budget budget(o);
    in_arena(1, [&] {
      const auto gathered = gather<IdPair>(
          list, {PairKind::vertex_face}, std::size_t(count), budget,
          [&](PairKind, const IdPair* pairs, std::size_t n, std::vector<IdPair>& found) {
            visited += std::int64_t(n);
            found.insert(found.end(), pairs, pairs + n);
          },
          [&](const IdPair& p) {
            ++keys;
            return p;
          });
      const std::int64_t size = std::int64_t(gathered.found.size());
      const bool is_sorted =
          std::is_sorted(gathered.found.begin(), gathered.found.end(),
                         [](const IdPair& p, const IdPair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
      CHECK(is_sorted);
      CHECK_FALSE(gathered.too_many);
      CHECK(visited == visited_then);  // nothing after progress returned false
      if (last == 100000) {
        CHECK(size == count);
        CHECK(keys > 64 * std::int64_t(kRowsCutOff));
      } else {
        CHECK(budget.outcome() == Outcome::cancelled);
        CHECK(size == std::min(visited, std::int64_t(kRowsCutOff)));
        CHECK(keys <= 32 * std::int64_t(kRowsCutOff));  // however many were found
      }
    });
  }
}

TEST_CASE("of more pairs than are wanted the earliest are kept, in order, or some where the call is over",
          "[property]") {
  scenes::Random random(23);
  const std::size_t count = 150000;
  std::vector<FoundPair> all;
  for (std::size_t i = 0; i < count; ++i) {
    const PairKind kind = scenes::coin(random) ? PairKind::edge_edge : PairKind::vertex_face;
    const double toi = i % 3 == 0 ? 0.25 : scenes::unit(random);  // many at one time
    all.push_back({kind, {{int(i % 700), int(i)}, toi, toi, 0, PairOutcome::contact}});
  }
  const auto fill = [&](FoundPairs& found) {
    for (std::size_t first = 0; first < count; first += 1000)
      for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
        std::vector<PairResult> results;
        for (std::size_t i = first; i < std::min(first + 1000, count); ++i)
          if (all[i].kind == kind) results.push_back(all[i].result);
        found.add(kind, std::move(results));
      }
  };
  const auto id = [](const FoundPair& f) { return f.result.pair.b; };
  for (const std::size_t most : {std::size_t(1), std::size_t(100), std::size_t(40000), count - 1, count}) {
    CAPTURE(most);
    std::vector<FoundPair> expected = all;
    std::sort(expected.begin(), expected.end(), earlier);
    expected.resize(most);
    std::sort(expected.begin(), expected.end(), before);
    const CountedClock clock;
    Options o;
    o.time_limit = 1e12;
    Budget budget(o);
    FoundPairs found(most);
    fill(found);
    CHECK(found.too_many() == (count > most + most / 2 + 1024));
    const std::int64_t start = clock.looks();
    const std::vector<FoundPair> taken = found.take(budget);
    const std::int64_t looks = clock.looks() - start;
    CHECK(std::equal(taken.begin(), taken.end(), expected.begin(), expected.end(),
                     [&](const FoundPair& x, const FoundPair& y) { return id(x) == id(y); }));
    CHECK(looks > 100);
    for (std::int64_t n = 1; n < looks; n += 1 + n / 3) {
      Options limited;
      limited.time_limit = double(n);
      Budget short_budget(limited);
      FoundPairs more(most);
      fill(more);
      const std::vector<FoundPair> some = more.take(short_budget);
      CHECK(short_budget.outcome() == Outcome::out_of_time);
      CHECK(some.size() == std::min({most, count, kRowsCutOff}));
      CHECK(std::is_sorted(some.begin(), some.end(), before));
    }
  }
}

TEST_CASE("progress is told where it was not for ten milliseconds, and time is looked at between", "[unit]") {
  static double now;
  now = 0;
  time_source = [] { return now; };
  int told = 0;
  Options o;
  o.time_limit = 1;
  o.progress = [&](double) {
    now += 0.5;  // what the callback takes is not counted
    return ++told < 3;
  };
  Budget budget(o);
  const Stop stop = budget.stop(), interruption = budget.interruption();
  CHECK(told == 1);
  CHECK_FALSE(budget.spent());
  now += 0.009;
  CHECK_FALSE(stop.requested());
  CHECK(told == 1);
  now += 0.002;
  CHECK_FALSE(stop.requested());
  CHECK(told == 2);
  CHECK(stop.requested());  // 1.011 s
  CHECK((interruption.requested() && budget.interrupted()));
  CHECK(budget.outcome() == Outcome::out_of_time);
  CHECK(told == 2);
  time_source = steady_seconds;
  Options plain;
  plain.check_limit = 0;
  Budget checks(plain);
  checks.look_at_checks();
  CHECK((checks.spent() && !checks.interrupted()));
  CHECK(checks.stop().asked == nullptr);
}

TEST_CASE("no thread goes on, nor reports, once a callback has thrown", "[unit]") {
  const Crowd crowd(150);
  struct Enough {};
  for (const int threads : {1, 4}) {
    Options o;
    o.threads = threads;
    for (const Call& call : calls()) {
      std::atomic<bool> threw{false};
      std::atomic<int> late{0};
      o.progress = [&](double share) -> bool {
        late += threw;
        if (share == 0) return true;
        threw = true;
        throw Enough();
      };
      CAPTURE(call.name, threads);
      CHECK_THROWS_AS(call.run(crowd, o), Enough);
      CHECK(late == 0);
    }
    o.progress = nullptr;
    if (threads == 1) continue;
    // The first visitor throws while another thread is in the middle of its work, of which it does no more.
    // Until the exception has come down to the library, which takes as long as the machine is busy, others go
    // on: slowly, so that few of all visits can be meant.
    const Crowd many(600);
    o.broad_phase = BroadPhaseMethod::brute;
    std::atomic<int> visits{0};
    visit_candidates(
        many.mesh, many.scene.x_t0, many.scene.x_t1,
        [&](PairKind, const std::array<int, 2>*, std::size_t) { ++visits; }, o);
    REQUIRE(visits > 100 * threads);
    for (int round = 0; round < 5; ++round) {
      std::atomic<bool> threw{false};
      std::atomic<int> entered{0}, late{0};
      const Clock clock;
      const auto visit = [&](PairKind, const std::array<int, 2>*, std::size_t) {
        if (threw) ++late, std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (entered++ > 0) return;
        while (entered < 2 && clock.seconds() < 1) {
        }
        threw = true;
        throw Enough();
      };
      CHECK_THROWS_AS(visit_candidates(many.mesh, many.scene.x_t0, many.scene.x_t1, visit, o), Enough);
      CHECK(late <= 10 * threads);
    }
  }
}
