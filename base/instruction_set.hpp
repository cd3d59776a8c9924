// The choice, at run time, of the instruction set that the kernels run on.
#pragma once

#include "onset/options.hpp"

namespace onset {

// Returns scalar or avx2. For `automatic`, the environment variable ONSET_KERNEL ("scalar", "avx2",
// "automatic") decides where it is not empty, else the best that this machine has; it is read once in the
// life of the process. Throws std::invalid_argument naming an unknown ONSET_KERNEL, or a set that this
// machine or build cannot run.
InstructionSet resolve_instruction_set(InstructionSet requested);

// Says whether this build has the AVX2 kernels and this processor can run them.
bool has_avx2();

const char* to_string(InstructionSet set);

}  // namespace onset
