// The kernel text for AVX2; compiled with -mavx2, entered only where the processor has it.
#define ONSET_KERNEL avx2
#include "narrowphase/kernel/kernel_text.inl"

namespace onset {
const KernelTable& avx2_kernels() {
  static const KernelTable table{"avx2",
                                 avx2::cull_vertex_face,
                                 avx2::cull_edge_edge,
                                 avx2::advance_vertex_face,
                                 avx2::advance_edge_edge,
                                 avx2::certify_vertex_face,
                                 avx2::certify_edge_edge,
                                 avx2::frames_vertex_face,
                                 avx2::frames_edge_edge,
                                 avx2::look_vertex_face,
                                 avx2::look_edge_edge};
  return table;
}
}  // namespace onset
