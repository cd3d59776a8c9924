// The kernel text for any processor.
#define ONSET_ISA scalar
#include "narrowphase/kernel/kernel_text.inl"

namespace onset {
const KernelTable& scalar_kernels() {
  static const KernelTable table{"scalar",
                                 {scalar::kKernels<3>, scalar::kKernels<4>, scalar::kKernelsInPlane}};
  return table;
}
}  // namespace onset
