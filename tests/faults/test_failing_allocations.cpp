// Every allocation of every call fails once, and then all from it on: the call throws std::bad_alloc, or ends
// with the same answer. Nothing hangs, leaks, or is left behind that changes a later answer.
//
// What fails is operator new of this program, of the library and of the C++ runtime in it, on every thread.
// Not tried are TBB's own allocations and Eigen's, which do not go through it.
#include <tbb/global_control.h>

#include <new>

#include "tests/catch.hpp"
#include "tests/faults/allocations.hpp"
#include "tests/src/support/every_call.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

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

}  // namespace

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
