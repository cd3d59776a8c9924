#include "base/instruction_set.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace onset {

namespace {

// Read once, as a host may change its environment while calls run. Never destroyed: calls may be made until
// the process ends.
const std::string& name_in_environment() {
  static const std::string& name = *[] {
    const char* value = std::getenv("ONSET_KERNEL");
    return new std::string(value == nullptr ? "" : value);
  }();
  return name;
}

InstructionSet from_environment() {
  const std::string& name = name_in_environment();
  if (name.empty() || name == "automatic") return InstructionSet::automatic;
  if (name == "scalar") return InstructionSet::scalar;
  if (name == "avx2") return InstructionSet::avx2;
  if (name == "avx512") return InstructionSet::avx512;
  throw std::invalid_argument("ONSET_KERNEL=" + name + ": expected scalar, avx2, avx512 or automatic");
}

}  // namespace

bool has_avx2() {
#ifdef ONSET_HAVE_AVX2
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

// __builtin_cpu_supports asks the processor, and XCR0 whether the system keeps the registers.
bool has_avx512() {
#ifdef ONSET_HAVE_AVX512
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
#else
  return false;
#endif
}

// The first processors with AVX-512, which lower their clock for wide registers, lack this part of it.
bool prefers_avx512() {
#ifdef ONSET_HAVE_AVX512
  return has_avx512() && __builtin_cpu_supports("avx512vbmi2");
#else
  return false;
#endif
}

InstructionSet resolve_instruction_set(InstructionSet requested) {
  const InstructionSet set = requested == InstructionSet::automatic ? from_environment() : requested;
  switch (set) {
    case InstructionSet::scalar:
      return InstructionSet::scalar;
    case InstructionSet::avx2:
      if (!has_avx2())
        throw std::invalid_argument("instruction set avx2: not supported by this processor or build");
      return InstructionSet::avx2;
    case InstructionSet::avx512:
      if (!has_avx512())
        throw std::invalid_argument("instruction set avx512: not supported by this processor or build");
      return InstructionSet::avx512;
    case InstructionSet::automatic:
      return prefers_avx512() ? InstructionSet::avx512
             : has_avx2()     ? InstructionSet::avx2
                              : InstructionSet::scalar;
  }
  throw std::invalid_argument("instruction set " + std::to_string(int(set)) + ": unknown");
}

const char* to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::scalar:
      return "scalar";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
    default:
      return "automatic";
  }
}

}  // namespace onset
