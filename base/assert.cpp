#include "base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace onset {

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "onset: assertion failed: %s (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace onset
