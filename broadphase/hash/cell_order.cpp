#include "broadphase/hash/cell_order.hpp"

#include "base/parallel.hpp"
#include "base/radix_sort.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 4096;
// A block reaches over so many cells of a row at most, so that its box stays small. Measured: with 1 or 2 the
// recorded scenes take as long or up to a sixth longer.
constexpr int kCellsABlock = 4;

int bits_of(int x) { return x == 0 ? 0 : 32 - __builtin_clz(unsigned(x)); }

void unite(CellBox& box, const CellBox& other) {
  for (std::size_t i = 0; i < 3; ++i)
    box.lo[i] = std::min(box.lo[i], other.lo[i]), box.hi[i] = std::max(box.hi[i], other.hi[i]);
}

}  // namespace

// A key is level, z and y of the cell, and x in units: at most 5 + 17 + 17 + 20 bits.
CellOrder::CellOrder(const std::vector<FloatBox>& boxes, const CellUnits& units, const Stop& stop) {
  const std::size_t count = boxes.size();
  std::vector<CellBox> cells(count);
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last, [&](std::size_t i) { cells[i] = units(boxes[i]); });
  });
  if (count == 0 || !measure(cells, stop)) return;
  std::vector<Entry> entries(count);
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last, [&](std::size_t i) {
      const CellBox& c = cells[i];
      const int level = CellUnits::level_of(c), shift = CellUnits::kSub + level;
      const std::uint64_t row = row_key(level, (c.lo[1] - base_[1]) >> shift, (c.lo[2] - base_[2]) >> shift);
      entries[i] = {row << x_bits_ | std::uint64_t(c.lo[0] - base_[0]), int(i)};
    });
  });
  if (!radix_sort(
          entries, [](const Entry& e) { return e.key; }, stop))
    return;
  cut(entries, cells, stop);
  if (!stop.requested()) hash_rows();
}

bool CellOrder::measure(const std::vector<CellBox>& cells, const Stop& stop) {
  std::array<Level, CellUnits::kBits> levels;
  for (int l = 0; l < CellUnits::kBits; ++l) levels[std::size_t(l)].number = -1;
  const auto take = [&](std::size_t at) {
    const CellBox& c = cells[at];
    Level& level = levels[std::size_t(CellUnits::level_of(c))];
    if (level.number < 0) level = {CellUnits::level_of(c), {}, c.lo, c.lo};
    for (std::size_t i = 0; i < 3; ++i) {
      level.reach[i] = std::max(level.reach[i], c.hi[i] - c.lo[i]);
      level.lo[i] = std::min(level.lo[i], c.lo[i]), level.hi[i] = std::max(level.hi[i], c.lo[i]);
    }
  };
  if (!each_unless(stop, 0, cells.size(), take)) return false;
  for (const Level& level : levels)
    if (level.number >= 0) levels_.push_back(level);
  std::array<int, 3> top = levels_[0].hi;
  base_ = levels_[0].lo;
  for (const Level& level : levels_)
    for (std::size_t i = 0; i < 3; ++i)
      base_[i] = std::min(base_[i], level.lo[i]), top[i] = std::max(top[i], level.hi[i]);
  x_bits_ = bits_of(top[0] - base_[0]);
  y_bits_ = bits_of((top[1] - base_[1]) >> CellUnits::kSub);
  z_bits_ = bits_of((top[2] - base_[2]) >> CellUnits::kSub);
  return true;
}

// Cuts what is sorted into blocks, each within one row.
void CellOrder::cut(const std::vector<Entry>& entries, const std::vector<CellBox>& cells, const Stop& stop) {
  slots_.reserve(2 * entries.size()), blocks_.reserve(entries.size() / 4);
  const std::uint64_t x_mask = (std::uint64_t(1) << x_bits_) - 1;
  std::uint64_t row = 0;
  int widest = 0;
  each_unless(stop, 0, entries.size(), [&](std::size_t i) {
    const Entry& e = entries[i];
    const CellBox& c = cells[std::size_t(e.at)];
    const int x = int(e.key & x_mask);
    if (i == 0 || slots_.size() % kBlock == 0 || e.key >> x_bits_ != row ||
        x - blocks_.back().first_x > widest) {
      slots_.resize((slots_.size() + kBlock - 1) / kBlock * kBlock, -1);
      const int level = CellUnits::level_of(c);
      row = e.key >> x_bits_, widest = kCellsABlock << (CellUnits::kSub + level);
      blocks_.push_back({c, level, x, x});
    }
    Block& block = blocks_.back();
    unite(block.box, c);
    block.last_x = x;
    slots_.push_back(e.at);
  });
  slots_.resize((slots_.size() + kBlock - 1) / kBlock * kBlock, -1);
}

void CellOrder::hash_rows() {
  std::vector<Row> rows;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    const int shift = CellUnits::kSub + block.level;
    // The lower corner of the union is in the row, as those of all of them are.
    const std::uint64_t key =
        row_key(block.level, (block.box.lo[1] - base_[1]) >> shift, (block.box.lo[2] - base_[2]) >> shift);
    if (rows.empty() || rows.back().key != key) rows.push_back({key, int(b), int(b)});
    rows.back().last = int(b) + 1;
  }
  int bits = 1;
  while (std::size_t(1) << bits < 2 * rows.size()) ++bits;
  table_.assign(std::size_t(1) << bits, Row{});
  hash_shift_ = 64 - bits;
  for (const Row& r : rows) {
    std::size_t i = std::size_t((r.key * 0x9e3779b97f4a7c15u) >> hash_shift_);
    while (table_[i].last != 0) i = (i + 1) & (table_.size() - 1);
    table_[i] = r;
  }
}

}  // namespace onset
