// Points in their order along a Hilbert curve, where neighbours are close to each other.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/stop.hpp"

namespace onset {

// Bits of a cell number along an axis.
inline constexpr int kCurveBits = 10;

// Returns the place on the curve of the cell (x, y, z), each below 2^kCurveBits.
std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y, std::uint32_t z);

// Fills order[0..count) with 0..count-1 sorted along the curve, ties by index; `points` has three floats
// each. Many points in one cell get a finer curve over that cell, so that outliers do not spoil the rest. The
// order does not depend on the number of threads. Returns false where it was stopped.
bool order_along_curve(const float* points, std::size_t count, int* order, const Stop& stop = {});

}  // namespace onset
