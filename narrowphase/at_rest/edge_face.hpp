// What a closed edge and a closed face at rest have in common: exact, for the stored doubles.
#pragma once

#include <cstddef>
#include <cstdint>

namespace onset {

enum class EdgeFace : std::uint8_t {
  apart,
  crossing,     // one point, inside both
  touching,     // one point, not inside both
  overlapping,  // a segment
};

// Points have three finite coordinates of any magnitude. An edge of length zero and a face without area are
// the points and segments that they are. An answer takes 20 ns where rounding leaves no doubt, else about a
// microsecond, tens of them where magnitudes differ by more than 2^100.
struct EdgeAndFace {
  const double *e[2], *f[3];
};
EdgeFace edge_face(const EdgeAndFace& pair);

// Tells whether three points lie on one line, or are fewer than three.
bool exactly_collinear(const double* p, const double* q, const double* r);

}  // namespace onset
