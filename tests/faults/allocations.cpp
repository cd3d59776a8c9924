#include "tests/faults/allocations.hpp"

#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

namespace onset::tests {
namespace {

std::atomic<std::int64_t> blocks{0}, bytes{0}, most_bytes{0}, count_{0}, first_failing{0}, last_failing{0};
std::atomic<bool> armed{false}, owner_waits{false}, failed_{false}, failed_elsewhere{false};
std::atomic<pthread_t> owner{};

bool fails() {
  if (!armed.load(std::memory_order_relaxed)) return false;
  const bool elsewhere = !pthread_equal(pthread_self(), owner);
  if (owner_waits && !elsewhere) {
    usleep(20);
    return false;
  }
  const std::int64_t k = ++count_;
  if (k < first_failing || k > last_failing) return false;
  if (elsewhere) failed_elsewhere = true;
  return failed_ = true;
}

// NaNs or zeros, in a sequence without a period: an answer that depends on what nobody wrote is another one
// the next time.
int what_was_there() {
  static std::atomic<std::uint64_t> calls{0};
  const std::uint64_t mixed = calls.fetch_add(1, std::memory_order_relaxed) * 0x9e3779b97f4a7c15;
  return mixed >> 63 != 0 ? 0xff : 0;
}

void* allocate(std::size_t size, std::size_t alignment) {
  if (fails()) return nullptr;
  if (size == 0) size = 1;
  void* const block = alignment == 0
                          ? std::malloc(size)
                          : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block != nullptr) {
    ++blocks;
    const std::int64_t now = bytes += std::int64_t(malloc_usable_size(block));
    for (std::int64_t most = most_bytes; now > most && !most_bytes.compare_exchange_weak(most, now);) {
    }
    std::memset(block, what_was_there(), size);
  }
  return block;
}
void* allocate_or_throw(std::size_t size, std::size_t alignment = 0) {
  void* const block = allocate(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void release(void* block) {
  if (block == nullptr) return;
  --blocks;
  bytes -= std::int64_t(malloc_usable_size(block));
  std::free(block);
}

}  // namespace

std::int64_t live_blocks() { return blocks; }
std::int64_t most_bytes_since() { return most_bytes.exchange(bytes); }
bool no_more_blocks_than(std::int64_t most) {
  for (int i = 0; i < 1000 && blocks > most; ++i) usleep(1000);
  return blocks <= most;
}

FailingAllocations::FailingAllocations(std::int64_t k, Shortage shortage) {
  count_ = 0;
  failed_ = failed_elsewhere = false;
  owner = pthread_self();
  first_failing = k == 0 ? INT64_MAX : k;
  last_failing = shortage == Shortage::lasting ? INT64_MAX : k;
  owner_waits = shortage == Shortage::elsewhere;
  armed = true;
}
FailingAllocations::~FailingAllocations() { armed = false; }
std::int64_t FailingAllocations::count() const { return count_; }
bool FailingAllocations::failed() const { return failed_; }
bool FailingAllocations::failed_on_other_thread() const { return failed_elsewhere; }

}  // namespace onset::tests

using onset::tests::allocate;
using onset::tests::allocate_or_throw;
using onset::tests::release;

void* operator new(std::size_t size) { return allocate_or_throw(size); }
void* operator new[](std::size_t size) { return allocate_or_throw(size); }
void* operator new(std::size_t size, std::align_val_t a) { return allocate_or_throw(size, std::size_t(a)); }
void* operator new[](std::size_t size, std::align_val_t a) { return allocate_or_throw(size, std::size_t(a)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 0); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 0); }
void* operator new(std::size_t size, std::align_val_t a, const std::nothrow_t&) noexcept {
  return allocate(size, std::size_t(a));
}
void* operator new[](std::size_t size, std::align_val_t a, const std::nothrow_t&) noexcept {
  return allocate(size, std::size_t(a));
}

void operator delete(void* block) noexcept { release(block); }
void operator delete[](void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete(void* block, std::align_val_t, const std::nothrow_t&) noexcept { release(block); }
void operator delete[](void* block, std::align_val_t, const std::nothrow_t&) noexcept { release(block); }
