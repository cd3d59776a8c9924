#include "broadphase/hash/cell_width.hpp"

#include <cstdint>
#include <cstring>

namespace onset {
namespace {

// The power of two by which a cell is wider than the usual box. Measured: with 0 the recorded scenes take as
// long or a twelfth longer, with 2 or 3 up to two thirds longer where many pairs meet.
constexpr int kWidth = 1;
// A box is to have so many others, on average, in four cells of a row: enough for three blocks. Measured:
// with 3 to 12 scenes take as long or up to a seventh longer.
constexpr double kOthers = 24;
constexpr int kCells = 2;  // a power of two
// Of so many times the root of the number of boxes, kOthers * kSample^2 / 2 pairs are then in one place.
constexpr double kSample = 8;

// Returns the exponent of the power of two not above the median width.
int usual_exponent(const std::vector<const std::vector<FloatBox>*>& lists, const Stop& stop) {
  constexpr int kBias = 127, kExponents = 256;
  std::array<std::size_t, kExponents> count{};
  std::size_t all = 0, below = 0;
  for (const std::vector<FloatBox>* boxes : lists) {
    each_unless(stop, 0, boxes->size(), [&](std::size_t i) {
      const float widest = (*boxes)[i].widest();
      std::uint32_t bits;
      std::memcpy(&bits, &widest, sizeof bits);
      ++count[bits >> 23 & 0xff];
    });
    all += boxes->size();
  }
  int e = 0;
  while (e + 1 < kExponents && 2 * (below += count[std::size_t(e)]) < all) ++e;
  return e - kBias;
}

double width_of_all(const std::vector<FloatBox>& boxes) {
  FloatBox all = boxes[0];
  for (const FloatBox& b : boxes)
    for (std::size_t i = 0; i < 3; ++i)
      all.lo[i] = std::min(all.lo[i], b.lo[i]), all.hi[i] = std::max(all.hi[i], b.hi[i]);
  return double(all.widest());
}

// Returns the number of pairs of a sample that are in one place: the same kCells of a row.
double pairs_in_place(const std::vector<FloatBox>& sample, int exponent, std::vector<std::uint64_t>& places) {
  const CellUnits units(exponent);
  places.clear();
  for (const FloatBox& box : sample) {
    const CellBox c = units(box);
    const int level = CellUnits::level_of(c), shift = CellUnits::kSub + level;
    std::uint64_t place = std::uint64_t(level);
    for (std::size_t i = 0; i < 3; ++i)
      place = place << CellUnits::kBits | std::uint64_t(c.lo[i] >> (i == 0 ? shift + kCells : shift));
    places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  double pairs = 0;
  for (std::size_t i = 0, first = 0; i < places.size(); ++i) {
    if (places[i] != places[first]) first = i;
    pairs += double(i - first);
  }
  return pairs;
}

}  // namespace

int cell_exponent(const std::vector<const std::vector<FloatBox>*>& lists, const Stop& stop) {
  if (lists.empty()) return CellUnits::kLeastExponent;
  int exponent = std::max(usual_exponent(lists, stop) + kWidth, CellUnits::kLeastExponent);
  const std::vector<FloatBox>& most = **std::max_element(
      lists.begin(), lists.end(), [](const auto* a, const auto* b) { return a->size() < b->size(); });
  if (most.empty()) return exponent;
  const double count = double(most.size());
  const auto stride = std::max(std::size_t(1), std::size_t(std::sqrt(count) / kSample));
  std::vector<FloatBox> sample;
  for (std::size_t i = 0; i < most.size(); i += stride) sample.push_back(most[i]);
  const double sampled = double(sample.size()), whole = width_of_all(sample);
  std::vector<std::uint64_t> places;
  while (!stop.requested() && exponent < CellUnits::kMostExponent && std::exp2(exponent) < whole &&
         2 * pairs_in_place(sample, exponent, places) * count < kOthers * sampled * sampled)
    ++exponent;
  return exponent;
}

}  // namespace onset
