#include <algorithm>
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

// Mixes the bits of the coordinates, -0 being 0, as Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators" (OOPSLA 2014) mix theirs.
std::uint64_t number_of_place(const Positions& x, int v) {
  constexpr std::uint64_t kMinusZero = std::uint64_t(1) << 63;
  std::uint64_t h = 0;
  for (int a = 0; a < 3; ++a) {
    const double coordinate = x(v, a);
    std::uint64_t bits;
    std::memcpy(&bits, &coordinate, sizeof bits);
    h = (h ^ (bits == kMinusZero ? 0 : bits)) + 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return h >> (64 - kPlaceBits);
}

// Fills first[v] with the first vertex at the place of v, for vertices of one number in ascending order.
void find_first(const Positions& x, const Placed* begin, const Placed* end, std::vector<int>& first) {
  std::vector<int> firsts;
  for (const Placed* p = begin; p != end; ++p) {
    const auto is_here = [&](int v) {
      return x(v, 0) == x(p->vertex, 0) && x(v, 1) == x(p->vertex, 1) && x(v, 2) == x(p->vertex, 2);
    };
    auto here = std::find_if(firsts.begin(), firsts.end(), is_here);
    if (here == firsts.end()) here = firsts.insert(here, p->vertex);
    first[std::size_t(p->vertex)] = *here;
  }
}

}  // namespace

std::vector<std::vector<int>> shared_places(const Positions& x, const Stop& stop) {
  const std::size_t count = std::size_t(x.rows());
  std::vector<Placed> order(count);
  const auto place = [&](std::size_t v) { order[v] = {number_of_place(x, int(v)), int(v)}; };
  if (!each_unless(stop, 0, count, place)) return {};
  if (!radix_sort(
          order, [](const Placed& p) { return p.place; }, stop))
    return {};
  std::vector<int> first(count), row(count, -1);
  std::size_t begin = 0;
  const auto end_run = [&](std::size_t last) {  // at the end of each run of one number
    if (last + 1 < count && order[last + 1].place == order[last].place) return;
    find_first(x, &order[begin], &order[last] + 1, first);
    begin = last + 1;
  };
  if (!each_unless(stop, 0, count, end_run)) return {};
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
  if (x.cols() != 3) throw std::invalid_argument("x has " + std::to_string(x.cols()) + " columns, not 3");
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (int a = 0; a < 3; ++a)
      if (!std::isfinite(x(v, a)))
        throw std::invalid_argument("x row " + std::to_string(v) + ": " + std::to_string(x(v, a)) +
                                    " is not finite");
  std::vector<std::array<int, 2>> pairs;
  for (const std::vector<int>& here : shared_places(x))
    for (std::size_t j = 1; j < here.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) pairs.push_back({here[i], here[j]});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace onset
