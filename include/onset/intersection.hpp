// An edge and a face with a common point.
#pragma once

#include <array>
#include <cstdint>
#include <onset/export.hpp>

namespace onset {

// What a closed edge and a closed face have in common.
enum class IntersectionKind : std::uint8_t {
  crossing,     // one point, inside the edge and inside the face: the edge goes through
  touching,     // one point, an end of the edge or on the face's boundary among others
  overlapping,  // a segment: the edge lies in the plane of the face, or along a face without area
};
ONSET_API const char* to_string(IntersectionKind kind);

struct Intersection {
  int edge = -1, face = -1;
  IntersectionKind kind = IntersectionKind::crossing;
  std::array<int, 5> vertices{-1, -1, -1, -1, -1};  // e0, e1, f0, f1, f2; a point (CollisionRules::points) twice
};

}  // namespace onset
