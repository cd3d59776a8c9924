#include "broadphase/hash/cell_order.hpp"

#include "base/parallel.hpp"
#include "base/radix_sort.hpp"
#include "broadphase/bvh/space_curve.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 4096;
// A block reaches over so many cells of a row at most, so that its box stays small. Measured: with 1 or 2 the
// recorded scenes take as long or up to a sixth longer.
constexpr int kCellsABlock = 4;
// With more primitives than this a cell has blocks of its own.
constexpr std::ptrdiff_t kCrowd = 256;

int bits_of(int x) { return x == 0 ? 0 : 32 - __builtin_clz(unsigned(x)); }

void unite(CellBox& box, const CellBox& other) {
  for (std::size_t i = 0; i < 3; ++i)
    box.lo[i] = std::min(box.lo[i], other.lo[i]), box.hi[i] = std::max(box.hi[i], other.hi[i]);
}

}  // namespace

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
class CellOrder::Cutter {
 public:
  Cutter(CellOrder& order, const std::vector<FloatBox>& boxes, const std::vector<CellBox>& cells,
         const Stop& stop)
      : order_(order), boxes_(boxes), cells_(cells), stop_(stop) {}

  // Returns false where it was stopped.
  bool run(const std::vector<Entry>& entries) {
    order_.slots_.reserve(2 * entries.size()), order_.blocks_.reserve(entries.size() / 4);
    const Entry* first = entries.data();
    const auto end_cell = [&](const Entry* last) {
      last - first > kCrowd ? add_crowd(first, last) : add_few(first, last);
      first = last;
    };
    const auto look = [&](std::size_t i) {
      if (!in_one_cell(entries[i - 1], entries[i])) end_cell(&entries[i]);
    };
    if (!each_unless(stop_, 1, entries.size(), look)) return false;
    end_cell(entries.data() + entries.size());
    fill();
    return !stop_.requested();
  }

 private:
  int level(const Entry& e) const { return int(e.key >> (order_.x_bits_ + order_.y_bits_ + order_.z_bits_)); }
  std::uint64_t row(const Entry& e) const { return e.key >> order_.x_bits_; }
  int x(const Entry& e) const { return int(e.key & ((std::uint64_t(1) << order_.x_bits_) - 1)); }
  bool in_one_cell(const Entry& a, const Entry& b) const {
    return row(a) == row(b) && (x(a) ^ x(b)) >> (CellUnits::kSub + level(a)) == 0;
  }

  void fill() { order_.slots_.resize((order_.slots_.size() + kBlock - 1) / kBlock * kBlock, -1); }
  void add(int at, const Block& fresh) {
    if (order_.slots_.size() % kBlock == 0) order_.blocks_.push_back(fresh);
    Block& block = order_.blocks_.back();
    unite(block.box, fresh.box);
    block.last_x = fresh.last_x;
    order_.slots_.push_back(at);
  }

  // They may share blocks with other cells of their row.
  void add_few(const Entry* first, const Entry* last) {
    const int widest = kCellsABlock << (CellUnits::kSub + level(*first));
    for (; first != last; ++first) {
      if (closed_ || row(*first) != row_ || x(*first) - order_.blocks_.back().first_x > widest) fill();
      closed_ = false, row_ = row(*first);
      add(first->at, {cells_[std::size_t(first->at)], level(*first), x(*first), x(*first)});
    }
  }

  // Along a curve, so that the boxes of their blocks, and of many blocks, are small.
  void add_crowd(const Entry* first, const Entry* last) {
    const std::size_t count = std::size_t(last - first);
    AlignedArray<float> points(3 * count);
    AlignedArray<int> order(count);
    const auto put = [&](std::size_t i) {
      const FloatBox& box = boxes_[std::size_t(first[i].at)];
      for (std::size_t a = 0; a < 3; ++a) points[3 * i + a] = box.lo[a] + box.hi[a];
    };
    if (!each_unless(stop_, 0, count, put) || !order_along_curve(points.data(), count, order.data(), stop_))
      return;
    fill();
    closed_ = true;
    const int in_cell = (1 << (CellUnits::kSub + level(*first))) - 1;
    const int first_x = x(*first) & ~in_cell, last_x = x(*first) | in_cell;
    each_unless(stop_, 0, count, [&](std::size_t i) {
      const int at = first[order[i]].at;
      add(at, {cells_[std::size_t(at)], level(*first), first_x, last_x});
    });
  }

  CellOrder& order_;
  const std::vector<FloatBox>& boxes_;
  const std::vector<CellBox>& cells_;
  const Stop& stop_;
  bool closed_ = true;  // whether the last block takes no more
  std::uint64_t row_ = 0;
};

void CellOrder::hash_rows(const Stop& stop) {
  std::vector<Row> rows;
  const auto take = [&](std::size_t b) {
    const Block& block = blocks_[b];
    const int shift = CellUnits::kSub + block.level;
    // The lower corner of the union is in the row, as those of all of them are.
    const std::uint64_t key =
        row_key(block.level, (block.box.lo[1] - base_[1]) >> shift, (block.box.lo[2] - base_[2]) >> shift);
    if (rows.empty() || rows.back().key != key) rows.push_back({key, int(b), int(b)});
    rows.back().last = int(b) + 1;
  };
  if (!each_unless(stop, 0, blocks_.size(), take)) return;
  int bits = 1;
  while (std::size_t(1) << bits < 2 * rows.size()) ++bits;
  table_.assign(std::size_t(1) << bits, Row{});
  hash_shift_ = 64 - bits;
  each_unless(stop, 0, rows.size(), [&](std::size_t r) {
    std::size_t i = std::size_t((rows[r].key * 0x9e3779b97f4a7c15u) >> hash_shift_);
    while (table_[i].last != 0) i = (i + 1) & (table_.size() - 1);
    table_[i] = rows[r];
  });
}

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
  if (Cutter(*this, boxes, cells, stop).run(entries)) hash_rows(stop);
}

}  // namespace onset
