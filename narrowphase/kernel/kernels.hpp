// The copy of the kernel text that a call runs on.
#pragma once

#include "base/dispatch.hpp"
#include "narrowphase/kernel/kernel.hpp"

namespace onset {

inline const KernelTable& kernels_for(Kernel requested) {
#ifdef ONSET_HAVE_AVX2
  if (resolve_kernel(requested) == Kernel::avx2) return avx2_kernels();
#endif
  (void)requested;
  return scalar_kernels();
}

}  // namespace onset
