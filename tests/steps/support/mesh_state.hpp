// Whether a mesh at rest meets itself, exactly.
#pragma once

#include <onset/onset.hpp>
#include <string>

namespace onset::tests {

// Empty, or what touches or pierces what. Primitives that share a vertex are not looked at.
std::string meets_itself(const Mesh& mesh, const Eigen::MatrixXd& x);

}  // namespace onset::tests
