// The three-dimensional Hilbert curve as a state machine.
#pragma once

#include <array>
#include <cstdint>

namespace onset {

// Hamilton, "Compact Hilbert indices" (Dalhousie CS-2006-07): a state is the entry corner e (0..7) and the
// direction d (0..2) of a cell, state = 8 d + e. next[state][octant] = 8 * (state of that octant) + its place
// along the curve.
struct HilbertTable {
  std::array<std::array<std::uint8_t, 8>, 24> next{};
};

constexpr unsigned rotate_left(unsigned x, unsigned n) {
  return ((x << n % 3) | (x >> (3 - n % 3) % 3)) & 7u;
}
constexpr unsigned rotate_right(unsigned x, unsigned n) { return rotate_left(x, 3 - n % 3); }
constexpr unsigned gray(unsigned i) { return i ^ (i >> 1); }

constexpr unsigned trailing_ones(unsigned i) {
  unsigned n = 0;
  for (; i & 1u; i >>= 1) ++n;
  return n;
}
constexpr unsigned entry_corner(unsigned i) { return i == 0 ? 0 : gray(2 * ((i - 1) / 2)); }
constexpr unsigned direction(unsigned i) {
  return i == 0 ? 0 : i % 2 == 0 ? trailing_ones(i - 1) % 3 : trailing_ones(i) % 3;
}

constexpr HilbertTable make_hilbert_table() {
  HilbertTable table;
  for (unsigned d = 0; d < 3; ++d)
    for (unsigned e = 0; e < 8; ++e)
      for (unsigned place = 0; place < 8; ++place) {
        const unsigned octant = rotate_left(gray(place), d + 1) ^ e;
        const unsigned next_e = e ^ rotate_left(entry_corner(place), d + 1);
        const unsigned next_d = (d + direction(place) + 1) % 3;
        table.next[8 * d + e][octant] = std::uint8_t(8 * (8 * next_d + next_e) + place);
      }
  return table;
}

}  // namespace onset
