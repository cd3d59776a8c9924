// The kernel text for AVX2; compiled with -mavx2, entered only where the processor has it.
#define ONSET_ISA avx2
#include "narrowphase/kernel/kernel_text.inl"

namespace onset {
const KernelTable& avx2_kernels() {
  static const KernelTable table{"avx2", {avx2::kKernels<3>, avx2::kKernels<4>, avx2::kKernelsInPlane}};
  return table;
}
}  // namespace onset
