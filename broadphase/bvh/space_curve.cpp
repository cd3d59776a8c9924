#include "broadphase/bvh/space_curve.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/hilbert_table.hpp"
#include "base/parallel.hpp"
#include "base/radix_sort.hpp"

namespace onset {
namespace {

constexpr HilbertTable kTable = make_hilbert_table();
constexpr std::size_t kGrain = 8192;
constexpr std::size_t kCrowd = 64;  // so many points in one cell are worth a finer curve
constexpr int kDeepest = 16;        // curves within curves, at most

struct Keyed {
  std::uint32_t key;
  int index;
};

// A cube of 2^kCurveBits cells an axis around some points.
struct Grid {
  float lo[3], scale;

  std::uint32_t cell(const float* p, int axis) const {
    const float c = (p[axis] - lo[axis]) * scale, most = (1 << kCurveBits) - 1;
    return std::uint32_t(c > 0 ? (c < most ? c : most) : 0.0f);
  }
  std::uint32_t key(const float* p) const { return hilbert_key(cell(p, 0), cell(p, 1), cell(p, 2)); }
};

// Returns false where all points coincide, or where it was stopped.
bool fit_grid(const float* points, const Keyed* first, const Keyed* last, Grid& grid, const Stop& stop) {
  float lo[3], hi[3];
  for (int i = 0; i < 3; ++i) lo[i] = hi[i] = points[3 * std::size_t(first->index) + std::size_t(i)];
  const auto take = [&](std::size_t k) {
    for (int i = 0; i < 3; ++i) {
      const float x = points[3 * std::size_t(first[k].index) + std::size_t(i)];
      lo[i] = std::min(lo[i], x), hi[i] = std::max(hi[i], x);
    }
  };
  if (!each_unless(stop, 0, std::size_t(last - first), take)) return false;
  const float extent = std::max(hi[0] - lo[0], std::max(hi[1] - lo[1], hi[2] - lo[2]));
  if (!(extent > 0)) return false;
  grid.scale = float(1 << kCurveBits) / extent;
  std::copy(lo, lo + 3, grid.lo);
  return grid.scale < 0x1p126f;
}

constexpr std::size_t kFew = 1024;  // so few are sorted faster by comparing

// Sorts stably.
void sort_by_key(Keyed* keys, Keyed* scratch, std::size_t count, const Stop& stop) {
  if (count < kFew)
    std::stable_sort(keys, keys + count, [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  else
    radix_sort(
        keys, scratch, count, [](const Keyed& k) { return std::uint64_t(k.key); }, stop);
}

void sort_range(const float* points, Keyed* keys, Keyed* scratch, std::size_t count, int depth,
                const Stop& stop) {
  if (stop.requested()) return;
  Grid grid;
  if (!fit_grid(points, keys, keys + count, grid, stop)) return;
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last,
                [&](std::size_t i) { keys[i].key = grid.key(points + 3 * std::size_t(keys[i].index)); });
  });
  sort_by_key(keys, scratch, count, stop);
  if (depth == kDeepest) return;
  for (std::size_t first = 0, last; first < count; first = last) {
    for (last = first + 1; last < count && keys[last].key == keys[first].key;) ++last;
    if (last - first > kCrowd)
      sort_range(points, keys + first, scratch + first, last - first, depth + 1, stop);
  }
}

}  // namespace

std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t key = 0, state = 0;
  for (int bit = kCurveBits - 1; bit >= 0; --bit) {
    const std::uint32_t octant = (x >> bit & 1) | (y >> bit & 1) << 1 | (z >> bit & 1) << 2;
    const std::uint32_t next = kTable.next[state][octant];
    key = key << 3 | (next & 7);
    state = next >> 3;
  }
  return key;
}

bool order_along_curve(const float* points, std::size_t count, int* order, const Stop& stop) {
  if (count == 0) return true;
  std::vector<Keyed> keys(count), scratch(count);
  if (!each_unless(stop, 0, count, [&](std::size_t i) { keys[i] = {0, int(i)}; })) return false;
  sort_range(points, keys.data(), scratch.data(), count, 0, stop);
  return each_unless(stop, 0, count, [&](std::size_t i) { order[i] = keys[i].index; });
}

}  // namespace onset
