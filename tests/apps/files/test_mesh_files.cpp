// The readers of mesh files from inside: numbers bit by bit, and polygons of many corners.
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

#include "files/error.hpp"
#include "files/mesh/mesh_file.hpp"
#include "files/scene/scene.hpp"
#include "files/text_lines.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"

namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("numbers are those of strtod, bit by bit", "[unit]") {
  std::mt19937_64 random(onset::oracle::fuzz_seed());
  for (int i = 0; i < onset::oracle::fuzz(100000); ++i) {
    std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    char text[1100];
    std::snprintf(text, sizeof text, i % 3 == 0 ? "%.17g" : i % 3 == 1 ? "%.12e" : "%.25e", value);
    const std::optional<double> read = app::parse_double(text);
    REQUIRE(read);
    REQUIRE(same_bits(*read, std::strtod(text, nullptr)));
  }
  for (const char* text :
       {"0", "-0", "1e-400", "-1e-400", "1e400", "-1e400", "4.9e-324", "2e-324", "2.5e-324", "1.e3", ".5",
        "179769313486231580793728971405301e276", "0.1e-399", "0.001e400", "000000001", "inf", "-inf"}) {
    INFO(text);
    REQUIRE(app::parse_double(text));
    CHECK(same_bits(*app::parse_double(text), std::strtod(text, nullptr)));
  }
  for (const char* text : {"", "+", "-", "+-1", "++1", "1x", "0x1", "1,5", "1e", ".", "1.5.2", "e5"}) {
    INFO(text);
    CHECK_FALSE(app::parse_double(text));
  }
}

TEST_CASE("halves between two doubles are rounded to even", "[unit]") {
  std::mt19937_64 random(onset::oracle::fuzz_seed() + 1);
  for (int i = 0; i < onset::oracle::fuzz(2000); ++i) {
    const double value = std::ldexp(double(random() >> 11), int(random() % 60) - 80);
    const double next = std::nextafter(value, INFINITY);
    char half[400];  // exact: the sum has one bit more, and long double has eleven
    std::snprintf(half, sizeof half, "%.200Lf", ((long double)value + (long double)next) / 2);
    REQUIRE(same_bits(*app::parse_double(half), std::strtod(half, nullptr)));
    REQUIRE(same_bits(*app::parse_double(std::string(half) + "1"), next));
  }
}

TEST_CASE("polygons of many corners end, too", "[unit]") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("onset_polygons_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto scene = [&](int corners, auto&& radius) {
    const std::string path = (folder / "p.obj").string();
    std::ofstream out(path);
    std::string face = "f";
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * i / corners;
      out << "v " << radius(i) * std::cos(angle) << ' ' << radius(i) * std::sin(angle) << " 0\n";
      face += " " + std::to_string(i + 1);
    }
    out << face << "\n";
    out.close();
    return app::read_scene(path, path);
  };
  CHECK(scene(3000, [](int) { return 1.0; }).mesh.num_faces() == 2998);
  CHECK(scene(500, [](int i) { return i % 2 ? 1.0 : 0.3; }).mesh.num_faces() == 498);
  std::filesystem::remove_all(folder);
}
