// Frames as VTK's unstructured grids, with velocities, for ParaView and meshio, and to go on from.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "simulation/system.hpp"

namespace simulation {

// What a time step begins with.
struct State {
  Vector x, velocity;
  int step = 0;
  double turned_until = 0;  // s: when a body that turns was where it is; of step 0 and of other scenes 0
};

// Triangles or tetrahedra.
struct Cells {
  int corners = 3;
  std::vector<int> vertices;  // corner after corner

  Cells() = default;
  template <std::size_t N>
  explicit Cells(const std::vector<std::array<int, N>>& cells) : corners(int(N)) {
    for (const auto& cell : cells) vertices.insert(vertices.end(), cell.begin(), cell.end());
  }
  std::size_t size() const { return vertices.size() / std::size_t(corners); }
};

// A .vtu, its arrays appended as raw little-endian doubles. Throws app::InputError naming a file that cannot
// be written.
void write_frame(const std::string& path, const State& state, const Cells& cells);

// One that write_frame has written. Throws app::InputError naming the path and the cause, as where it is not
// of these cells.
State read_frame(const std::string& path, std::size_t vertices, const Cells& cells);

// A .pvd that lists the frames of these steps, which lie beside it, with their times.
void write_series(const std::string& path, const std::vector<int>& steps, double time_step);

}  // namespace simulation
