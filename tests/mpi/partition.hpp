// A scene of one process, cut into parts.
#pragma once

#include <Eigen/Core>
#include <onset/mpi/mesh.hpp>
#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "apps/mpi/partition.hpp"

namespace onset::tests {

struct WholeScene {
  std::string name;
  onset::Mesh mesh;
  Eigen::MatrixXd x_t0, x_t1;  // two columns in the plane
  onset::Options options;
  double d_hat = 0.05;
  bool edges_are_given = false;  // else they are those of the faces
};

enum class Cut { blocks, rcb, random, all_on_one, empty_rank };
inline constexpr Cut kCuts[] = {Cut::blocks, Cut::rcb, Cut::random, Cut::all_on_one, Cut::empty_rank};
const char* to_string(Cut cut);

// The rank of each vertex.
std::vector<int> ranks_of_vertices(const WholeScene& scene, Cut cut, int ranks, unsigned seed);

mpi::MeshPart part_of(const WholeScene& scene, const std::vector<int>& rank_of, int rank);
using app::rows_of;

}  // namespace onset::tests
