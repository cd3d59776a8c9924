#include "tests/stack/painted_threads.hpp"

#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

namespace onset::tests {
namespace {

constexpr std::size_t kBytes = std::size_t(1) << 19;
using Word = std::uint64_t;
constexpr std::size_t kWords = kBytes / sizeof(Word);
constexpr Word kPaint = 0xa55aa55aa55aa55a;

// A stack, which grows downward from its end.
struct Stack {
  Stack() {
    void* got = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (got == MAP_FAILED) std::abort();
    begin = static_cast<Word*>(got);
    std::fill(begin, begin + kWords, kPaint);
  }
  std::size_t used() const {
    return std::size_t(begin + kWords -
                       std::find_if(begin, begin + kWords, [](Word w) { return w != kPaint; })) *
           sizeof(Word);
  }
  void paint_again() { std::fill(begin + kWords - used() / sizeof(Word), begin + kWords, kPaint); }

  Word* begin;
};

std::mutex mutex;
std::vector<std::unique_ptr<Stack>>& worker_stacks() {
  static auto& all = *new std::vector<std::unique_ptr<Stack>>;
  return all;
}
thread_local Stack* next_stack = nullptr;  // for the thread that this one makes now

}  // namespace

std::size_t stack_used_by(const std::function<void()>& f) {
  static Stack& stack = *new Stack;
  stack.paint_again();
  next_stack = &stack;
  struct Task {
    const std::function<void()>& f;
    std::exception_ptr error;
  } task{f, nullptr};
  pthread_t thread;
  const int failed = pthread_create(
      &thread, nullptr,
      [](void* context) -> void* {
        Task& t = *static_cast<Task*>(context);
        try {
          t.f();
        } catch (...) {
          t.error = std::current_exception();
        }
        return nullptr;
      },
      &task);
  next_stack = nullptr;
  if (failed != 0) std::abort();
  pthread_join(thread, nullptr);
  if (task.error) std::rethrow_exception(task.error);
  return stack.used();
}

WorkerStacks stacks_of_workers() {
  const std::lock_guard<std::mutex> lock(mutex);
  WorkerStacks r;
  for (const auto& stack : worker_stacks()) r.used = std::max(r.used, stack->used());
  r.threads = int(worker_stacks().size());
  return r;
}

}  // namespace onset::tests

#ifdef ONSET_PAINTS_THREADS
// Takes the place of the system's, in this program and in the libraries that it loads.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* wanted, void* (*run)(void*),
                              void* context) {
  using namespace onset::tests;
  static const auto create = reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  Stack* stack = next_stack;
  if (stack == nullptr) {
    const std::lock_guard<std::mutex> lock(mutex);
    worker_stacks().push_back(std::make_unique<Stack>());
    stack = worker_stacks().back().get();
  }
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  if (int detached = 0; wanted != nullptr && pthread_attr_getdetachstate(wanted, &detached) == 0)
    pthread_attr_setdetachstate(&attributes, detached);
  pthread_attr_setstack(&attributes, stack->begin, kBytes);
  const int status = create(thread, &attributes, run, context);
  pthread_attr_destroy(&attributes);
  return status;
}
#endif
