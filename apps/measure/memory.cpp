#include "measure/memory.hpp"

#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace app {
namespace {

// A line of /proc/self/status, "VmHWM:   1234 kB", in bytes; -1 without it.
std::int64_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name + ":") {
      std::int64_t kilobytes = 0;
      return status >> kilobytes ? 1024 * kilobytes : -1;
    }
  return -1;
}

// Sets the peak to what is resident now.
bool reset_peak() {
  std::ofstream clear("/proc/self/clear_refs");
  return bool(clear << "5" << std::flush);
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

std::optional<std::int64_t> peak_bytes(const std::function<void()>& work) {
  return_freed_memory();
  const bool can_tell = reset_peak();
  const std::int64_t before = status_bytes("VmRSS");
  work();
  const std::int64_t peak = status_bytes("VmHWM");
  if (!can_tell || before < 0 || peak < before) return std::nullopt;
  return peak - before;
}

}  // namespace app
