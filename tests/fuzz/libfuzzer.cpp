// A target as libFuzzer calls it.
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string broken = onset::fuzz::run_target(data, size);
  if (broken.empty()) return 0;
  std::fprintf(stderr, "%s: %s\n", onset::fuzz::kTarget, broken.c_str());
  std::abort();
}
