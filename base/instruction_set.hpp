// Which instruction set a kernel runs on, picked once at run time.
#pragma once

#include "onset/options.hpp"

namespace onset {

// Resolves to scalar or avx2. automatic: the environment variable ONSET_KERNEL ("scalar", "avx2" or
// "automatic") where it is set and not empty, else the best this machine has. Throws std::invalid_argument
// naming an unknown ONSET_KERNEL, or a kernel that this machine or build cannot run.
InstructionSet resolve_instruction_set(InstructionSet requested);

bool has_avx2();

const char* to_string(InstructionSet set);

}  // namespace onset
