// Bounds of the corner differences of pairs whose boxes overlap.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "scene/motion/motion.hpp"

namespace onset {

// Raises `widest`, per axis, to the swept extent of an element of N vertices, rounded to nearest.
template <std::size_t N>
void add_swept(const std::array<int, N>& element, const Motion& m, std::array<double, 3>& widest) {
  for (std::size_t a = 0; a < 3; ++a) {
    double lo = m.t0(element[0])[a], hi = lo;
    for (int v : element) {
      lo = std::min({lo, m.t0(v)[a], m.t1(v)[a]});
      hi = std::max({hi, m.t0(v)[a], m.t1(v)[a]});
    }
    widest[a] = std::max(widest[a], hi - lo);
  }
}
// Rounds it up.
inline void round_up(std::array<double, 3>& widest) {
  for (double& w : widest) w *= 1 + 0x1p-52;
}

// Returns, per axis, the largest swept extent of elements of N vertices, those listed or all, rounded up.
template <std::size_t N>
std::array<double, 3> largest_swept(const std::vector<std::array<int, N>>& elements,
                                    const std::vector<int>* listed, const Motion& m) {
  std::array<double, 3> widest{};
  const std::size_t count = listed ? listed->size() : elements.size();
  for (std::size_t i = 0; i < count; ++i)
    add_swept(elements[listed ? std::size_t((*listed)[i]) : i], m, widest);
  round_up(widest);
  return widest;
}

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
