// Couples of sides whose blocks of work are numbered through: each has those from the `end` of the couple
// before to its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace onset {

template <class Couple>
std::size_t blocks_of(const std::vector<Couple>& couples) {
  return couples.empty() ? 0 : couples.back().end;
}

// f(couple, from, to) for each couple with blocks in [first, last), which are its own [from, to).
template <class Couple, class F>
void each_couple(const std::vector<Couple>& couples, std::size_t first, std::size_t last, F&& f) {
  std::size_t begin = 0;
  for (const Couple& couple : couples) {
    const std::size_t from = std::max(first, begin), to = std::min(last, couple.end);
    if (from < to) f(couple, from - begin, to - begin);
    begin = couple.end;
  }
}

}  // namespace onset
