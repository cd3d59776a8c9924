// The pairs within d-hat of each other: what a barrier method sums over.
#pragma once

#include <array>
#include <cstddef>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <vector>

namespace onset {

// One pair at rest. All lengths are Euclidean, in model length, whatever Options::norm is.
struct ClosePair : Pair {
  // The closest points as signed weights of `vertices`: those of the first primitive sum to 1, those of the
  // second to -1, so that sum weights[i] x[vertices[i]] leads from the second to the first. Exactly 0 for a
  // vertex whose corner takes no part: the ones that are not 0 are the closest feature (point-point,
  // point-edge, point-triangle or edge-edge). The gradient of the distance by vertex i is weights[i] times
  // the direction of that sum.
  std::array<double, 4> weights{};
  // The length of that sum: within 2^-47 of the pair's largest corner difference of the exact distance, and
  // as weights are feasible, shorter by no more than its own rounding. Where the pair touches it may be as little
  // more than 0, and then the sum has no direction to speak of.
  double distance = 0;
  // What the pair has to keep: Options::min_separation plus thickness, times sqrt(3) in the maximum norm.
  double separation = 0;
  // Certified lower bound of the exact distance less `separation`, within 2^-47 of the pair's largest corner
  // difference of that; 0 where there is none to certify.
  double gap = 0;
};

// Ordered by (kind, a, b): the same bytes for any number of threads and either kernel.
struct ClosePairs {
  std::vector<ClosePair> pairs;
  double d_hat = 0;
  Outcome outcome = Outcome::free;  // non_finite, out_of_range: there are no pairs
  int vertex = -1;                  // the offending vertex of these
  double seconds = 0;

  std::size_t size() const { return pairs.size(); }
  auto begin() const { return pairs.begin(); }
  auto end() const { return pairs.end(); }
};

// Every pair whose exact distance at x (#V x 3) is below d_hat (model length, > 0) plus its separation. A
// pair beyond that by no more than 2^-46 of its largest corner difference, or of d_hat plus the separation,
// may be listed as well; none within is left out. Pairs that share a vertex are no pairs. Throws
// std::invalid_argument for a wrong number of rows, options or d_hat out of range. Safe to call concurrently
// on one Mesh.
ONSET_API ClosePairs close_pairs(const Mesh& mesh, const Positions& x, double d_hat,
                                 const Options& options = {});

}  // namespace onset
