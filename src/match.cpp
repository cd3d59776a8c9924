#include "onset/match.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

namespace onset {
namespace {

struct Place {
  std::tuple<int, int, int> key;
  int row;
};
bool before(const Place& x, const Place& y) { return x.key != y.key ? x.key < y.key : x.row < y.row; }

template <class Pairs>
std::vector<Place> in_order(const char* name, const Pairs& pairs) {
  if (pairs.size() > std::size_t(std::numeric_limits<int>::max()))
    throw std::invalid_argument(std::string(name) + " has " + std::to_string(pairs.size()) + " rows");
  std::vector<Place> places;
  places.reserve(pairs.size());
  for (const Pair& p : pairs) places.push_back({{int(p.kind), p.a, p.b}, int(places.size())});
  if (!std::is_sorted(places.begin(), places.end(), before)) std::sort(places.begin(), places.end(), before);
  return places;
}

template <class Pairs>
Matches match_lists(const Pairs& from, const Pairs& to) {
  const std::vector<Place> first = in_order("from", from), second = in_order("to", to);
  Matches m;
  m.to_of_from.assign(first.size(), -1), m.from_of_to.assign(second.size(), -1);
  for (std::size_t i = 0, j = 0; i < first.size() && j < second.size();) {
    if (first[i].key < second[j].key) {
      ++i;
    } else if (second[j].key < first[i].key) {
      ++j;
    } else {
      m.to_of_from[std::size_t(first[i].row)] = second[j].row;
      m.from_of_to[std::size_t(second[j].row)] = first[i].row;
      ++m.count, ++i, ++j;
    }
  }
  return m;
}

}  // namespace

Matches match(const ActiveSet& from, const ActiveSet& to) { return match_lists(from.contacts, to.contacts); }
Matches match(const ClosePairs& from, const ClosePairs& to) { return match_lists(from.pairs, to.pairs); }
Matches match(const std::vector<Pair>& from, const std::vector<Pair>& to) { return match_lists(from, to); }

}  // namespace onset
