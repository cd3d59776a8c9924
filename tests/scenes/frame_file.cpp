#include "tests/scenes/frame_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace onset::scenes {

namespace {

class Reader {
 public:
  Reader(std::istream& stream, bool big_endian) : stream_(stream), big_endian_(big_endian) {}
  template <class T>
  T next() {
    char bytes[sizeof(T)];
    if (!stream_.read(bytes, sizeof bytes)) throw std::runtime_error("file ends early");
    if (big_endian_) std::reverse(bytes, bytes + sizeof bytes);  // the machine is little endian
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

 private:
  std::istream& stream_;
  bool big_endian_;
};

struct Header {
  bool big_endian = false, doubles = false;
  int vertices = 0, faces = 0;
};

Header read_header(std::istream& stream) {
  Header header;
  int coordinates = 0;
  for (std::string line; std::getline(stream, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string keyword, type, name;
    words >> keyword >> type >> name;
    if (keyword == "format") {
      if (type == "ascii") throw std::runtime_error("not binary");
      header.big_endian = type == "binary_big_endian";
    } else if (keyword == "element") {
      (type == "vertex" ? header.vertices : header.faces) = std::stoi(name);
    } else if (keyword == "property" && type != "list") {
      header.doubles = type == "double" || type == "float64";
      ++coordinates;
    }
  }
  if (coordinates != 3) throw std::runtime_error("not three coordinates a vertex");
  return header;
}

Frame read(std::istream& stream) {
  const Header header = read_header(stream);
  Reader reader(stream, header.big_endian);
  Frame frame{Eigen::MatrixXd(header.vertices, 3), Eigen::MatrixXi(header.faces, 3)};
  for (int v = 0; v < header.vertices; ++v)
    for (int k = 0; k < 3; ++k) frame.x(v, k) = header.doubles ? reader.next<double>() : reader.next<float>();
  for (int f = 0; f < header.faces; ++f) {
    if (reader.next<std::uint8_t>() != 3) throw std::runtime_error("a face that is no triangle");
    for (int k = 0; k < 3; ++k) frame.faces(f, k) = reader.next<std::int32_t>();
  }
  return frame;
}

nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  return nlohmann::json::parse(file);
}

// Box ids run over vertices, then edges, then faces.
std::vector<LabelledPair> read_pairs(const std::string& folder, const std::string& step, int first_a,
                                     int first_b) {
  const auto boxes = read_json(folder + "/boxes/" + step + ".json");
  const auto truth = read_json(folder + "/mma_bool/" + step + "_mma_bool.json");
  if (boxes.size() != truth.size()) throw std::runtime_error(folder + ": boxes and truth differ in length");
  std::vector<LabelledPair> pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    int a = boxes[i][0], b = boxes[i][1];
    if (first_a != first_b && a > b) std::swap(a, b);  // the vertex has the smaller id
    pairs.push_back({a - first_a, b - first_b, truth[i]});
  }
  return pairs;
}

int count_edges(const Eigen::MatrixXi& faces) {
  std::vector<std::pair<int, int>> edges;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({faces(f, k), faces(f, (k + 1) % 3)}));
  std::sort(edges.begin(), edges.end());
  return int(std::unique(edges.begin(), edges.end()) - edges.begin());
}

}  // namespace

Frame read_frame(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot open " + path);
  try {
    return read(file);
  } catch (const std::exception& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

const std::vector<RecordedStep>& recorded_steps() {
  static const std::vector<RecordedStep> steps{
      {"cloth-funnel", "", 227}, {"armadillo-rollers", "", 326}, {"cloth-ball", "cloth_ball", 92}};
  return steps;
}

Recording read_recording(const std::string& data_folder, const RecordedStep& step) {
  const std::string folder = data_folder + "/scenes/" + step.name;
  const auto frame = [&](int number) {
    return read_frame(folder + "/frames/" + step.frame + std::to_string(number) + ".ply");
  };
  Recording recording{frame(step.number), frame(step.number + 1), {}, {}};
  const int vertices = int(recording.t0.x.rows()), edges = count_edges(recording.t0.faces);
  const std::string number = std::to_string(step.number);
  recording.vertex_face = read_pairs(folder, number + "vf", 0, vertices + edges);
  recording.edge_edge = read_pairs(folder, number + "ee", vertices, vertices);
  return recording;
}

Query query_of(const Recording& recording, PairKind kind, const LabelledPair& pair,
               const std::vector<std::array<int, 2>>& edges) {
  std::array<int, 4> ids;
  if (kind == PairKind::vertex_face) {
    const auto face = recording.t0.faces.row(pair.b);
    ids = {pair.a, face[0], face[1], face[2]};
  } else {
    const auto a = edges.at(std::size_t(pair.a)), b = edges.at(std::size_t(pair.b));
    ids = {a[0], a[1], b[0], b[1]};
  }
  Query query;
  query.kind = kind;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      query.t0[i][k] = recording.t0.x(ids[i], k);
      query.t1[i][k] = recording.t1.x(ids[i], k);
    }
  return query;
}

}  // namespace onset::scenes
