// The copy of the kernel text that a call runs on.
#pragma once

#include "base/instruction_set.hpp"
#include "narrowphase/kernel/kernel.hpp"

namespace onset {

inline const KernelTable& kernels_for(InstructionSet requested) {
#ifdef ONSET_HAVE_AVX2
  if (resolve_instruction_set(requested) == InstructionSet::avx2) return avx2_kernels();
#endif
  (void)requested;
  return scalar_kernels();
}

}  // namespace onset
