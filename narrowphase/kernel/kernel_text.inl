// The whole kernel text, in the order it builds up; included once per instruction set by kernel_scalar.cpp and kernel_avx2.cpp.
#include "base/pack.hpp"
#include "narrowphase/kernel/kernel.hpp"

namespace onset {
namespace ONSET_KERNEL {
namespace {

#include "narrowphase/kernel/direction.inl"

#include "narrowphase/kernel/maximum_norm.inl"

#include "narrowphase/kernel/certificates.inl"

#include "narrowphase/kernel/gather.inl"

#include "narrowphase/kernel/state.inl"

#include "narrowphase/kernel/advance.inl"

#include "narrowphase/kernel/cull.inl"

#include "narrowphase/kernel/contact_certificate.inl"

#include "narrowphase/kernel/contact_geometry.inl"

int cull_vertex_face(const KernelPairs& pairs, int* survivors) { return cull_all<3>(pairs, survivors); }
int cull_edge_edge(const KernelPairs& pairs, int* survivors) { return cull_all<4>(pairs, survivors); }
void advance_vertex_face(const KernelPairs& pairs, const int* subset, int count, const KernelResume* resume,
                         KernelResult* results) {
  advance_all<3>(pairs, subset, count, resume, results);
}
void advance_edge_edge(const KernelPairs& pairs, const int* subset, int count, const KernelResume* resume,
                       KernelResult* results) {
  advance_all<4>(pairs, subset, count, resume, results);
}
void certify_vertex_face(const KernelPairs& pairs, const int* subset, int count, KernelResult* results) {
  certify_all<3>(pairs, subset, count, results);
}
void certify_edge_edge(const KernelPairs& pairs, const int* subset, int count, KernelResult* results) {
  certify_all<4>(pairs, subset, count, results);
}
void frames_vertex_face(const KernelPairs& pairs, const double* t, KernelFrame* frames) { frames_all<3>(pairs, t, frames); }
void frames_edge_edge(const KernelPairs& pairs, const double* t, KernelFrame* frames) { frames_all<4>(pairs, t, frames); }
double look_vertex_face(const KernelPairs& pairs, int row, double t, double (&w)[3]) { return look_at<3>(pairs, row, t, w); }
double look_edge_edge(const KernelPairs& pairs, int row, double t, double (&w)[3]) { return look_at<4>(pairs, row, t, w); }

}  // namespace
}  // namespace ONSET_KERNEL
}  // namespace onset
