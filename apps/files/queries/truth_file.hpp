// Which pairs of a scene collide, and when, computed elsewhere without rounding.
#pragma once

#include <cmath>
#include <cstdint>
#include <onset/onset.hpp>
#include <string>
#include <vector>

namespace app {

// One number for a pair; they sort as the rows of an active set do.
inline std::uint64_t pair_key(onset::PairKind kind, int a, int b) {
  return std::uint64_t(kind) << 62 | std::uint64_t(std::uint32_t(a)) << 31 | std::uint32_t(b);
}

// The exact time of impact lies in [lo, hi]; NaN where only the collision is known.
struct ExactToi {
  double lo = NAN, hi = NAN;
  bool known() const { return lo <= hi; }
};

struct CollidingPair {
  std::uint64_t key;
  ExactToi toi;
};

// The pairs that collide, sorted by key; all others of the scene do not.
using SceneTruth = std::vector<CollidingPair>;

// Each of `files` is one of
// - PAIRS.json,COLLIDES.json, as in the data of Belgrod et al.: [[id, id], ...] with ids that run over
//   vertices, then edges, then faces, and [true, false, ...] in the same order;
// - TRUTH.csv, under a row of names kind,a,b,toi_lo,toi_hi one row a pair that collides: ids within their
// kind,
//   the bracket of its time of impact, empty where it is not known.
// Throws InputError naming the file.
SceneTruth read_scene_truth(const std::vector<std::string>& files, const onset::Mesh& mesh);
// The paths in them, one by one.
std::vector<std::string> truth_paths(const std::vector<std::string>& files);

// toi.csv beside the query file at `path`: one row a query, lo,hi; inf,inf for no collision. Empty where
// there is no such file. Throws InputError where it is not as long as the queries or contradicts `collides`.
std::vector<ExactToi> read_query_toi(const std::string& path, const std::vector<bool>& collides);
// Where it would be.
std::string query_toi_path(const std::string& path);

}  // namespace app
