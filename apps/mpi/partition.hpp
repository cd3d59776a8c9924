// A mesh of one process, cut into parts for ranks.
#pragma once

#include <Eigen/Core>
#include <onset/mesh.hpp>
#include <onset/mpi/mesh.hpp>
#include <vector>

namespace app {

// Consecutive ids; recursive bisection of the positions, across the widest axis; a rank by chance for each.
enum class Partition { blocks, rcb, random };

// The rank of each vertex.
std::vector<int> ranks_of_vertices(const Eigen::MatrixXd& x, Partition partition, int ranks,
                                   unsigned seed = 1);

// What a rank that owns these vertices knows: them, all elements with one of them, and the other vertices of
// these. Rows are in an order of their own. gives_edges: else they are those of the faces.
onset::mpi::MeshPart part_of(const onset::Mesh& mesh, const std::vector<int>& rank_of, int rank,
                             bool gives_edges);

// The rows of a part; what is not owned is NaN, as nobody may read it.
Eigen::MatrixXd rows_of(const onset::mpi::MeshPart& part, const Eigen::MatrixXd& x);

}  // namespace app
