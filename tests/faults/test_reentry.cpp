// A thread that is inside a call takes on no other work of its host's arena: a host that holds a lock around
// a call, or keeps something of its own for each thread, does not find itself there again.
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <atomic>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/src/support/every_call.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// So many that some are always interrupted with a part of a loop in hand.
const tbb::global_control many_workers(tbb::global_control::max_allowed_parallelism, 16);

thread_local bool inside = false;

// How often a thread that is inside of f is given another task, which calls it again. There are enough tasks
// for some to be waiting while a thread waits for the end of a loop that others have a part of.
template <class F>
int entered_again(int tasks, const F& f) {
  std::atomic<int> again{0};
  tbb::task_arena arena(16);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, tasks, 1),
        [&](const tbb::blocked_range<int>&) {
          again += inside;
          const bool before = inside;
          inside = true;
          f();
          inside = before;
        },
        tbb::simple_partitioner());
  });
  return again;
}

}  // namespace

TEST_CASE("a thread that waits inside a call does not enter another", "[faults]") {
  // Large enough for every loop and sort to be shared out.
  const Subject subject("spheres", scenes::sphere_onto_sphere(24, 36, 0.01, 0.2), {}, 0.002);
  for (const Call& call : every_call()) {
    const Answer expected = call(subject.mesh(), subject, {});
    std::atomic<int> other_bytes{0};
    const int again =
        entered_again(fuzz(40), [&] { other_bytes += call(subject.mesh(), subject, {}) != expected; });
    CAPTURE(call.name);
    CHECK(again == 0);
    CHECK(other_bytes == 0);
  }
}

// What has no options runs in the arena of its host.
TEST_CASE("neither does one that sorts edges or places", "[faults]") {
  const scenes::Scene scene = scenes::sphere(60, 80);
  int again = 0;
  for (int i = 0; i < fuzz(10); ++i) {
    again += entered_again(100, [&] { edge_list(scene.faces); });
    again += entered_again(100, [&] { duplicate_vertices(scene.x_t0); });
  }
  CHECK(again == 0);
}
