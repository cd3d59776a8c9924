#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "base/float_environment.hpp"
#include "base/radix_sort.hpp"
#include "onset/check.hpp"
#include "src/start/places.hpp"

namespace onset {

namespace {

// A vertex under a number that all vertices at its place have, and few others.
struct Placed {
  std::uint64_t place;
  int vertex;
};
constexpr int kPlaceBits = 33;  // three digits of the sort

// The same for equal coordinates, -0 and 0 among them, and for no others.
std::uint64_t bits_of(double coordinate) {
  constexpr std::uint64_t kMinusZero = std::uint64_t(1) << 63;
  std::uint64_t bits;
  std::memcpy(&bits, &coordinate, sizeof bits);
  return bits == kMinusZero ? 0 : bits;
}

// Mixes the bits of the coordinates as Steele, Lea, Flood, "Fast splittable pseudorandom number generators"
// (OOPSLA 2014) mix theirs.
std::uint64_t number_of_place(const Positions& x, int v) {
  std::uint64_t h = 0;
  for (int a = 0; a < 3; ++a) {
    h = (h ^ bits_of(x(v, a))) + 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return h >> (64 - kPlaceBits);
}

std::uint64_t key(const Placed& p) { return p.place; }

bool at_one_place(const Positions& x, int v, int w) {
  return x(v, 0) == x(w, 0) && x(v, 1) == x(w, 1) && x(v, 2) == x(w, 2);
}

enum class Search { done, stopped, crowded };

// Fills first[v] with the first vertex at the place of v, by the numbers of places. It is crowded where a
// number has more places than chance gives it: somebody chose the coordinates.
Search find_by_numbers(const Positions& x, std::vector<Placed>& order, std::vector<int>& first,
                       const Stop& stop) {
  constexpr int kPlaces = 8;
  const auto place = [&](std::size_t v) { order[v] = {number_of_place(x, int(v)), int(v)}; };
  if (!each_unless(stop, 0, order.size(), place) || !radix_sort(order, key, stop)) return Search::stopped;
  std::array<int, kPlaces> firsts;  // of the places of one number
  int places = 0;
  bool crowded = false;
  const auto find = [&](std::size_t i) {
    if (i > 0 && order[i - 1].place != order[i].place) places = 0;
    const int v = order[i].vertex;
    int here = 0;
    while (here < places && !at_one_place(x, firsts[std::size_t(here)], v)) ++here;
    crowded = crowded || here == kPlaces;
    if (crowded) return;
    if (here == places) firsts[std::size_t(places++)] = v;
    first[std::size_t(v)] = firsts[std::size_t(here)];
  };
  if (!each_unless(stop, 0, order.size(), find)) return Search::stopped;
  return crowded ? Search::crowded : Search::done;
}

// The same by the coordinates themselves, in six times as many passes whatever they are. Returns false where
// it was stopped.
bool find_by_coordinates(const Positions& x, std::vector<Placed>& order, std::vector<int>& first,
                         const Stop& stop) {
  if (!each_unless(stop, 0, order.size(), [&](std::size_t v) { order[v].vertex = int(v); })) return false;
  for (int a = 0; a < 3; ++a) {
    const auto place = [&](std::size_t i) { order[i].place = bits_of(x(order[i].vertex, a)); };
    if (!each_unless(stop, 0, order.size(), place) || !radix_sort(order, key, stop)) return false;
  }
  return each_unless(stop, 0, order.size(), [&](std::size_t i) {
    const int v = order[i].vertex, before = i > 0 ? order[i - 1].vertex : -1;
    first[std::size_t(v)] = before >= 0 && at_one_place(x, before, v) ? first[std::size_t(before)] : v;
  });
}

}  // namespace

std::vector<std::vector<int>> shared_places(const Positions& x, const Stop& stop) {
  const std::size_t count = std::size_t(x.rows());
  std::vector<Placed> order(count);
  std::vector<int> first(count), row(count, -1);
  const Search search = find_by_numbers(x, order, first, stop);
  if (search == Search::stopped) return {};
  if (search == Search::crowded && !find_by_coordinates(x, order, first, stop)) return {};
  std::vector<char> is_shared(count);
  const auto share = [&](std::size_t v) {
    if (first[v] != int(v)) is_shared[std::size_t(first[v])] = 1;
  };
  if (!each_unless(stop, 0, count, share)) return {};
  std::vector<std::vector<int>> places;
  const auto list = [&](std::size_t v) {
    if (is_shared[v]) row[v] = int(places.size()), places.push_back({int(v)});
    if (first[v] != int(v)) places[std::size_t(row[std::size_t(first[v])])].push_back(int(v));
  };
  if (!each_unless(stop, 0, count, list)) return {};
  return places;
}

std::vector<std::array<int, 2>> duplicate_vertices(const Positions& x) {
  const FloatEnvironment environment;
  if (x.cols() != 3 && x.cols() != 2)
    throw std::invalid_argument("x has " + std::to_string(x.cols()) + " columns, not 2 or 3");
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (int a = 0; a < x.cols(); ++a)
      if (!std::isfinite(x(v, a)))
        throw std::invalid_argument("x row " + std::to_string(v) + ": " + std::to_string(x(v, a)) +
                                    " is not finite");
  std::vector<std::array<int, 2>> pairs;
  for (const std::vector<int>& here : shared_places(x.cols() == 2 ? x.in_space() : x))
    for (std::size_t j = 1; j < here.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) pairs.push_back({here[i], here[j]});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace onset
