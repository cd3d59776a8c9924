// CGAL's readers of polygon soups behind a door of ours: PLY, OBJ and OFF, in the order of the file.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace app {

inline constexpr long long kUnreadIndex = std::numeric_limits<long long>::min();

struct PolygonSoup {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<long long>> polygons;  // vertex indices as the file has them, in range or not
  bool complete = false;  // the file was read to its end; otherwise the reader gave up somewhere
  std::string reason;     // what it says about that, if anything
};

// In lower case, with its dot.
std::string extension(const std::string& path);

// The format is taken from the extension. What an OFF reader gave up on before it was there holds NaN and
// kUnreadIndex. Throws InputError for a missing file, an unknown extension, a PLY header that would be
// misread, counts beyond memory.
PolygonSoup read_polygon_soup(const std::string& path);

}  // namespace app
