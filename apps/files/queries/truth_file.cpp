#include "files/queries/truth_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/queries/json_lists.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

constexpr char kTruthColumns[] = "kind,a,b,toi_lo,toi_hi";

// Ids that run over vertices, edges and faces.
class BoxIds {
 public:
  explicit BoxIds(const onset::Mesh& mesh)
      : vertices_(mesh.num_vertices()), edges_(mesh.num_edges()), faces_(mesh.num_faces()) {}

  std::uint64_t key(std::array<std::int64_t, 2> ids) const {
    const auto [a, b] = std::minmax(ids[0], ids[1]);
    const std::int64_t first_face = vertices_ + edges_;
    if (a >= 0 && a < vertices_ && b >= first_face && b < first_face + faces_)
      return pair_key(onset::PairKind::vertex_face, int(a), int(b - first_face));
    if (a >= vertices_ && a < b && b < first_face)
      return pair_key(onset::PairKind::edge_edge, int(a - vertices_), int(b - vertices_));
    throw InputError("[" + std::to_string(ids[0]) + ", " + std::to_string(ids[1]) +
                     "] is neither a vertex and a face nor two edges of this mesh");
  }

 private:
  std::int64_t vertices_, edges_, faces_;
};

void add_listed(SceneTruth& truth, const std::string& pairs_path, const std::string& collides_path,
                const onset::Mesh& mesh) {
  const std::vector<std::array<std::int64_t, 2>> pairs = read_id_pairs(pairs_path);
  const std::vector<bool> collides = read_flags(collides_path);
  if (pairs.size() != collides.size())
    throw InputError(collides_path + ": " + std::to_string(collides.size()) + " values for " +
                     std::to_string(pairs.size()) + " pairs");
  const BoxIds ids(mesh);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    try {
      const std::uint64_t key = ids.key(pairs[i]);
      if (collides[i]) truth.push_back({key, {}});
    } catch (const InputError& e) {
      throw InputError(pairs_path + ": entry " + std::to_string(i) + ": " + e.what());
    }
  }
}

std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    parts.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// Hexadecimal too, as C writes doubles exactly.
double number(std::string_view field) {
  const std::string text(field);
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw InputError(quoted(field) + " is not a number");
  return x;
}

ExactToi exact_toi(std::string_view lo, std::string_view hi) {
  const ExactToi toi{number(lo), number(hi)};
  if (!toi.known()) throw InputError(quoted(lo) + " is not at most " + quoted(hi));
  return toi;
}

int id(std::string_view field, std::int64_t count, const char* of) {
  const std::optional<std::int64_t> value = parse_whole(field);
  if (!value || *value < 0 || *value >= count)
    throw InputError(quoted(field) + " is no id of the " + std::to_string(count) + " " + of);
  return int(*value);
}

CollidingPair colliding_pair(const std::vector<std::string_view>& row, const onset::Mesh& mesh) {
  if (row.size() < 3 || row.size() > 5 || (row[0] != "vf" && row[0] != "ee"))
    throw InputError(std::string(kTruthColumns) + " expected");
  const bool vf = row[0] == "vf";
  const int a = id(row[1], vf ? mesh.num_vertices() : mesh.num_edges(), vf ? "vertices" : "edges"),
            b = id(row[2], vf ? mesh.num_faces() : mesh.num_edges(), vf ? "faces" : "edges");
  CollidingPair pair{pair_key(vf ? onset::PairKind::vertex_face : onset::PairKind::edge_edge, a, b), {}};
  if (row.size() == 5 && !row[3].empty()) pair.toi = exact_toi(row[3], row[4]);
  return pair;
}

void add_rows(SceneTruth& truth, const std::string& path, const onset::Mesh& mesh) {
  InputLines lines(path);
  std::string_view line;
  if (!lines.next(line)) throw InputError(path + ": the file is empty, " + kTruthColumns + " expected");
  if (fields(line)[0] != "kind") lines.fail(std::string(kTruthColumns) + " expected, not " + quoted(line));
  while (lines.next(line)) {
    try {
      truth.push_back(colliding_pair(fields(line), mesh));
    } catch (const InputError& e) {
      lines.fail(e.what());
    }
  }
}

}  // namespace

std::vector<std::string> truth_paths(const std::vector<std::string>& files) {
  std::vector<std::string> paths;
  for (const std::string& file : files) {
    const std::size_t comma = std::min(file.find(','), file.size());
    paths.push_back(file.substr(0, comma));
    if (comma < file.size()) paths.push_back(file.substr(comma + 1));
  }
  return paths;
}

SceneTruth read_scene_truth(const std::vector<std::string>& files, const onset::Mesh& mesh) {
  SceneTruth truth;
  for (const std::string& file : files) {
    const std::size_t comma = file.find(',');
    if (comma == file.npos)
      add_rows(truth, file, mesh);
    else
      add_listed(truth, file.substr(0, comma), file.substr(comma + 1), mesh);
  }
  const auto earlier = [](const CollidingPair& x, const CollidingPair& y) { return x.key < y.key; };
  std::sort(truth.begin(), truth.end(), earlier);
  const auto same = [](const CollidingPair& x, const CollidingPair& y) { return x.key == y.key; };
  truth.erase(std::unique(truth.begin(), truth.end(), same), truth.end());
  return truth;
}

std::string query_toi_path(const std::string& path) {
  return (std::filesystem::path(path).parent_path() / "toi.csv").string();
}

std::vector<ExactToi> read_query_toi(const std::string& path, const std::vector<bool>& collides) {
  const std::string beside = query_toi_path(path);
  if (!std::filesystem::exists(beside)) return {};
  InputLines lines(beside);
  std::vector<ExactToi> times;
  for (std::string_view line; lines.next(line);) {
    try {
      const std::vector<std::string_view> row = fields(line);
      if (row.size() != 2) throw InputError("lo,hi expected");
      times.push_back(exact_toi(row[0], row[1]));
    } catch (const InputError& e) {
      lines.fail(e.what());
    }
    const std::size_t i = times.size() - 1;
    if (i < collides.size() && std::isfinite(times[i].lo) != bool(collides[i]))
      lines.fail("contradicts the truth of the query");
  }
  if (times.size() != collides.size())
    throw InputError(beside + ": " + std::to_string(times.size()) + " rows for " +
                     std::to_string(collides.size()) + " queries");
  return times;
}

}  // namespace app
