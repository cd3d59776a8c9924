// What the header of a PLY file says: elements, their properties, how they are written.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/mesh/mesh_builder.hpp"

namespace app {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t bytes_of(PlyType type);
inline bool is_whole(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float64;
  bool list = false;
  PlyType count_type = PlyType::uint8;  // of a list
  std::size_t line = 0;
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::size_t line = 0;
  std::vector<PlyProperty> properties;

  // The fewest bytes that a row takes.
  std::size_t least_bytes(bool ascii) const;
};

struct PlyHeader {
  enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t lines = 0;  // of the header; what follows them is the data
  std::string_view data;
};

// Errors are thrown through `mesh`.
PlyHeader read_ply_header(std::string_view bytes, const MeshBuilder& mesh);

}  // namespace app
