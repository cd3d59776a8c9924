// Which contacts of one step are those of another: what multipliers and other data of a pair are carried over
// by.
#pragma once

#include <cstddef>
#include <onset/active_set.hpp>
#include <onset/close_pairs.hpp>
#include <onset/export.hpp>
#include <onset/result.hpp>
#include <vector>

namespace onset {

struct Matches {
  // For each row of `from` the row of the same pair in `to`, and the other way round; -1: none.
  std::vector<int> to_of_from, from_of_to;
  // How many pairs are in both.
  std::size_t count = 0;
};

// Finds the rows that are the same pair: of one kind and with the same ids, in this order, of one mesh or of
// meshes with the same elements.
//
// Guarantee: every pair that is in both is matched, in whatever order they are. Where a list names a pair
// several times, the first is matched with the first, the second with the second, and so on. Linear for lists
// ordered by (kind, a, b), as active sets and close pairs are; n log n for others.
//
// Throws std::invalid_argument for a list of more than 2^31 - 1 rows.
// Safe to call concurrently.
//
// Example, multipliers of the last step for the contacts of this one:
//   const onset::ActiveSet last = onset::construct_active_set(mesh, x_t0, x_t1);
//   const std::vector<double> lambda(last.size(), 1.0);  // as the solver left them
//   const onset::ActiveSet now = onset::construct_active_set(mesh, x_t1, x_t0);
//   const onset::Matches m = onset::match(last, now);
//   std::vector<double> guess(now.size(), 0.0);
//   for (std::size_t i = 0; i < now.size(); ++i)
//     if (m.from_of_to[i] >= 0) guess[i] = lambda[std::size_t(m.from_of_to[i])];
ONSET_API Matches match(const ActiveSet& from, const ActiveSet& to);
ONSET_API Matches match(const ClosePairs& from, const ClosePairs& to);
// Lists of pairs, such as TruncatedStep::pairs; `vertices` is not used.
ONSET_API Matches match(const std::vector<Pair>& from, const std::vector<Pair>& to);

}  // namespace onset
