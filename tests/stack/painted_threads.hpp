// How deep threads go into their stacks: every thread that this program makes, and that libraries make in it,
// has a stack of ours, filled with a pattern.
#pragma once

#include <cstddef>
#include <functional>

// Only in optimised builds: others have frames several times as large, and sanitizers make threads their own
// way.
#if defined(__OPTIMIZE__) && defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ONSET_PAINTS_THREADS
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#undef ONSET_PAINTS_THREADS
#endif
#endif

namespace onset::tests {

// Runs f in a thread of its own. Returns how many bytes of its stack were written to.
std::size_t stack_used_by(const std::function<void()>& f);

// The most bytes that any other thread has written to so far, and how many threads there are.
struct WorkerStacks {
  std::size_t used = 0;
  int threads = 0;
};
WorkerStacks stacks_of_workers();

}  // namespace onset::tests
