// Every allocation of every call fails once, and then all from it on: the call throws std::bad_alloc, or ends
// with the same answer. Nothing hangs, leaks, or is left behind that changes a later answer.
//
// What fails is operator new of this program, of the library and of the C++ runtime in it, on every thread.
// Not tried are TBB's own allocations and Eigen's, which do not go through it.
#include <tbb/global_control.h>

#include <algorithm>
#include <new>
#include <random>

#include "tests/catch.hpp"
#include "tests/faults/allocations.hpp"
#include "tests/faults/watchdog.hpp"
#include "tests/fuzz.hpp"
#include "tests/src/support/every_call.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

// 1 to `count` and a little more, as other threads may make more: all of them, or the first of them and some
// of the others.
std::vector<std::int64_t> places_to_fail(std::int64_t count) {
  constexpr std::int64_t kSlack = 8;
  const std::int64_t first = fuzz(30), others = fuzz(25);
  std::vector<std::int64_t> all;
  for (std::int64_t k = 1; k <= std::min(first, count + kSlack); ++k) all.push_back(k);
  if (count + kSlack <= first + others) {
    for (std::int64_t k = first + 1; k <= count + kSlack; ++k) all.push_back(k);
    return all;
  }
  scenes::Random random{std::uint64_t(count)};
  for (std::int64_t i = 0; i < others; ++i)
    all.push_back(scenes::integer(random, int(first) + 1, int(count + kSlack)));
  return all;
}

struct Tally {
  std::int64_t thrown = 0, finished = 0, on_other_threads = 0;
};

// f(k-th allocation fails) must throw std::bad_alloc or give `expected`.
template <class F>
bool throws_or_gives(const Answer& expected, std::int64_t k, Shortage shortage, Tally& tally, F&& f) {
  Answer answer;
  bool threw = false, failed = false;
  {
    const FailingAllocations failing(k, shortage);
    try {
      f(answer);
    } catch (const std::bad_alloc&) {
      threw = true;
    }
    failed = failing.failed();
    tally.on_other_threads += failing.failed_on_other_thread();
  }
  tally.thrown += threw, tally.finished += failed && !threw;
  return threw ? failed : answer == expected;
}

// used: on a mesh that the same call has left its trees on.
void try_call(const Call& call, const Subject& subject, const Options& options, bool used, Tally& tally) {
  const Answer expected = call(subject.mesh(), subject, options);
  call(subject.mesh(), subject, options);
  std::int64_t count = 0;
  {
    const Mesh mesh = subject.mesh();
    if (used) call(mesh, subject, options);
    const FailingAllocations none(0, Shortage::once);
    call(mesh, subject, options);
    count = none.count();
  }
  for (const Shortage shortage : {Shortage::once, Shortage::lasting})
    for (const std::int64_t k : places_to_fail(count)) {
      CAPTURE(subject.name, call.name, options.threads, used, int(shortage), k, count);
      const std::int64_t before = live_blocks();
      {
        const Watchdog watchdog(call.name);
        const Mesh mesh = subject.mesh();
        if (used) call(mesh, subject, options);
        const auto ask = [&](Answer& answer) { call.ask(mesh, subject, options, answer); };
        REQUIRE(throws_or_gives(expected, k, shortage, tally, ask));
        REQUIRE(call(mesh, subject, options) == expected);
      }
      REQUIRE(no_more_blocks_than(before));
    }
}

}  // namespace

TEST_CASE("a failing allocation ends a call with std::bad_alloc, and nothing else", "[faults]") {
  Tally tally;
  for (const Subject& subject : small_subjects())
    for (const int threads : {1, 4})
      for (const Call& call : every_call()) {
        Options options;
        options.threads = threads;
        for (const bool used : {false, true}) try_call(call, subject, options, used, tally);
      }
  std::printf("%lld times memory ran out, %lld on other threads: %lld calls threw, %lld did without\n",
              static_cast<long long>(tally.thrown + tally.finished),
              static_cast<long long>(tally.on_other_threads), static_cast<long long>(tally.thrown),
              static_cast<long long>(tally.finished));
  CHECK(tally.thrown > 1000);
}

TEST_CASE("memory may run out on threads that the caller does not see", "[faults]") {
  const Subject subject = std::move(small_subjects().back());
  Tally tally;
  for (const Call& call : every_call()) {
    if (!call.reports) continue;
    Options options;
    options.threads = 4;
    const Answer expected = call(subject.mesh(), subject, options);
    for (int i = 0; i < fuzz(20); ++i) {
      CAPTURE(call.name, i);
      const Watchdog watchdog(call.name);
      const Mesh mesh = subject.mesh();
      const auto ask = [&](Answer& answer) { call.ask(mesh, subject, options, answer); };
      REQUIRE(throws_or_gives(expected, 1 + i % 5, Shortage::elsewhere, tally, ask));
      REQUIRE(call(mesh, subject, options) == expected);
    }
  }
  std::printf("%lld times memory ran out on other threads\n", static_cast<long long>(tally.on_other_threads));
  CHECK(tally.on_other_threads > 0);
}

TEST_CASE("the first call of so many threads may run out of memory, too", "[faults]") {
  const Subject subject = std::move(small_subjects().front());
  const Call& step = every_call().front();
  const Answer expected = step(subject.mesh(), subject, {});
  Tally tally;
  for (const Shortage shortage : {Shortage::once, Shortage::lasting})
    for (std::int64_t k = 1, threads = shortage == Shortage::once ? 100 : 400; k < 250; ++k, ++threads) {
      CAPTURE(k, threads);
      const Mesh mesh = subject.mesh();
      Options options;
      options.threads = int(threads);
      const auto ask = [&](Answer& answer) { step.ask(mesh, subject, options, answer); };
      REQUIRE(throws_or_gives(expected, k, shortage, tally, ask));
      REQUIRE(step(mesh, subject, options) == expected);
    }
  CHECK(tally.thrown > 50);
}

TEST_CASE("a mesh that cannot be changed for want of memory is as it was", "[faults]") {
  const std::vector<Subject> subjects = small_subjects();
  for (const Subject& s : subjects) {
    const Call& step = every_call().front();
    CollisionRules other;
    other.thickness.assign(std::size_t(s.scene.x_t0.rows()), 0x1p-12);
    std::vector<int> ids;
    for (int v = 0; v < s.scene.x_t0.rows(); ++v) ids.push_back(v + 1);
    const Answer rules = Answer().add(s.rules), other_rules = Answer().add(other);
    const Answer before = step(s.mesh(), s, {});
    for (const bool full : {false, true})
      for (std::int64_t k = 1, failed = 1; failed > 0; ++k) {
        CAPTURE(s.name, full, k);
        Mesh mesh = s.mesh();
        const Mesh copy = mesh;
        bool threw = false;
        {
          const FailingAllocations failing(k, Shortage::once);
          try {
            full ? mesh.set_full_vertices(ids, std::ptrdiff_t(ids.size()) + 1) : mesh.set_rules(other);
          } catch (const std::bad_alloc&) {
            threw = true;
          }
          failed = failing.failed();
        }
        REQUIRE((threw || k > 1));
        REQUIRE(Answer().add(mesh.rules()) == (threw || full ? rules : other_rules));
        REQUIRE(mesh.num_full_vertices() == mesh.num_vertices() + (full && !threw));
        if (threw || full) REQUIRE(step(mesh, s, {}) == before);
        REQUIRE(step(copy, s, {}) == before);
      }
  }
}

TEST_CASE("what is said to allocate nothing does not", "[faults]") {
  const Subject s = std::move(small_subjects().back());
  const Mesh mesh = s.mesh();
  Mesh from = s.mesh(), to;
  LineSearch line(mesh, s.scene.x_t0, s.dx), other;
  StepResult step = compute_collision_free_stepsize(mesh, s.scene.x_t0, s.scene.x_t1);
  ActiveSet set = s.set, taken;
  std::int64_t count = 0;
  {
    const FailingAllocations none_left(1, Shortage::lasting);
    const Positions x(s.scene.x_t0), dx(s.dx);
    safe_step(s.safe, dx);
    in_default_float_environment([&] { step.step = x(0, 0) / 3; });
    const Mesh copy = mesh;
    to = std::move(from);
    to = copy;
    other = std::move(line);
    other.candidates(), other.close_candidates();
    taken = std::move(set);
    taken.earliest(), to_string(taken.outcome);
    copy.num_bodies(), copy.full_dofs(s.set[0]), copy.rules(), copy.filter_counts();
    mesh.release_memory();
    count = none_left.count();
  }
  CHECK(count == 0);
}
