// At every report of progress of every call: it is cancelled, an exception leaves it, other calls are made
// inside it. The call ends as promised, nothing leaks, and later answers are the same.
#include <tbb/global_control.h>

#include <atomic>

#include "tests/catch.hpp"
#include "tests/faults/allocations.hpp"
#include "tests/faults/watchdog.hpp"
#include "tests/src/support/every_call.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

std::vector<Call> reporting_calls() {
  std::vector<Call> calls;
  for (const Call& call : every_call())
    if (call.reports) calls.push_back(call);
  return calls;
}

// f(call, subject, threads)
template <class F>
void for_all_reporting(F&& f) {
  for (const Subject& subject : small_subjects())
    for (const int threads : {1, 4})
      for (const Call& call : reporting_calls()) f(call, subject, threads);
}

// How often a call reports.
int reports(const Call& call, const Subject& subject, int threads) {
  std::atomic<int> calls{0};
  Options options;
  options.threads = threads;
  options.progress = [&](double) { return ++calls > 0; };
  call(subject.mesh(), subject, options);
  return calls;
}

// What a call that only says yes or no says where it does not know.
bool is_safe_answer(const Call& call, const Answer& answer) {
  const bool asks_for_free = std::string(call.name).rfind("is_step_collision_free", 0) == 0;
  return answer == Answer().add(!asks_for_free);
}

struct Enough {
  int at;
};

}  // namespace

TEST_CASE("a call may be cancelled at every report", "[faults]") {
  int cancelled = 0;
  for_all_reporting([&](const Call& call, const Subject& subject, int threads) {
    const Answer expected = call(subject.mesh(), subject, {});
    const int all = reports(call, subject, threads);
    REQUIRE(all > 0);
    for (int stop = 1; stop <= all; ++stop) {
      CAPTURE(subject.name, call.name, threads, stop, all);
      const Watchdog watchdog(call.name);
      const std::int64_t before = live_blocks();
      {
        const Mesh mesh = subject.mesh();
        Options options;
        options.threads = threads;
        std::atomic<int> calls{0};
        options.progress = [&](double) { return ++calls < stop; };
        const Answer answer = call(mesh, subject, options);
        if (calls < stop) {  // threads share out the work differently
          REQUIRE(answer == expected);
        } else if (answer.outcome) {
          REQUIRE(answer.outcome == Outcome::cancelled);
          REQUIRE((!answer.step || answer.step == 0 || call.name == std::string("compute_cfl_stepsize")));
          ++cancelled;
        } else {
          REQUIRE(is_safe_answer(call, answer));
        }
        options.progress = nullptr;
        REQUIRE(call(mesh, subject, options) == expected);
      }
      REQUIRE(no_more_blocks_than(before));
    }
  });
  std::printf("%d calls cancelled\n", cancelled);
  CHECK(cancelled > 200);
}

TEST_CASE("an exception may leave a call at every report", "[faults]") {
  int thrown = 0;
  for_all_reporting([&](const Call& call, const Subject& subject, int threads) {
    const Answer expected = call(subject.mesh(), subject, {});
    const int all = reports(call, subject, threads);
    for (int stop = 1; stop <= all; ++stop) {
      CAPTURE(subject.name, call.name, threads, stop, all);
      const Watchdog watchdog(call.name);
      const std::int64_t before = live_blocks();
      {
        const Mesh mesh = subject.mesh();
        Options options;
        options.threads = threads;
        std::atomic<int> calls{0};
        options.progress = [&](double) {
          if (++calls == stop) throw Enough{stop};
          return true;
        };
        int at = 0;
        Answer answer;
        try {
          call.ask(mesh, subject, options, answer);
        } catch (const Enough& e) {
          at = e.at;
        }
        REQUIRE((at == stop || (calls < stop && answer == expected)));
        thrown += at == stop;
        options.progress = nullptr;
        REQUIRE(call(mesh, subject, options) == expected);
      }
      REQUIRE(no_more_blocks_than(before));
    }
  });
  std::printf("%d exceptions left a call\n", thrown);
  CHECK(thrown > 200);
}

TEST_CASE("a report may make any other call, on the same mesh and on another", "[faults]") {
  const std::vector<Subject> subjects = small_subjects();
  const std::vector<Call>& calls = every_call();
  std::vector<std::vector<Answer>> expected;
  for (const Subject& subject : subjects) {
    expected.emplace_back();
    for (const Call& call : calls) expected.back().push_back(call(subject.mesh(), subject, {}));
  }
  std::size_t next = 0;
  int made = 0;
  for (std::size_t outer = 0; outer < subjects.size(); ++outer)
    for (const int threads : {1, 4})
      for (const int inner_threads : {0, 1, 4})
        for (const bool same : {true, false})
          for (std::size_t i = 0; i < calls.size(); ++i) {
            if (!calls[i].reports) continue;
            CAPTURE(subjects[outer].name, calls[i].name, threads, inner_threads, same);
            const Watchdog watchdog(calls[i].name);
            const std::size_t inner = same ? outer : (outer + 1) % subjects.size();
            const Mesh mesh = subjects[outer].mesh(), other = same ? mesh : subjects[inner].mesh();
            std::vector<const char*> differing;
            Options options;
            options.threads = threads;
            options.progress = [&](double) {
              const std::size_t k = next++ % calls.size();
              Options o;
              o.threads = inner_threads;
              o.progress = [](double) { return true; };
              if (calls[k](other, subjects[inner], o) != expected[inner][k])
                differing.push_back(calls[k].name);
              ++made;
              return true;
            };
            const Answer answer = calls[i](mesh, subjects[outer], options);
            REQUIRE(answer == expected[outer][i]);
            REQUIRE(differing.empty());
          }
  std::printf("%d calls made inside of others\n", made);
  CHECK(made > 1000);
}
