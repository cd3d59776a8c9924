#include "base/dispatch.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace onset {

namespace {

Kernel from_environment() {
  const char* value = std::getenv("ONSET_KERNEL");
  const std::string name = value == nullptr ? "" : value;
  if (name.empty() || name == "automatic") return Kernel::automatic;
  if (name == "scalar") return Kernel::scalar;
  if (name == "avx2") return Kernel::avx2;
  throw std::invalid_argument("ONSET_KERNEL=" + name + ": expected scalar, avx2 or automatic");
}

}  // namespace

bool has_avx2() {
#ifdef ONSET_HAVE_AVX2
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

Kernel resolve_kernel(Kernel requested) {
  const Kernel kernel = requested == Kernel::automatic ? from_environment() : requested;
  switch (kernel) {
    case Kernel::scalar:
      return Kernel::scalar;
    case Kernel::avx2:
      if (!has_avx2()) throw std::invalid_argument("kernel avx2: not supported by this processor or build");
      return Kernel::avx2;
    case Kernel::automatic:
      return has_avx2() ? Kernel::avx2 : Kernel::scalar;
  }
  throw std::invalid_argument("kernel " + std::to_string(int(kernel)) + ": unknown");
}

const char* kernel_name(Kernel kernel) {
  switch (kernel) {
    case Kernel::scalar:
      return "scalar";
    case Kernel::avx2:
      return "avx2";
    default:
      return "automatic";
  }
}

}  // namespace onset
