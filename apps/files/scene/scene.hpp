// One frame or two of one mesh: the input of the subcommands.
#pragma once

#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "files/mesh/mesh_file.hpp"

namespace app {

struct Scene {
  onset::Mesh mesh;  // edges: onset::edges(faces), then the wires that are not among them; points are set
  Points x_t0, x_t1;
  std::vector<std::string> notes;  // how the files were taken, for whoever reads the result
  std::string path;                // of the first
  bool welded = false;             // vertices at one place count as one (--weld)

  // The positions as calls take them: those of a mesh in the plane have two columns.
  onset::Positions start() const { return columns(x_t0); }
  onset::Positions end() const { return columns(x_t1); }

 private:
  onset::Positions columns(const Points& x) const {
    return mesh.dimension() == 2 ? onset::Positions(x.leftCols<2>()) : onset::Positions(x);
  }
};

// Throws InputError: what read_mesh throws, and elements (faces, wires, points) that differ, naming the first
// one. Polygons are cut into triangles by their shape in the first file.
Scene read_scene(const std::string& path_t0, const std::string& path_t1);

}  // namespace app
