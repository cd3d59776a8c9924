// Where and how a vertex touches a plane.
#pragma once

#include <array>
#include <vector>

#include "narrowphase/plane/oriented_plane.hpp"
#include "onset/options.hpp"
#include "onset/result.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

// The planes of a mesh, none where it has none, with unit normals by the caller's axes.
class PlaneGeometries {
 public:
  PlaneGeometries(const MeshData& mesh, const Motion& motion, const Options& options);

  // Adds weights, normal, gap and speed at toi to contacts of kind vertex_plane.
  void fill(Contact* first, Contact* last) const;

 private:
  const Motion& motion_;
  const bool maximum_norm_;
  std::vector<OrientedPlane> planes_;
  std::vector<std::array<double, 3>> normals_;
};

}  // namespace onset
