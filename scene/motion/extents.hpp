// How large a pair of overlapping boxes can be.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "scene/motion/motion.hpp"

namespace onset {

// Largest swept extent, per axis, over elements of N vertices: those listed, or all; rounded up.
template <std::size_t N>
std::array<double, 3> largest_swept(const std::vector<std::array<int, N>>& elements,
                                    const std::vector<int>* listed, const Motion& m) {
  std::array<double, 3> widest{};
  const std::size_t count = listed ? listed->size() : elements.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& e = elements[listed ? std::size_t((*listed)[i]) : i];
    for (int a = 0; a < 3; ++a) {
      double lo = m.t0(e[0])[a], hi = lo;
      for (int v : e) {
        lo = std::min({lo, m.t0(v)[a], m.t1(v)[a]});
        hi = std::max({hi, m.t0(v)[a], m.t1(v)[a]});
      }
      widest[a] = std::max(widest[a], hi - lo);
    }
  }
  for (double& w : widest) w *= 1 + 0x1p-52;  // hi - lo rounds to nearest: one ulp more is an upper bound
  return widest;
}

// Per stored axis, upper bounds on the largest corner difference |p - v| (vertex-face), |p_i - p_j|
// (edge-edge) that a pair with overlapping swept boxes can have (each side of the pair spans its swept
// extent, and the boxes are at most `gap` apart): R <= w(A) + w(B) + gap. Of primitives that take part.
struct Extents {
  std::array<double, 3> vertex_face{}, edge_edge{};
  double largest() const;  // over kinds and axes
};
Extents corner_extents(const MeshData& mesh, const Motion& motion, double gap);

}  // namespace onset
