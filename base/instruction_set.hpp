// The choice, at run time, of the instruction set that the kernels run on.
#pragma once

#include "onset/options.hpp"

namespace onset {

// Returns a set that is not `automatic`. For that the environment variable ONSET_KERNEL ("scalar", "avx2",
// "avx512", "automatic") decides where it is not empty, else the best that this machine has; it is read once
// in the life of the process. Throws std::invalid_argument naming an unknown ONSET_KERNEL, or a set that this
// machine or build cannot run.
InstructionSet resolve_instruction_set(InstructionSet requested);

// Says whether this build has the AVX2 kernels and this processor can run them.
bool has_avx2();
// The same of AVX-512, with the parts of it that its kernels use. Where it is there, so is AVX2.
bool has_avx512();
// Says whether `automatic` is AVX-512: not on processors before Ice Lake and Zen 4, which lower their clock
// for wide registers.
bool prefers_avx512();

// Says whether a kernel that has no AVX-512 copy runs its AVX2 copy.
inline bool runs_avx2(InstructionSet resolved) { return resolved != InstructionSet::scalar; }

const char* to_string(InstructionSet set);

}  // namespace onset
