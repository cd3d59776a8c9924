#include "tests/mpi/memory.hpp"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

thread_local long fails_at = 0;
std::atomic<std::int64_t> held{0}, most{0};

void* noted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  const std::int64_t now = held += std::int64_t(malloc_usable_size(p));
  std::int64_t before = most;
  while (now > before && !most.compare_exchange_weak(before, now)) {
  }
  return p;
}
void let_fail() {
  if (fails_at > 0 && --fails_at == 0) throw std::bad_alloc();
}
void forget(void* p) noexcept {
  if (p != nullptr) held -= std::int64_t(malloc_usable_size(p));
  std::free(p);
}

}  // namespace

// Replaced for the whole program.
void* operator new(std::size_t size) {
  let_fail();
  return noted(std::malloc(size == 0 ? 1 : size));
}
void* operator new(std::size_t size, std::align_val_t align) {
  let_fail();
  const std::size_t a = std::size_t(align);
  return noted(std::aligned_alloc(a, (size + a - 1) / a * a + (size == 0 ? a : 0)));
}
void operator delete(void* p) noexcept { forget(p); }
void operator delete(void* p, std::size_t) noexcept { forget(p); }
void operator delete(void* p, std::align_val_t) noexcept { forget(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { forget(p); }

namespace onset::tests {

MemoryUse::MemoryUse() : before_(held) { most = before_; }
std::int64_t MemoryUse::peak() const { return most - before_; }
void fail_at_allocation(long n) { fails_at = n; }

}  // namespace onset::tests
