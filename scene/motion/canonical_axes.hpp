// The order of axes that a motion is stored in, which does not depend on how its axes are named.
#pragma once

#include <algorithm>
#include <array>

namespace onset {

// The exact x - y as its rounded value and the rest, by Knuth's two-sum; within kMaxCoordinate none
// overflows.
struct Difference {
  double rounded, rest;
};
inline Difference exact_difference(double x, double y) {
  const double d = x - y, back = d - x;
  return {d, (x - (d - back)) - (y + back)};
}

// Returns -1, 0 or 1 as column i of the caller's positions comes before, with or after column j. The order
// depends only on exact differences of positions along an axis, not on their sign, so it commutes with
// exchanging axes, flipping them, exact translation and scaling by powers of two. Columns that tie are equal
// up to sign and an offset, so that either may come first (docs/theory.md, T12). x(v, end, column) is a
// coordinate of one of `vertices`.
template <class Coordinate>
int compare_columns(int vertices, const Coordinate& x, int i, int j) {
  double sign[2] = {0, 0};
  const int column[2] = {i, j};
  for (int pass = 0; pass < 2; ++pass) {  // magnitudes, then signs relative to the first non-zero one
    for (int v = 0; v < vertices; ++v)
      for (int end = 0; end < 2; ++end) {
        Difference d[2];
        for (int k = 0; k < 2; ++k) {
          d[k] = exact_difference(x(v, end, column[k]), x(0, 0, column[k]));
          const double here = d[k].rounded > 0 ? 1 : -1;  // where it is 0, so is the rest
          if (sign[k] == 0 && d[k].rounded != 0) sign[k] = here;
          const double factor = pass == 0 ? here : sign[k];
          d[k] = {d[k].rounded * factor, d[k].rest * factor};
        }
        if (d[0].rounded != d[1].rounded) return d[0].rounded > d[1].rounded ? -1 : 1;
        if (d[0].rest != d[1].rest) return d[0].rest > d[1].rest ? -1 : 1;
      }
  }
  return 0;
}

// Orders the axes, the widest first; equally wide ones by compare_columns.
template <class Coordinate>
std::array<int, 3> widest_first(const std::array<double, 3>& width, int vertices, const Coordinate& x) {
  std::array<int, 3> axes{0, 1, 2};
  const auto before = [&](int i, int j) {
    return width[i] != width[j] ? width[i] > width[j] : compare_columns(vertices, x, i, j) < 0;
  };
  std::stable_sort(axes.begin(), axes.end(), before);
  return axes;
}

}  // namespace onset
