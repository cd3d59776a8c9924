// Primitives sorted by the cells of grids of growing width, in blocks of eight, and the search for blocks.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/aligned.hpp"
#include "base/stop.hpp"
#include "broadphase/bvh/kernel.hpp"
#include "broadphase/hash/cell_units.hpp"

namespace onset {

// Each primitive is in one cell: that of the lower corner of its box, at the lowest level where it is no
// wider than a cell. So each pair belongs to one pair of cells, no list grows with the size of a primitive,
// and a search at a level looks at few cells, none of them below (docs/theory.md, 13.7). The cells of one
// level that differ in x alone are a row, which is a run of blocks; rows are found by hashing. A crowd in one
// cell, such as all that lies beyond the grid, is in the order of a curve, so that unions of its blocks are
// small and a long run of them can be searched like a tree.
class CellOrder {
 public:
  CellOrder() = default;
  // Not to be used where it was stopped.
  CellOrder(const std::vector<FloatBox>& boxes, const CellUnits& units, const Stop& stop);

  // Eight a block: places in `boxes`; unused lanes are -1.
  const std::vector<int>& slots() const { return slots_; }
  // The same; they are gone from here then.
  std::vector<int> take_slots() { return std::move(slots_); }
  std::size_t blocks() const { return blocks_.size(); }
  const CellBox& box(std::size_t block) const { return blocks_[block].box; }
  int level(std::size_t block) const { return blocks_[block].level; }

  // Calls f(level, first, last) with runs of blocks [first, last), which do not overlap and together hold all
  // primitives of `least_level` or above whose boxes overlap `box`. There are at most 16 a level if `box` is
  // no wider than two cells of it.
  template <class F>
  void each_run(const CellBox& box, int least_level, F&& f) const {
    for (const Level& level : levels_)
      if (level.number >= least_level) each_run(level, box, f);
  }

 private:
  struct Block {
    CellBox box;
    int level, first_x, last_x;  // the lower corners are within these, from base_
  };
  // The primitives of a level reach `reach` units from their lower corners at most, which are in [lo, hi].
  struct Level {
    int number;
    std::array<int, 3> reach, lo, hi;
  };
  struct Row {
    std::uint64_t key = 0;
    int first = 0, last = 0;
  };
  struct Entry {
    std::uint64_t key;
    int at;
  };

  std::uint64_t row_key(int level, int y, int z) const {
    return (std::uint64_t(level) << z_bits_ | std::uint64_t(z)) << y_bits_ | std::uint64_t(y);
  }
  // Finds levels_, base_ and the bits that keys need. Returns false where it was stopped.
  bool measure(const std::vector<CellBox>& cells, const Stop& stop);
  class Cutter;
  void hash_rows(const Stop& stop);
  const Row& row(std::uint64_t key) const {
    std::size_t i = std::size_t((key * 0x9e3779b97f4a7c15u) >> hash_shift_);
    while (table_[i].last != 0 && table_[i].key != key) i = (i + 1) & (table_.size() - 1);
    return table_[i];
  }

  template <class F>
  void each_run(const Level& level, const CellBox& box, F&& f) const {
    int from[3], to[3];
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = std::max(box.lo[i] - level.reach[i], level.lo[i]), to[i] = std::min(box.hi[i], level.hi[i]);
      if (from[i] > to[i]) return;
      from[i] -= base_[i], to[i] -= base_[i];
    }
    const int shift = CellUnits::kSub + level.number;
    for (int z = from[2] >> shift; z <= to[2] >> shift; ++z)
      for (int y = from[1] >> shift; y <= to[1] >> shift; ++y) {
        const Row& r = row(row_key(level.number, y, z));
        const auto all = blocks_.begin();
        const auto first = std::lower_bound(all + r.first, all + r.last, from[0],
                                            [](const Block& b, int x) { return b.last_x < x; });
        const auto last =
            std::upper_bound(first, all + r.last, to[0], [](int x, const Block& b) { return x < b.first_x; });
        if (first != last) f(level.number, int(first - all), int(last - all));
      }
  }

  std::vector<int> slots_;
  std::vector<Block> blocks_;
  std::vector<Level> levels_;
  std::array<int, 3> base_{};
  int x_bits_ = 0, y_bits_ = 0, z_bits_ = 0;
  int hash_shift_ = 63;
  std::vector<Row> table_;
};

}  // namespace onset
