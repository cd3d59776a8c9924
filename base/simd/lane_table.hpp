// A table of the lanes that each mask names; part of base/simd/pack.hpp.
#pragma once

namespace onset {
namespace ONSET_ISA {
namespace {

constexpr int kLanes = 8;  // of F8 and I8

// Lists for each mask its lanes in ascending order.
struct LaneTable {
  unsigned char lane[256][8];
};
constexpr LaneTable make_lane_table() {
  LaneTable table{};
  for (int mask = 0; mask < 256; ++mask)
    for (int lane = 0, place = 0; lane < 8; ++lane)
      if (mask >> lane & 1) table.lane[mask][place++] = static_cast<unsigned char>(lane);
  return table;
}
constexpr LaneTable kLaneTable = make_lane_table();

}  // namespace
}  // namespace ONSET_ISA
}  // namespace onset
