// One vertex and one half-space, asked about in the way of ipc-toolkit, whose planes are Eigen's.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <limits>
#include <onset/close_pairs.hpp>
#include <onset/compat/pair_queries.hpp>
#include <onset/mesh.hpp>
#include <onset/step_size.hpp>
#include <stdexcept>
#include <string>

namespace onset::compat {

// Free where plane.signedDistance(x) > 0; a normal of any length.
inline Plane plane_of(const Eigen::Hyperplane<double, 3>& plane) {
  Plane r;
  for (int a = 0; a < 3; ++a) r.normal[std::size_t(a)] = plane.normal()[a];
  r.offset = -plane.offset();
  return r;
}

// A mesh of one vertex and this plane, in as many dimensions as p has.
template <class P>
Mesh mesh_of_plane(const Eigen::Hyperplane<double, 3>& plane, const P& p) {
  CollisionRules rules;
  rules.planes = {plane_of(plane)};
  return p.size() == 2 ? Mesh::in_plane(1, Indices(), rules) : Mesh(1, Indices(), Indices(), rules);
}

// As impact() of pair_queries.hpp. The time is also one that can be stored. Throws std::invalid_argument for
// a plane that is not finite or has no normal, too.
template <class P>
bool plane_impact(double& toi, const Eigen::Hyperplane<double, 3>& plane, const P& p_t0, const P& p_t1,
                  double min_distance, double tmax, double conservative_rescaling) {
  require_limits(min_distance, tmax, conservative_rescaling);
  Options options;
  options.min_separation = min_distance;
  Candidates pair;
  pair.vertex_plane = {{0, 0}};
  const StepResult r =
      compute_collision_free_stepsize(mesh_of_plane(plane, p_t0), pair, p_t0.transpose().eval(),
                                      p_t1.transpose().eval(), options, kept_share(conservative_rescaling));
  toi = r.outcome == Outcome::free ? std::numeric_limits<double>::infinity() : r.step;
  if (!(toi <= tmax)) toi = std::numeric_limits<double>::infinity();
  return toi <= tmax;
}

template <class P>
Nearest nearest_to_plane(const Eigen::Hyperplane<double, 3>& plane, const P& p) {
  Nearest n;
  const auto close = [&](const Eigen::Hyperplane<double, 3>& to, const P& from) {
    return close_pairs(mesh_of_plane(to, from), from.transpose().eval(), kMostSeparation);
  };
  const ClosePairs near = close(plane, p);
  if (near.outcome != Outcome::free) return n;
  n.weights = {1, 0, 0, 0};
  n.distance = std::numeric_limits<double>::infinity();  // beyond all numbers, of a plane with a short normal
  if (!near.pairs.empty()) {
    n.distance = near.pairs[0].distance;
    return n;
  }
  const ClosePairs far = close({plane.normal(), plane.offset() * kNear}, P(p * kNear));
  if (!far.pairs.empty()) n.distance = far.pairs[0].distance / kNear;
  return n;
}

}  // namespace onset::compat
