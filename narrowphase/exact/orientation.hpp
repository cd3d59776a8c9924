// The exact side of a plane that a point lies on.
#pragma once

namespace onset {

// Returns the exact sign of det[a - d, b - d, c - d]; kUnknownSide where products could underflow.
inline constexpr int kUnknownSide = 2;
int orientation(const double* a, const double* b, const double* c, const double* d);

}  // namespace onset
