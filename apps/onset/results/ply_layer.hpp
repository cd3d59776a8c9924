// Points, edges and faces with a normal and a time of impact each, written as PLY.
#pragma once

#include <array>
#include <onset/query.hpp>
#include <string>
#include <vector>

namespace app {

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

// ascii; properties x y z nx ny nz toi red green blue. Colours: colour_of(toi, earliest).
void write_ply(const std::string& path, const PlyLayer& layer, double earliest);

}  // namespace app
