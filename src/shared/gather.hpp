// All pairs of a source looked at in parallel, and what is found among them, within a budget of time and
// memory.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

#include "scene/pair_source.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {

template <class Found>
struct Gathered {
  std::vector<Found> found;  // in no particular order
  bool too_many = false;     // more than were to be kept: `found` is empty, and not all pairs were looked at
};

// visit(kind, pairs, count, found) appends to `found`, from any thread. Keeps `most` at most; a spent budget
// ends it early, with what was found until then.
template <class Found, class Visit>
Gathered<Found> gather(const PairSource& pairs, const std::vector<PairKind>& kinds, std::size_t most,
                       Budget& budget, const Visit& visit) {
  constexpr std::size_t kBlocksATask = 4;
  Gathered<Found> all;
  std::atomic<bool> too_many{false};
  std::size_t blocks = 0;
  for (const PairKind kind : kinds) blocks += pairs.blocks(kind);
  budget.begin_traversal(blocks);
  for (const PairKind kind : kinds)
    visit_pairs(
        pairs, kind, kBlocksATask, std::vector<Found>(),
        [&](std::vector<Found>& found, const IdPair* batch, std::size_t count) {
          visit(kind, batch, count, found);
          if (found.size() > most) too_many = true;
        },
        [&](const std::vector<Found>& found, std::size_t done) {
          budget.advance(done);
          all.found.insert(all.found.end(), found.begin(), found.end());
          if (all.found.size() > most) too_many = true;
        },
        [&] { return too_many || budget.spent(); });
  all.too_many = too_many;
  if (too_many) all.found.clear();
  return all;
}

}  // namespace onset
