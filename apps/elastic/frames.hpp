// Frames as VTK's unstructured grids, with velocities, for ParaView and meshio, and to go on from.
#pragma once

#include <string>
#include <vector>

#include "elastic/body.hpp"

namespace elastic {

// What a time step begins with.
struct State {
  Vector x, velocity;
  int step = 0;
};

// A .vtu, its arrays appended as raw little-endian doubles. Throws app::InputError naming a file that cannot
// be written.
void write_frame(const std::string& path, const State& state, const std::vector<Tetrahedron>& tetrahedra);

// One that write_frame has written. Throws app::InputError naming the path and the cause, as where it is not
// of these tetrahedra.
State read_frame(const std::string& path, std::size_t vertices, const std::vector<Tetrahedron>& tetrahedra);

// A .pvd that lists the frames of these steps, which lie beside it, with their times.
void write_series(const std::string& path, const std::vector<int>& steps, double time_step);

}  // namespace elastic
