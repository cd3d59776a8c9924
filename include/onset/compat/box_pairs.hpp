// Which boxes of two lists overlap: the broad phase of onset/compat/ipc.hpp's and ipc_toolkit.hpp's classes,
// which are asked about boxes, not about meshes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <onset/candidates.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace onset::compat {

// The closed box of all x with lo <= x <= hi, model length.
struct Box {
  std::array<double, 3> lo{}, hi{};

  bool overlaps(const Box& o) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (lo[a] > o.hi[a] || o.lo[a] > hi[a]) return false;
    return true;
  }
  // NaN stays.
  void extend(const Box& o) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (o.lo[a] < lo[a] || o.lo[a] != o.lo[a]) lo[a] = o.lo[a];
      if (o.hi[a] > hi[a] || o.hi[a] != o.hi[a]) hi[a] = o.hi[a];
    }
  }
};

// Lists every pair {i, j} of an overlapping a[i] and b[j]; with no `b`, of a[i] and a[j], i < j.
//
// Guarantee: exactly these, sorted, the same for any number of threads and any method.
// Throws std::runtime_error for boxes that are not finite or reach beyond 2^1020.
//
// A box is the swept box of a point that moves from its lower to its upper corner, so that the candidates of
// such points are the pairs wanted; those that overlap by rounding alone are left out afterwards.
inline std::vector<std::array<int, 2>> overlapping_boxes(
    const std::vector<Box>& a, const std::vector<Box>* b = nullptr,
    BroadPhaseMethod method = BroadPhaseMethod::automatic) {
  const std::size_t n = a.size() + (b != nullptr ? b->size() : 0);
  if (a.empty() || (b != nullptr && b->empty())) return {};
  const auto box = [&](std::size_t i) -> const Box& { return i < a.size() ? a[i] : (*b)[i - a.size()]; };
  std::vector<double> lo, hi;
  lo.reserve(3 * n), hi.reserve(3 * n);
  for (std::size_t i = 0; i < n; ++i)
    lo.insert(lo.end(), box(i).lo.begin(), box(i).lo.end()),
        hi.insert(hi.end(), box(i).hi.begin(), box(i).hi.end());

  CollisionRules rules;
  rules.points.resize(n);
  std::iota(rules.points.begin(), rules.points.end(), 0);
  if (b != nullptr) {  // each of one list meets those of the other
    rules.groups.assign(n, 1), rules.masks.assign(n, 2);
    for (std::size_t i = a.size(); i < n; ++i) rules.groups[i] = 2, rules.masks[i] = 1;
  }
  const Mesh points(std::ptrdiff_t(n), Indices(), Indices(), rules);
  Options options;
  options.broad_phase = method;
  Candidates found = compute_candidates(points, Positions(lo.data(), std::ptrdiff_t(n)),
                                        Positions(hi.data(), std::ptrdiff_t(n)), options);
  if (found.outcome != Outcome::free)
    throw std::runtime_error(std::string("overlapping boxes: ") + to_string(found.outcome));
  std::vector<std::array<int, 2>> pairs;
  const int offset = b != nullptr ? int(a.size()) : 0;
  for (const auto& [i, j] : found.edge_edge)
    if (box(std::size_t(i)).overlaps(box(std::size_t(j)))) pairs.push_back({i, j - offset});
  return pairs;
}

}  // namespace onset::compat
