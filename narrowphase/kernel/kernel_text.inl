// The whole kernel text in the order it builds up, included by kernel_scalar.cpp, kernel_avx2.cpp and
// kernel_avx512.cpp.
#include "base/simd/pack.hpp"
#include "narrowphase/kernel/kernel.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// In the order in which they build up.
// clang-format off
#include "narrowphase/kernel/direction.inl"
#include "narrowphase/kernel/maximum_norm.inl"
#include "narrowphase/kernel/certificates.inl"
#include "narrowphase/kernel/gather.inl"
#include "narrowphase/kernel/state.inl"
#include "narrowphase/kernel/advance.inl"
#include "narrowphase/kernel/cull.inl"
#include "narrowphase/kernel/contact_certificate.inl"
#include "narrowphase/kernel/contact_geometry.inl"
#include "narrowphase/kernel/in_plane.inl"
// clang-format on

// K corners: 3 of a vertex-face pair, 4 of two edges.
template <int K>
constexpr KernelsOfKind kKernels{cull_all<K>, advance_all<K>, certify_all<K>, contact_geometry_all<K>,
                                 closest_direction_of<K>};
constexpr KernelsOfKind kKernelsInPlane{cull_all<3>, advance_all<3>, certify_in_plane,
                                        contact_geometry_in_plane, closest_direction_of<3>};

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
