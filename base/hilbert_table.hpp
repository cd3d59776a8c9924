// The Hilbert curve through the eight octants of a cube, and of each of them.
#pragma once

#include <array>
#include <cstdint>

namespace onset {

// The Hilbert curve as a state machine, after Hamilton, "Compact Hilbert indices" (Dalhousie CS-2006-07). The
// state of a cell with entry corner e (0..7) and direction d (0..2) is 8 d + e; next[state][octant] is 8
// times the state of that octant, plus its place along the curve.
struct HilbertTable {
  std::array<std::array<std::uint8_t, 8>, 24> next{};
};

namespace hilbert {

constexpr unsigned rotate_left(unsigned x, unsigned n) {
  return ((x << n % 3) | (x >> (3 - n % 3) % 3)) & 7u;
}
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

}  // namespace hilbert

constexpr HilbertTable make_hilbert_table() {
  using namespace hilbert;
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
