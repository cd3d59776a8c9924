// How wide the cells of the lowest level should be, from the boxes.
#pragma once

#include <array>
#include <vector>

#include "base/stop.hpp"
#include "broadphase/hash/cell_units.hpp"

namespace onset {

// Returns the exponent, for CellUnits, of a width that is a little more than that of the usual box, or more
// where cells would else hold few boxes, which a sample of the longest list shows. The lists get grids of
// that width. Any where it was stopped.
int cell_exponent(const std::vector<const std::vector<FloatBox>*>& lists, const Stop& stop = {});

}  // namespace onset
