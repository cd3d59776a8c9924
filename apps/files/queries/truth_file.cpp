#include "files/queries/truth_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "files/error.hpp"
#include "files/input_output.hpp"

namespace app {
namespace {

using Ids = std::vector<std::array<std::int64_t, 2>>;

template <class T>
T read_json(const std::string& path) {
  std::ifstream in = open_input(path);
  try {
    return nlohmann::json::parse(in).get<T>();
  } catch (const nlohmann::json::exception& e) {
    throw InputError(path + ": " + e.what());
  }
}

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
  const Ids pairs = read_json<Ids>(pairs_path);
  const auto collides = read_json<std::vector<bool>>(collides_path);
  if (pairs.size() != collides.size())
    throw InputError(collides_path + ": " + std::to_string(collides.size()) + " values for " +
                     std::to_string(pairs.size()) + " pairs");
  const BoxIds ids(mesh);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    try {
      const std::uint64_t key = ids.key(pairs[i]);
      if (collides[i]) truth.push_back({key, {}});
    } catch (const InputError& e) {
      throw InputError(pairs_path + ": " + e.what());
    }
  }
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

double number(const std::string& text) {
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (text.empty() || (*end != '\0' && *end != '\r')) throw InputError("'" + text + "' is not a number");
  return x;
}

CollidingPair colliding_pair(const std::vector<std::string>& row, const onset::Mesh& mesh) {
  if (row.size() < 3 || row.size() > 5 || (row[0] != "vf" && row[0] != "ee"))
    throw InputError("kind,a,b,toi_lo,toi_hi expected");
  const bool vf = row[0] == "vf";
  const double a = number(row[1]), b = number(row[2]);
  const double rows_a = double(vf ? mesh.num_vertices() : mesh.num_edges()),
               rows_b = double(vf ? mesh.num_faces() : mesh.num_edges());
  if (!(a >= 0 && a < rows_a && b >= 0 && b < rows_b)) throw InputError("ids that this mesh does not have");
  CollidingPair pair{pair_key(vf ? onset::PairKind::vertex_face : onset::PairKind::edge_edge, int(a), int(b)),
                     {}};
  if (row.size() == 5 && !row[3].empty()) pair.toi = {number(row[3]), number(row[4])};
  return pair;
}

void add_rows(SceneTruth& truth, const std::string& path, const onset::Mesh& mesh) {
  std::ifstream in = open_input(path);
  std::string line;
  std::getline(in, line);
  for (std::size_t at = 2; std::getline(in, line); ++at) {
    try {
      truth.push_back(colliding_pair(fields(line), mesh));
    } catch (const InputError& e) {
      throw InputError(path + ":" + std::to_string(at) + ": " + e.what());
    }
  }
}

}  // namespace

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

std::vector<ExactToi> read_query_toi(const std::string& path, const std::vector<bool>& collides) {
  const std::filesystem::path beside = std::filesystem::path(path).parent_path() / "toi.csv";
  if (!std::filesystem::exists(beside)) return {};
  std::ifstream in = open_input(beside.string());
  std::vector<ExactToi> times;
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> row = fields(line);
    const std::string place = beside.string() + ":" + std::to_string(times.size() + 1) + ": ";
    if (row.size() != 2) throw InputError(place + "lo,hi expected");
    const auto time = [&](const std::string& word) {
      try {
        return number(word);
      } catch (const InputError& e) {
        throw InputError(place + e.what());
      }
    };
    const ExactToi toi{time(row[0]), time(row[1])};
    if (times.size() < collides.size() && std::isfinite(toi.lo) != bool(collides[times.size()]))
      throw InputError(place + "contradicts the truth of the query");
    times.push_back(toi);
  }
  if (times.size() != collides.size())
    throw InputError(beside.string() + ": " + std::to_string(times.size()) + " rows for " +
                     std::to_string(collides.size()) + " queries");
  return times;
}

}  // namespace app
