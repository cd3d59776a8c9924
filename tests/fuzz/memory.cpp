// With glibc these stand before its own, for the whole program: what is asked for counts, not what is
// touched, for pages that are never written would hide a count that a file only claims.
#include "tests/fuzz/memory.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define ONSET_NOT_COUNTED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ONSET_NOT_COUNTED
#endif
#endif

static std::atomic<std::size_t> held{0}, most_held{0};

#ifndef ONSET_NOT_COUNTED
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

static void* counted(void* p) {
  if (!p) return p;
  const std::size_t now = held += malloc_usable_size(p);
  if (now > most_held) most_held = now;
  return p;
}

extern "C" {
void* malloc(std::size_t size) { return counted(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return counted(__libc_calloc(count, size)); }
void* realloc(void* p, std::size_t size) {
  const std::size_t before = p ? malloc_usable_size(p) : 0;
  void* r = __libc_realloc(p, size);
  if (r || size == 0) held -= before;
  return counted(r);
}
void* memalign(std::size_t alignment, std::size_t size) { return counted(__libc_memalign(alignment, size)); }
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** p, std::size_t alignment, std::size_t size) {
  *p = memalign(alignment, size);
  return *p ? 0 : ENOMEM;
}
void free(void* p) {
  if (p) held -= malloc_usable_size(p);
  __libc_free(p);
}
}
#endif

namespace onset::fuzz {

MemoryWatch::MemoryWatch() : before_(held) { most_held = before_; }
std::size_t MemoryWatch::most() const { return most_held - before_; }

}  // namespace onset::fuzz
