// Bounds of the corner differences of pairs whose boxes overlap.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "scene/motion/motion.hpp"

namespace onset {

// Returns, per axis, the largest swept extent of edges or of faces, those listed or all, rounded up.
std::array<double, 3> largest_swept(const std::vector<std::array<int, 2>>& edges,
                                    const std::vector<int>* listed, const Motion& m);
std::array<double, 3> largest_swept(const std::vector<std::array<int, 3>>& faces,
                                    const std::vector<int>* listed, const Motion& m);

// Upper bounds, per stored axis, of the corner differences that a pair can have whose swept boxes are at most
// `gap` apart: the sum of both swept extents and the gap (docs/theory.md, L31). Only primitives that take
// part count.
struct Extents {
  std::array<double, 3> vertex_face{}, edge_edge{}, vertex_edge{};
  // Returns the largest over kinds and axes.
  double largest() const;
  double largest(int axis) const;
};
Extents corner_extents(const MeshData& mesh, const Motion& motion, double gap);

}  // namespace onset
