#include "src/planes/plane_geometry.hpp"

#include "narrowphase/plane/plane_decision.hpp"
#include "narrowphase/vec.hpp"

namespace onset {

PlaneGeometries::PlaneGeometries(const MeshData& mesh, const Motion& motion, const Options& options)
    : motion_(motion), maximum_norm_(options.norm == Norm::maximum) {
  if (!mesh.mesh_planes) return;
  for (const MeshPlane& plane : mesh.mesh_planes->rows) {
    planes_.emplace_back(plane, motion.axes, maximum_norm_);
    const Vec n{{plane.scaled[0], plane.scaled[1], plane.scaled[2]}};
    const double length = std::sqrt(dot(n, n));
    normals_.push_back({n[0] / length, n[1] / length, n[2] / length});
  }
}

void PlaneGeometries::fill(Contact* first, Contact* last) const {
  for (; first != last; ++first) {
    const std::size_t row = std::size_t(first->b);
    const PlaneQuestion question =
        question_of(planes_[row], motion_.t0(first->a), motion_.t1(first->a), 0, maximum_norm_);
    const PlaneGeometry geometry = geometry_at_plane(planes_[row], question, first->toi);
    first->weights = {1, 0, 0, 0};
    first->normal = normals_[row];
    first->gap = geometry.distance, first->speed = geometry.speed;
    first->degenerate = false;
  }
}

}  // namespace onset
