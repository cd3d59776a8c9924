// Random polygons that move in the plane, and all of their exact contacts.
#pragma once

#include <Eigen/Core>
#include <map>
#include <onset/onset.hpp>

#include "tests/in_plane/support/plane_truth.hpp"
#include "tests/scenes/random.hpp"

namespace onset::tests {

struct PlaneScene {
  Eigen::MatrixXd x_t0, x_t1;  // #V x 2
  Eigen::MatrixXi edges;
  Mesh mesh(const CollisionRules& rules = {}) const { return Mesh(x_t0, edges, rules); }
};

// Closed polygons and open lines that do not meet at the start, `bodies` of them, and a random motion of up
// to `speed`; all coordinates times `scale`.
PlaneScene polygons(int bodies, double speed, scenes::Random& random, double scale = 1);

VertexEdgeQuery query_of(const PlaneScene& scene, int vertex, int edge);

// By vertex and edge, those that touch in the step.
std::map<std::array<int, 2>, PlaneTruth> contacts_of(const PlaneScene& scene);

// Whether a vertex is on an edge, or two edges without a common vertex cross.
bool any_common_point(const Eigen::MatrixXd& x, const Eigen::MatrixXi& edges);

}  // namespace onset::tests
