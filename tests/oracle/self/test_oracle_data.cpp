// Agreement with the truth that Mathematica computed: the hand-made benchmark and steps of real simulations.
#include "onset/mesh.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/queries/query_file.hpp"
#include "tests/scenes/data.hpp"
#include "tests/scenes/families.hpp"
#include "tests/scenes/frame_file.hpp"

using namespace onset;

TEST_CASE("the oracle agrees with every hand-made query", "[oracle][data]") {
  const std::string folder = scenes::data_folder("the oracle agrees with every hand-made query");
  if (folder.empty()) return;
  int queries = 0, collisions = 0;
  for (const scenes::QueryFile& file : scenes::query_files(folder))
    for (const scenes::LabelledQuery& labelled : scenes::read_queries(file.path, file.kind)) {
      const oracle::Truth truth = oracle::exact_ccd(labelled.query);
      if (truth.collides != labelled.collides) FAIL_CHECK(file.path << " " << to_text(labelled.query));
      ++queries, collisions += truth.collides;
    }
  CHECK(queries > 2000);
  CHECK(collisions > 100);
}

TEST_CASE("the oracle agrees with the truth of recorded steps", "[oracle][data]") {
  const std::string folder = scenes::data_folder("the oracle agrees with the truth of recorded steps");
  if (folder.empty()) return;
  for (const scenes::RecordedStep& step : scenes::recorded_steps()) {
    const scenes::Recording recording = scenes::read_recording(folder, step);
    const auto edges = edge_list(recording.t0.faces);
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      const auto& pairs = kind == PairKind::vertex_face ? recording.vertex_face : recording.edge_edge;
      const std::size_t stride = std::max<std::size_t>(1, pairs.size() / 1000);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i % stride != 0 && pairs[i].collides) continue;  // every free pair, a sample of the others
        const scenes::Query query = scenes::query_of(recording, kind, pairs[i], edges);
        if (oracle::exact_ccd(query).collides != pairs[i].collides)
          FAIL_CHECK(step.name << " " << i << to_text(query));
      }
    }
  }
}

// The order of the edges and of the points: the step's own list of queries says the same as frames and ids.
TEST_CASE("queries made from frames equal the recorded queries", "[oracle][data]") {
  const std::string folder = scenes::data_folder("queries made from frames equal the recorded queries");
  if (folder.empty()) return;
  const scenes::RecordedStep& step = scenes::recorded_steps().front();
  const scenes::Recording recording = scenes::read_recording(folder, step);
  const auto edges = edge_list(recording.t0.faces);
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    const auto& pairs = kind == PairKind::vertex_face ? recording.vertex_face : recording.edge_edge;
    const std::string suffix = kind == PairKind::vertex_face ? "vf.csv" : "ee.csv";
    const auto recorded = scenes::read_queries(
        folder + "/scenes/" + step.name + "/queries/" + std::to_string(step.number) + suffix, kind);
    REQUIRE(recorded.size() == pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const scenes::Query query = scenes::query_of(recording, kind, pairs[i], edges);
      CHECK(query.t0 == recorded[i].query.t0);
      CHECK(query.t1 == recorded[i].query.t1);
    }
  }
}
