// The unit roundoff of doubles, u in docs/theory.md: the unit of every error bound.
#pragma once

namespace onset {

inline constexpr double kU = 0x1p-53;

}  // namespace onset
