// The kernel text for AVX-512, in packs of twice as many lanes; compiled with flags of its own, entered only
// where the processor and its system have it.
#define ONSET_ISA avx512
#define ONSET_WIDE_PACKS
#include "narrowphase/kernel/kernel_text.inl"

namespace onset {
const KernelTable& avx512_kernels() {
  static const KernelTable table{"avx512",
                                 {avx512::kKernels<3>, avx512::kKernels<4>, avx512::kKernelsInPlane}};
  return table;
}
}  // namespace onset
