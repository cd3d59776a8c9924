// The copy of the kernel text that a call runs on.
#pragma once

#include "base/instruction_set.hpp"
#include "narrowphase/kernel/kernel.hpp"

namespace onset {

inline const KernelTable& kernels_for(InstructionSet requested) {
  const InstructionSet set = resolve_instruction_set(requested);
#ifdef ONSET_HAVE_AVX512
  if (set == InstructionSet::avx512) return avx512_kernels();
#endif
#ifdef ONSET_HAVE_AVX2
  if (set == InstructionSet::avx2) return avx2_kernels();
#endif
  (void)set;
  return scalar_kernels();
}

}  // namespace onset
