// The readers of mesh files from inside: numbers bit by bit, and damaged files, which end in a message at
// worst.
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

using Reader = app::MeshFile (*)(const std::string&, std::string_view);

const std::string kPlyHeader =
    "element vertex 4\nproperty float x\nproperty double y\nproperty float z\nproperty list uchar short "
    "more\n"
    "element face 2\nproperty list uchar ushort vertex_indices\nelement edge 1\nproperty int vertex1\n"
    "property uchar vertex2\nend_header\n";

// `value` in the order of bytes that is asked for.
template <class T>
void append(std::string& bytes, T value, bool big) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (big) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

std::string binary_ply(bool big) {
  std::string bytes =
      std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kPlyHeader;
  for (int v = 0; v < 4; ++v) {
    append(bytes, float(v), big), append(bytes, double(v * v), big), append(bytes, 0.5f, big);
    append(bytes, std::uint8_t(1), big), append(bytes, std::int16_t(7), big);
  }
  for (const int corners : {3, 4}) {
    append(bytes, std::uint8_t(corners), big);
    for (int i = 0; i < corners; ++i) append(bytes, std::uint16_t(i), big);
  }
  append(bytes, std::int32_t(0), big), append(bytes, std::uint8_t(3), big);
  return bytes;
}

std::string binary_off() {
  std::string bytes = "OFF BINARY\n";
  for (const int n : {4, 2, 0}) append(bytes, std::int32_t(n), true);
  for (int i = 0; i < 12; ++i) append(bytes, float(i * i), true);
  for (const int n : {3, 0, 1, 2, 0, 4, 0, 1, 2, 3, 1}) append(bytes, std::int32_t(n), true);
  append(bytes, 0.5f, true);
  return bytes;
}

std::string binary_stl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t(2), false);
  for (int f = 0; f < 2; ++f) {
    for (int i = 0; i < 12; ++i) append(bytes, float((f + i) * i), false);
    append(bytes, std::uint16_t(0), false);
  }
  return bytes;
}

struct Sample {
  Reader read;
  std::string bytes;
};

std::vector<Sample> samples() {
  return {{app::read_obj,
           "# c\nv 0 0 0\nv 1 0 0 1\nv 1 1 \\\n0\nv 0 1e0 0\nvn 0 0 1\nf 1//1 2/1 3/1/1 -1\nl 1 2 4\np 3\ns "
           "off\nxy\n"},
          {app::read_ply, "ply\nformat ascii 1.0\n" + kPlyHeader +
                              "0 0 0 0\n1 0 0 1 5\n1 1 0 0\n0 1 0 2 1 2\n3 0 1 2\n4 0 1 2 3\n0 3\n"},
          {app::read_ply, binary_ply(false)},
          {app::read_ply, binary_ply(true)},
          {app::read_off,
           "COFF\n# c\n4 3 0\n0 0 0 1 1 1 1\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 0.5\n4 0 1 2 3\n2 0 3\n"},
          {app::read_off, binary_off()},
          {app::read_stl,
           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
           "endfacet\nendsolid a\n"},
          {app::read_stl, binary_stl()}};
}

// Bytes turned, runs copied or lost, numbers made large or negative.
void damage(std::string& bytes, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  const std::string words[] = {"-1",   "4294967297", "99999999999999999999", "1e400", "nan", "0", "\n", " ",
                               "\\\n", "#"};
  const std::size_t at = below(bytes.size()), length = std::min(1 + below(9), bytes.size() - at);
  switch (below(5)) {
    case 0:
      bytes[at] = char(random());
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(40)));
      break;
    case 3:
      bytes.replace(at, std::min<std::size_t>(length, 2), words[below(std::size(words))]);
      break;
    default:
      for (std::size_t i = 0; i < length; ++i) bytes[at + i] = '\xff';
      break;
  }
}

void check_sound(const app::MeshFile& mesh) {
  const auto vertices = std::int64_t(mesh.positions.rows());
  const auto in_range = [&](std::int64_t id) { return id >= 0 && id < vertices; };
  REQUIRE(mesh.positions.allFinite());
  REQUIRE(std::all_of(mesh.polygons.corners.begin(), mesh.polygons.corners.end(), in_range));
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) REQUIRE(mesh.polygons.corners_of(p) >= 3);
  for (const auto& w : mesh.wires) REQUIRE((in_range(w[0]) && in_range(w[1]) && w[0] != w[1]));
  REQUIRE(std::all_of(mesh.points.begin(), mesh.points.end(), in_range));
}

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

TEST_CASE("whole files are read as they are meant", "[unit]") {
  for (const Sample& sample : samples()) {
    INFO(sample.bytes);
    const app::MeshFile mesh = sample.read("sample", sample.bytes);
    check_sound(mesh);
    CHECK(mesh.positions.rows() >= 3);
    CHECK(mesh.polygons.size() >= 1);
  }
}

TEST_CASE("damaged files are read, or named", "[unit]") {
  std::mt19937_64 random(onset::oracle::fuzz_seed() + 2);
  int read = 0, named = 0;
  const std::vector<Sample> whole = samples();
  for (int i = 0; i < onset::oracle::fuzz(40000); ++i) {
    Sample sample = whole[std::size_t(i) % whole.size()];
    const int times = 1 + int(random() % 4);
    for (int k = 0; k < times; ++k) damage(sample.bytes, random);
    try {
      check_sound(sample.read("sample", sample.bytes));
      ++read;
    } catch (const app::InputError& e) {
      REQUIRE(std::string(e.what()).substr(0, 6) == "sample");
      ++named;
    }
  }
  CHECK(read > 0);
  CHECK(named > 0);
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
