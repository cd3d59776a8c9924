// Every reader of files from bytes: a value, or an error that names the file; never much memory.
#include <unistd.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>

#include "files/error.hpp"
#include "files/mesh/mesh_file.hpp"
#include "files/queries/query_file.hpp"
#include "files/queries/truth_file.hpp"
#include "files/scene/scene.hpp"
#include "tests/fuzz/bytes.hpp"
#include "tests/fuzz/memory.hpp"
#include "tests/fuzz/target.hpp"

namespace onset::fuzz {

const char* const kTarget = "readers";
const int kInputs = 100000;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 64 << 20;

enum Reader { obj, ply, off, stl, queries, truth_rows, truth_lists, query_times, scene, kReaders };
const char* const kExtensions[] = {".obj", ".ply", ".off", ".stl"};

// Files for readers that take a path: removed when the program ends.
class Folder {
 public:
  Folder()
      : path_((fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
              ("onset_fuzz_readers_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary).write(text.data(), std::streamsize(text.size()));
    return (path_ / name).string();
  }

 private:
  fs::path path_;
};

// Empty, or what is unsound.
std::string unsound(const app::MeshFile& mesh) {
  const auto vertices = std::int64_t(mesh.positions.rows());
  const auto in_range = [&](std::int64_t id) { return id >= 0 && id < vertices; };
  const auto& corners = mesh.polygons.corners;
  if (!mesh.positions.allFinite()) return "a position that is not finite";
  if (!std::all_of(corners.begin(), corners.end(), in_range)) return "a corner out of range";
  if (!std::all_of(mesh.points.begin(), mesh.points.end(), in_range)) return "a point out of range";
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
    if (mesh.polygons.corners_of(p) < 3) return "a polygon of less than three corners";
  for (const auto& w : mesh.wires)
    if (!in_range(w[0]) || !in_range(w[1]) || w[0] == w[1]) return "a wire that is none";
  return {};
}

std::string read(Reader reader, const std::string& text, std::string& path) {
  static const Folder folder;
  static const Mesh mesh(4, (Eigen::MatrixXi(2, 3) << 0, 1, 2, 0, 2, 3).finished());
  path = "sample";
  switch (reader) {
    case obj:
      return unsound(app::read_obj(path, text));
    case ply:
      return unsound(app::read_ply(path, text));
    case off:
      return unsound(app::read_off(path, text));
    case stl:
      return unsound(app::read_stl(path, text));
    case queries: {
      path = folder.write("queries.csv", text);
      for (const app::TruthQuery& q : app::read_queries(path))
        for (const auto* x : {&q.t0, &q.t1})
          for (const Point& p : *x)
            for (double c : p)
              if (!std::isfinite(c)) return "a coordinate that is not finite";
      return {};
    }
    case truth_rows:
      path = folder.write("truth.csv", text);
      app::read_scene_truth({path}, mesh);
      return {};
    case truth_lists: {
      path = folder.write("", "").substr(0, 0);
      const std::size_t half = std::min(text.find('\n'), text.size());
      const std::string pairs = folder.write("pairs.json", text.substr(0, half)),
                        collides = folder.write("collides.json", text.substr(half));
      path = pairs.substr(0, pairs.rfind('/'));
      app::read_scene_truth({pairs + "," + collides}, mesh);
      return {};
    }
    case query_times: {
      folder.write("toi.csv", text);
      path = folder.write("asked.csv", "");
      path = path.substr(0, path.rfind('/'));
      app::read_query_toi(path + "/asked.csv", {true, false, true});
      return {};
    }
    default: {  // two frames, of the same file or of halves, with all that is made of them
      const std::string extension = kExtensions[text.size() % 4];
      const std::string first = folder.write("a" + extension, text);
      path = first.substr(0, first.rfind('/'));
      const app::Scene scene = app::read_scene(first, first);
      return scene.x_t0 == scene.x_t1 ? "" : "two frames of one file";
    }
  }
}

const char* const kWhole[][2] = {
    {"# c\nv 0 0 0\nv 1 0 0 1\nv 1 1 \\\n0\nv 0 1e0 0\nvn 0 0 1\nf 1//1 2/1 3/1/1 -1\nl 1 2 4\np 3\ns "
     "off\nxy\n",
     "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 3 0\nv -1 1 0\nf 1 2 3 4 5\nl 1 3\n"},
    {"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty float "
     "z\nproperty list uchar "
     "short more\nelement face 2\nproperty list uchar ushort vertex_indices\nelement edge 1\nproperty int "
     "vertex1\nproperty "
     "uchar vertex2\nend_header\n0 0 0 0\n1 0 0 1 5\n1 1 0 0\n0 1 0 2 1 2\n3 0 1 2\n4 0 1 2 3\n0 3\n",
     "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\nproperty "
     "char z\nelement "
     "face 1\nproperty list uchar uchar vertex_indices\nend_header\nabcdefghi\x03\x01\x02\x02"},
    {"COFF\n# c\n4 3 0\n0 0 0 1 1 1 1\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 0.5\n4 0 1 2 3\n2 0 3\n",
     "OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n"},
    {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
     "0\nendloop\nendfacet\nendsolid a\n",
     "solid\nendsolid\n"},
    {"1,2,3,4,5,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n1,2,3,4,-5,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,"
     "1\n0,1,1,1,0,1,1\n",
     "123456789012345678901234567890,1000000000000000000000000000000,0,1,0,1,0\n"},
    {"kind,a,b,toi_lo,toi_hi\nvf,3,0,0.25,0.25\nee,0,4,,\n", "kind,a,b,toi_lo,toi_hi\n"},
    {"[[3,9],[4,8]]\n[true,false]", "[]\n[]"},
    {"0.5,0.5\ninf,inf\n0.25,0.5\n", "0,0\ninf,inf\n1,1\n"},
    {"v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 3 0\nv -1 1 0\nv 0 0 0\nf 1 2 3 4 5\nl 1 6\n",
     "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
     "a\n"}};

template <class T>
void append(std::string& bytes, T value, bool big) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (big) std::reverse(raw.begin(), raw.end());
  bytes += raw;
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

std::string binary_ply(bool big) {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty float "
                      "z\nproperty list uchar "
                      "short more\nelement face 2\nproperty list uchar ushort vertex_indices\nend_header\n";
  for (int v = 0; v < 4; ++v) {
    append(bytes, float(v), big), append(bytes, double(v * v), big), append(bytes, 0.5f, big);
    append(bytes, std::uint8_t(1), big), append(bytes, std::int16_t(7), big);
  }
  for (const int corners : {3, 4}) {
    append(bytes, std::uint8_t(corners), big);
    for (int i = 0; i < corners; ++i) append(bytes, std::uint16_t(i), big);
  }
  return bytes;
}

// A word becomes another, or a line is lost, doubled or put elsewhere: numbers large, negative or none,
// headers out of order.
void change_text(std::string& text, scenes::Random& random) {
  const char* words[] = {"-1",     "4294967297", "2147483648", "99999999999999999999",
                         "1e400",  "nan",        "0",          "",
                         "\\\n",   "#",          "1e-400",     "1000000000",
                         "vertex", "element",    "list",       "ascii",
                         "uint",   "double",     "f",          "\xff"};
  const auto below = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  const std::size_t at = below(text.size());
  if (scenes::coin(random)) {
    const char* blanks = " \t\r\n,[]";
    const std::size_t begin = std::min(text.find_first_not_of(blanks, at), text.size());
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    text.replace(begin, end - begin, words[below(std::size(words))]);
    return;
  }
  const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1,
                    end = std::min(text.find('\n', at), text.size());
  const std::string line = text.substr(begin, end - begin) + "\n";
  if (scenes::coin(random)) text.erase(begin, std::min(end + 1, text.size()) - begin);
  const std::size_t where = below(text.size());
  if (scenes::coin(random)) text.insert(where == 0 ? 0 : text.rfind('\n', where - 1) + 1, line);
}

}  // namespace

std::string run_target(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  Reader reader = obj;
  bytes.whole(reader, 0, kReaders - 1);
  const std::string text = bytes.rest();
  std::string path, broken;
  const MemoryWatch watch;
  try {
    broken = read(reader, text, path);
  } catch (const app::InputError& e) {
    if (std::string(e.what()).find(path) == std::string::npos)
      broken = std::string("an error without the file: ") + e.what();
  } catch (const std::exception& e) {
    broken = std::string("throws another exception: ") + e.what();
  }
  if (watch.most() > kMostBytes) broken += " takes " + std::to_string(watch.most() >> 20) + " MiB";
  return broken.empty() ? broken : "reader " + std::to_string(int(reader)) + ", " + broken + "\n" + text;
}

std::string make_seed(int i, scenes::Random& random) {
  const std::size_t reader = std::size_t(i) % kReaders;
  std::string text = kWhole[reader][scenes::integer(random, 0, 1)];
  if (scenes::coin(random)) {
    if (reader == ply) text = binary_ply(scenes::coin(random));
    if (reader == off) text = binary_off();
    if (reader == stl) text = binary_stl();
  }
  for (int times = scenes::integer(random, -2, 3); times > 0; --times) change_text(text, random);
  return char(reader) + text;
}

}  // namespace onset::fuzz
