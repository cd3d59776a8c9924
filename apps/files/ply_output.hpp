// Writes PLY, ascii, for MeshLab and the like: a mesh with a colour for each vertex, or a layer of points,
// edges and faces with a normal and a time of impact each.
#pragma once

#include <array>
#include <cstdint>
#include <onset/onset.hpp>
#include <string>
#include <vector>

#include "files/mesh/mesh_file.hpp"
#include "files/output.hpp"

namespace app {

using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

// From red for the earliest time over yellow to blue for 1; grey for a vertex without contact (toi < 0).
Colour colour_of(double toi, double earliest);

// Of each vertex the earliest time of impact of its contacts; -1: none.
std::vector<double> toi_of_vertices(const onset::ActiveSet& set, std::size_t vertices);

void write_coloured_ply(Output& file, const Points& positions, const Faces& faces,
                        const std::vector<Colour>& colours);

struct PlyLayer {
  struct Vertex {
    onset::Point position, normal{};
    double toi = -1;  // -1: none
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces;

  int add(const onset::Point& position, double toi, const onset::Point& normal = {});
};

// Properties x y z nx ny nz toi red green blue. Colours: colour_of(toi, earliest).
void write_ply(Output& file, const PlyLayer& layer, double earliest);

// For whoever writes rows of its own: what the header says of one element, and the header.
struct PlyRows {
  const char* element;
  std::size_t count;
  std::vector<const char*> properties;  // "double x"
};
inline PlyRows ply_faces(std::size_t count) { return {"face", count, {"list uchar int vertex_indices"}}; }
inline PlyRows ply_edges(std::size_t count) { return {"edge", count, {"int vertex1", "int vertex2"}}; }
void write_ply_header(Output& file, const std::vector<PlyRows>& elements);

}  // namespace app
