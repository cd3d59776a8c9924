// FCL's view of a scene of two bodies at one time.
#pragma once

// FCL's headers warn under our flags.
#pragma GCC system_header

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace onset::fcl_test {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

// The faces whose vertices lie in [first, last), as a triangle mesh.
inline std::shared_ptr<Model> body(const Eigen::MatrixXd& x, const Eigen::MatrixXi& faces, int first,
                                   int last) {
  std::vector<fcl::Vector3d> points;
  for (int v = first; v < last; ++v) points.emplace_back(x.row(v).transpose());
  std::vector<fcl::Triangle> triangles;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    if (faces(f, 0) >= first && faces(f, 0) < last)
      triangles.emplace_back(faces(f, 0) - first, faces(f, 1) - first, faces(f, 2) - first);
  auto model = std::make_shared<Model>();
  model->beginModel();
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

// The vertices before `second_body` against the others.
inline bool intersect(const Eigen::MatrixXd& x, const Eigen::MatrixXi& faces, int second_body) {
  const auto a = body(x, faces, 0, second_body), b = body(x, faces, second_body, int(x.rows()));
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  fcl::CollisionResultd result;
  fcl::collide(a.get(), identity, b.get(), identity, fcl::CollisionRequestd(), result);
  return result.isCollision();
}

inline double distance(const Eigen::MatrixXd& x, const Eigen::MatrixXi& faces, int second_body) {
  const auto a = body(x, faces, 0, second_body), b = body(x, faces, second_body, int(x.rows()));
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  fcl::DistanceResultd result;
  return fcl::distance(a.get(), identity, b.get(), identity, fcl::DistanceRequestd(), result);
}

}  // namespace onset::fcl_test
