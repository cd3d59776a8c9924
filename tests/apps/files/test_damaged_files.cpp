// Damaged files of every format end in what they still say, or in a message that names the file, and take no
// more memory than their bytes account for.
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>

#include "files/error.hpp"
#include "files/queries/query_file.hpp"
#include "files/queries/truth_file.hpp"
#include "files/scene/scene.hpp"
#include "tests/apps/files/damaged_files.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"

namespace {

std::atomic<std::int64_t> held{0}, most_held{0};

}  // namespace

void* operator new(std::size_t size) {
  void* block = std::malloc(size);
  if (!block) throw std::bad_alloc();
  const std::int64_t now = held += std::int64_t(malloc_usable_size(block));
  if (now > most_held) most_held = now;
  return block;
}
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* block) noexcept {
  held -= std::int64_t(malloc_usable_size(block));
  std::free(block);
}
void operator delete[](void* block) noexcept { operator delete(block); }
void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::size_t) noexcept { operator delete(block); }

namespace {

using onset::tests::SampleFile;

class Folder {
 public:
  Folder() { std::filesystem::create_directories(path_); }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const SampleFile& file) const {
    const std::string path = (path_ / file.name).string();
    std::filesystem::remove(path);  // to overwrite a file makes some file systems wait for the disk
    std::ofstream(path, std::ios::binary) << file.bytes;
    return path;
  }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("onset_damaged_" + std::to_string(getpid()));
};

// So that what the reader asks for, and the counts below would name, is refused. Sanitizers need all
// addresses.
class MemoryLimit {
 public:
  MemoryLimit() {
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    return;
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return;
#endif
    getrlimit(RLIMIT_AS, &before_);
    const rlimit less{std::min<rlim_t>(rlim_t(1) << 31, before_.rlim_max), before_.rlim_max};
    setrlimit(RLIMIT_AS, &less);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{RLIM_INFINITY, RLIM_INFINITY};
};

void check_sound(const app::MeshFile& mesh) {
  const auto vertices = std::int64_t(mesh.positions.rows());
  const auto in_range = [&](std::int64_t id) { return id >= 0 && id < vertices; };
  REQUIRE(mesh.positions.allFinite());
  REQUIRE(std::all_of(mesh.polygons.corners.begin(), mesh.polygons.corners.end(), in_range));
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) REQUIRE(mesh.polygons.corners_of(p) >= 3);
  for (const auto& w : mesh.wires) REQUIRE((in_range(w[0]) && in_range(w[1]) && w[0] != w[1]));
  REQUIRE(std::all_of(mesh.points.begin(), mesh.points.end(), in_range));
}

// The folder's files that are needed beside the one that is read are whole.
void read(const std::string& path) {
  static const onset::Mesh mesh(6, (Eigen::MatrixXi(2, 3) << 0, 1, 2, 3, 4, 5).finished());
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::string name = std::filesystem::path(path).filename().string();
  const auto beside = [&](const char* other) { return (folder / other).string(); };
  if (name == "queries.csv")
    app::read_queries(path);
  else if (name == "truth.csv")
    app::read_scene_truth({path}, mesh);
  else if (name == "pairs.json")
    app::read_scene_truth({path + "," + beside("flags.json")}, mesh);
  else if (name == "flags.json")
    app::read_scene_truth({beside("pairs.json") + "," + path}, mesh);
  else if (name == "toi.csv")
    app::read_query_toi(beside("queries.csv"), {true, false});
  else
    check_sound(app::read_mesh(path));
}

// A byte of a file may become so many, as a word of a long line does, beside what a reader holds anyhow.
constexpr std::int64_t kBytesEach = 40, kBytesAnyhow = 1 << 18;

// Whether it was read.
bool read_or_named(const std::string& path, std::size_t size) {
  const std::int64_t before = held;
  most_held = before;
  std::string message;
  try {
    const MemoryLimit limit;
    read(path);
  } catch (const app::InputError& e) {
    message = e.what();
  }
  REQUIRE(most_held - before <= kBytesAnyhow + kBytesEach * std::int64_t(size));
  if (message.empty()) return true;
  REQUIRE(message.rfind(std::filesystem::path(path).parent_path().string(), 0) == 0);
  REQUIRE(message.find("memory") == message.npos);
  REQUIRE(message.size() < path.size() + 700);
  return false;
}

std::vector<SampleFile> all_files() {
  std::vector<SampleFile> files = onset::tests::mesh_files();
  for (const SampleFile& file : onset::tests::query_files()) files.push_back(file);
  return files;
}

}  // namespace

TEST_CASE("good files are read", "[unit]") {
  const Folder folder;
  for (const SampleFile& file : onset::tests::query_files()) folder.write(file);
  for (const SampleFile& file : all_files()) {
    INFO(file.name << ": " << file.bytes);
    CHECK_NOTHROW(read(folder.write(file)));
  }
}

TEST_CASE("damaged files are read, or named", "[unit]") {
  std::mt19937_64 random(onset::oracle::fuzz_seed() + 2);
  const Folder folder;
  const std::vector<SampleFile> whole = all_files();
  for (const SampleFile& file : whole) folder.write(file);
  std::vector<int> were_read(whole.size()), were_named(whole.size());
  for (int i = 0; i < onset::oracle::fuzz(20000); ++i) {
    const std::size_t k = std::size_t(i) % whole.size();
    SampleFile file = whole[k];
    const int times = 1 + int(random() % 4);
    for (int t = 0; t < times; ++t) onset::tests::damage(file.bytes, random);
    INFO(file.name << ": " << file.bytes);
    const std::string path = folder.write(file);
    ++(read_or_named(path, file.bytes.size()) ? were_read : were_named)[k];
    folder.write(whole[k]);
  }
  for (std::size_t k = 0; k < whole.size(); ++k) {
    INFO(whole[k].name);
    CHECK(were_read[k] > 0);
    CHECK(were_named[k] > 0);
  }
}

// Each row of two bytes or three asks for the most that a row can.
TEST_CASE("memory grows with the bytes of a file, and no faster", "[unit]") {
  const Folder folder;
  constexpr std::size_t kRows = 100000;
  const std::string rows = std::to_string(kRows),
                    vertices = "property char x\nproperty char y\nproperty char z\n";
  const std::string binary = "ply\nformat binary_little_endian 1.0\n";
  std::string points, wires, many_points(3 * kRows, '\1'),
      text = "ply\nformat ascii 1.0\nelement vertex " + rows + "\n";
  for (std::size_t i = 0; i < kRows; ++i) points += std::string("\1\0", 2), wires += std::string("\2\0\1", 3);
  text += vertices + "end_header\n";
  for (std::size_t i = 0; i < kRows; ++i) text += "0 0 1\n";
  std::string obj = "v 0 0 0\nv 0 0 1\n", lines = obj, long_line = obj + "p";
  for (std::size_t i = 0; i < kRows; ++i) obj += "p 1\n", lines += "l 1 2\n", long_line += " 1";
  std::string pairs = "[", flags = "[";
  for (std::size_t i = 0; i < kRows; ++i) pairs += "[3,12],", flags += "true,";
  const std::string list = "property list uchar uchar vertex_indices\n";
  const std::vector<SampleFile> files = {
      {"a.ply", binary + "element face " + rows + "\n" + list + "element vertex 2\n" + vertices +
                    "end_header\n" + points + std::string(6, '\1')},
      {"a.ply", binary + "element face " + rows + "\n" + list + "element vertex 2\n" + vertices +
                    "end_header\n" + wires + std::string(6, '\1')},
      {"a.ply", binary + "element vertex " + rows + "\n" + vertices + "end_header\n" + many_points},
      {"a.ply", text},
      {"a.obj", obj},
      {"a.obj", lines},
      {"a.obj", long_line + "\n"},
      {"pairs.json", pairs + "[3,12]]"},
      {"flags.json", flags + "true]"}};
  for (const SampleFile& file : onset::tests::query_files()) folder.write(file);
  for (const SampleFile& file : files) {
    INFO(file.name << ", " << file.bytes.size() << " bytes: " << file.bytes.substr(0, 100));
    read_or_named(folder.write(file), file.bytes.size());
  }
}
