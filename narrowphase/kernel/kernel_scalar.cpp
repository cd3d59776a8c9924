// The kernel text for any processor.
#define ONSET_KERNEL scalar
#include "narrowphase/kernel/kernel_text.inl"

namespace onset {
const KernelTable& scalar_kernels() {
  static const KernelTable table{"scalar",
                                 scalar::cull_vertex_face,
                                 scalar::cull_edge_edge,
                                 scalar::advance_vertex_face,
                                 scalar::advance_edge_edge,
                                 scalar::certify_vertex_face,
                                 scalar::certify_edge_edge,
                                 scalar::frames_vertex_face,
                                 scalar::frames_edge_edge,
                                 scalar::look_vertex_face,
                                 scalar::look_edge_edge};
  return table;
}
}  // namespace onset
