// Order along a Hilbert curve: neighbours in the order are neighbours in space.
#pragma once

#include <cstddef>
#include <cstdint>

namespace onset {

inline constexpr int kCurveBits = 10;  // an axis

// Position of the cell (x, y, z), each below 2^kCurveBits, on the curve.
std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y, std::uint32_t z);

// Fills order[0..count) with 0..count-1 sorted along the curve; `points` has three floats each. Points that
// share a cell are ordered by a finer curve over that cell as long as there are many of them, so outliers do
// not spoil the rest; ties by index. Depends on the points alone, not on the number of threads.
void order_along_curve(const float* points, std::size_t count, int* order);

}  // namespace onset
