// Writes queries of the recorded data with exact truth and exact times of impact, for any program to be
// asked.
//
//   onset_recorded_queries DATA FOLDER [SAMPLE]
//
// DATA: the folder that ONSET_DATA names. FOLDER/handmade/<scene>: the hand-made queries of Wang et al. 2021.
// FOLDER/scenes/<scene>: of all pairs of each kind whose swept boxes overlap about SAMPLE, evenly chosen
// (query_folder.hpp); FOLDER/scenes/<scene>/truth.csv: every pair that collides, kind,a,b,toi_lo,toi_hi, with
// times for about SAMPLE of each kind, evenly chosen. Throws where the oracle and the data disagree.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "onset/onset.hpp"
#include "tests/accuracy/query_folder.hpp"
#include "tests/queries/query_file.hpp"
#include "tests/scenes/frame_file.hpp"

using namespace onset;

namespace {

const PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};

// Every n-th, so that about `sample` of `count` are left.
std::size_t stride(std::size_t count, std::size_t sample) {
  return std::max<std::size_t>(1, (count + sample - 1) / std::max<std::size_t>(1, sample));
}

void must_agree(bool mine, bool theirs, const std::string& where) {
  if (mine != theirs) throw std::runtime_error(where + ": the oracle and the data disagree");
}

void write_handmade(const std::string& data, const std::string& folder) {
  for (const scenes::QueryFile& file : scenes::query_files(data)) {
    const auto scene = std::filesystem::path(file.path).parent_path().parent_path().filename();
    accuracy::QueryFolder to(folder + "/handmade/" + scene.string(), file.kind);
    for (const scenes::LabelledQuery& q : scenes::read_queries(file.path, file.kind))
      must_agree(to.add(q.query).collides, q.collides, file.path);
    to.close();
  }
}

// The listed pairs of one kind, those that collide sorted.
struct Listed {
  std::vector<std::array<int, 2>> collide;
  bool operator()(const std::array<int, 2>& pair) const {
    return std::binary_search(collide.begin(), collide.end(), pair);
  }
};

Listed colliding(const std::vector<scenes::LabelledPair>& pairs) {
  Listed listed;
  for (const scenes::LabelledPair& p : pairs)
    if (p.collides) listed.collide.push_back({p.a, p.b});
  std::sort(listed.collide.begin(), listed.collide.end());
  return listed;
}

class Scene {
 public:
  Scene(const std::string& data, const scenes::RecordedStep& step)
      : recording_(scenes::read_recording(data, step)), edges_(edge_list(recording_.t0.faces)) {}

  void write(const std::string& folder, std::size_t sample) {
    const Mesh mesh(recording_.t0.x, recording_.t0.faces);
    const Candidates candidates = compute_candidates(mesh, recording_.t0.x, recording_.t1.x);
    std::filesystem::create_directories(folder);
    std::ofstream truth(folder + "/truth.csv");
    truth << "kind,a,b,toi_lo,toi_hi\n";
    for (PairKind kind : kKinds) {
      const bool vf = kind == PairKind::vertex_face;
      const Listed listed = colliding(vf ? recording_.vertex_face : recording_.edge_edge);
      write_candidates(folder, kind, vf ? candidates.vertex_face : candidates.edge_edge, listed, sample);
      write_truth(truth, kind, listed, sample);
    }
    truth.close();
    if (!truth) throw std::runtime_error(folder + "/truth.csv: cannot be written");
  }

 private:
  scenes::Query query(PairKind kind, const std::array<int, 2>& pair) const {
    return scenes::query_of(recording_, kind, {pair[0], pair[1], false}, edges_);
  }

  void write_candidates(const std::string& folder, PairKind kind,
                        const std::vector<std::array<int, 2>>& pairs, const Listed& listed,
                        std::size_t sample) {
    accuracy::QueryFolder to(folder, kind);
    for (std::size_t i = 0; i < pairs.size(); i += stride(pairs.size(), sample))
      must_agree(to.add(query(kind, pairs[i])).collides, listed(pairs[i]), folder);
    to.close();
  }

  void write_truth(std::ofstream& out, PairKind kind, const Listed& listed, std::size_t sample) {
    const std::size_t every = stride(listed.collide.size(), sample);
    for (std::size_t i = 0; i < listed.collide.size(); ++i) {
      const auto& pair = listed.collide[i];
      out << (kind == PairKind::vertex_face ? "vf," : "ee,") << pair[0] << "," << pair[1] << ",";
      if (i % every == 0) {
        const oracle::Truth exact = oracle::exact_ccd(query(kind, pair));
        out << accuracy::hexadecimal(exact.toi_lo) << "," << accuracy::hexadecimal(exact.toi_hi);
      } else {
        out << ",";
      }
      out << "\n";
    }
  }

  scenes::Recording recording_;
  std::vector<std::array<int, 2>> edges_;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3 || argc > 4) throw std::runtime_error("usage: onset_recorded_queries DATA FOLDER [SAMPLE]");
  const std::string data = argv[1], folder = argv[2];
  const std::size_t sample = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 5000;
  write_handmade(data, folder);
  for (const scenes::RecordedStep& step : scenes::recorded_steps())
    Scene(data, step).write(folder + "/scenes/" + step.name, sample);
} catch (const std::exception& e) {
  std::fprintf(stderr, "onset_recorded_queries: %s\n", e.what());
  return 1;
}
