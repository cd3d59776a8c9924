// The unit roundoff of doubles, which every error bound is in units of.
#pragma once

namespace onset {

inline constexpr double kU = 0x1p-53;

}  // namespace onset
