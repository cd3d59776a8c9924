// An onset::Mesh whose planes are a vector that its owner changes as it likes.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <mutex>
#include <onset/compat/plane_query.hpp>
#include <onset/mesh.hpp>
#include <utility>
#include <vector>

namespace onset::ipc {

// Keeps the mesh with the planes that it was last asked for, and with it the trees of the calls before.
// Copies keep their own. Const calls are safe from several threads.
class MeshWithPlanes {
 public:
  MeshWithPlanes() : kept_(std::make_unique<Kept>()) {}
  explicit MeshWithPlanes(onset::Mesh mesh) : MeshWithPlanes() { kept_->mesh = std::move(mesh); }
  MeshWithPlanes(const MeshWithPlanes& other) : MeshWithPlanes() { *this = other; }
  MeshWithPlanes& operator=(const MeshWithPlanes& other) {
    if (this == &other) return *this;
    const std::lock_guard<std::mutex> lock(other.kept_->mutex);
    kept_->mesh = other.kept_->mesh, kept_->coefficients = other.kept_->coefficients;
    return *this;
  }
  ~MeshWithPlanes() = default;

  onset::Mesh with(const std::vector<Eigen::Hyperplane<double, 3>>& planes) const {
    std::vector<double> coefficients;
    for (const auto& p : planes)
      coefficients.insert(coefficients.end(), p.coeffs().data(), p.coeffs().data() + 4);
    const std::lock_guard<std::mutex> lock(kept_->mutex);
    if (coefficients != kept_->coefficients) {
      CollisionRules rules = kept_->mesh.rules();
      rules.planes.clear();
      for (const auto& p : planes) rules.planes.push_back(compat::plane_of(p));
      kept_->mesh.set_rules(rules);
      kept_->coefficients = std::move(coefficients);
    }
    return kept_->mesh;
  }

 private:
  struct Kept {
    std::mutex mutex;
    onset::Mesh mesh;
    std::vector<double> coefficients;  // of its planes
  };
  std::unique_ptr<Kept> kept_;
};

}  // namespace onset::ipc
