// The pairs within d_hat of each other: what a barrier method sums over.
#pragma once

#include <array>
#include <cstddef>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <vector>

namespace onset {

// One pair at one time. All lengths are Euclidean, in model length, whatever Options::norm is. rho is the
// pair's size: the length of the vector that has, on each axis, the largest difference of a vertex of one
// primitive and a vertex of the other.
struct ClosePair : Pair {
  // The closest points as signed weights of `vertices`: those of the first primitive sum to 1, those of the
  // second to -1, so that sum weights[i] x[vertices[i]] leads from the second to the first. A vertex that
  // takes no part has exactly 0; the others are the closest feature (point-point, point-edge, point-triangle
  // or edge-edge). The gradient of the distance by vertex i is weights[i] times the direction of that sum.
  // vertex_plane: 1, 0, 0, 0, and the sum is the vertex alone: the direction is that of the plane's normal
  // (mesh.rules().planes[b].normal).
  std::array<double, 4> weights{};
  // The length of that sum: within 2^-47 rho of the exact distance, and shorter by no more than its own
  // rounding (docs/theory.md, L42). Where the pair touches it may be a little more than 0, and then the sum
  // has no direction to speak of. vertex_plane: within 2^-48 of it, relatively, or by half
  // of the smallest number; 0 on the plane and behind it.
  double distance = 0;
  // What the pair has to keep: Options::min_separation plus thickness, times sqrt(3) in the maximum norm.
  double separation = 0;
  // A certified lower bound of the exact distance less `separation`, within 2^-47 rho of it; 0 where there is
  // none to certify.
  double gap = 0;
};

struct ClosePairs {
  // Ordered by (kind, a, b): the same bytes for any number of threads and any instruction set.
  std::vector<ClosePair> pairs;
  // As asked for.
  double d_hat = 0;
  // free: all pairs are listed. non_finite, out_of_range, out_of_time, out_of_memory, cancelled: none is.
  Outcome outcome = Outcome::free;
  // The offending vertex of non_finite and out_of_range, else -1.
  int vertex = -1;
  double seconds = 0;

  std::size_t size() const noexcept { return pairs.size(); }
  auto begin() const noexcept { return pairs.begin(); }
  auto end() const noexcept { return pairs.end(); }
};

// Finds every pair whose exact distance at x is below d_hat plus its separation.
//
// Guarantee: none of these is left out; a pair beyond by no more than 2^-46 of rho (ClosePair), or of d_hat
// plus the separation, may be listed as well. Pairs that share a vertex, or that the rules of the mesh leave
// out, are not listed.
//
// x: #V x 3, model length.
// d_hat: model length, in (0, 2^1020].
// options: min_separation and norm decide the separation. Accuracy is not used, nor is check_limit.
// Throws std::invalid_argument for a wrong number of rows or columns, d_hat or options out of range.
// Safe to call concurrently on one Mesh.
//
// Source: d_hat is that of Li, Ferguson, Schneider, Langlois, Zorin, Panozzo, Jiang, Kaufman, "Incremental
// Potential Contact: Intersection- and Inversion-free, Large-Deformation Dynamics", ACM Transactions on
// Graphics 39(4), 2020. Distances: docs/theory.md, section 16.
//
// Example, the barrier of that paper:
//   const double d_hat = 1e-2;
//   const onset::ClosePairs close = onset::close_pairs(mesh, x, d_hat);
//   double energy = 0;
//   for (const onset::ClosePair& p : close)
//     if (p.distance < d_hat) energy -= std::pow(p.distance - d_hat, 2) * std::log(p.distance / d_hat);
ONSET_API ClosePairs close_pairs(const Mesh& mesh, const Positions& x, double d_hat,
                                 const Options& options = {});

}  // namespace onset
