// What a mesh that holds a part of a scene is told of the whole, so that its pairs get the answers that they
// have there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/primitive.hpp"

namespace onset {

// Set by whoever divides a scene. Lengths are the largest over all parts: what a part measures itself is no
// more, so that every part goes on with the same.
struct WholeScene {
  // Whether there are such primitives, and static ones that take part.
  bool has_edges = false, has_faces = false, has_static = false;

  // Of the motion. Its axes, and by stored axis what primitives that take part move and span
  // (largest_swept).
  std::array<int, 3> axes{0, 1, 2};
  std::array<double, 3> moved{}, widest_edge{}, widest_face{};
  // The largest magnitude of a coordinate at both ends.
  double largest_coordinate = 0;
  // Whether BoxTest::moving is the cheaper test.
  bool tests_moving_boxes = false;
  // The middle of the scene, by stored axis, about which positions are rounded to single precision, and
  // whether all are (NarrowPhaseInput::for_many).
  std::array<double, 3> middle{};
  bool rounds_all = true;

  // Which part this is, and by kind and id whose a primitive is, and its id in the whole.
  int here = 0;
  std::array<std::vector<int>, 3> owner, id;
};

// Says whether rounding all vertices in every call is worth it: unless most of them are static.
inline bool rounds_all(std::size_t static_vertices, std::ptrdiff_t vertices) {
  return 2 * static_vertices <= std::size_t(vertices);
}

// Says whether this part decides a pair: each is decided by exactly one of the owners of its two primitives,
// by the sum of their ids, so that two parts share the pairs between them about evenly.
inline bool is_decided_here(const WholeScene& whole, PairKind kind, int a, int b) {
  const std::size_t first = std::size_t(first_primitive(kind)), second = std::size_t(second_primitive(kind));
  const int p = whole.owner[first][std::size_t(a)], q = whole.owner[second][std::size_t(b)];
  if (p == q) return p == whole.here;
  const bool odd = ((whole.id[first][std::size_t(a)] ^ whole.id[second][std::size_t(b)]) & 1) != 0;
  return (odd ? std::min(p, q) : std::max(p, q)) == whole.here;
}

}  // namespace onset
