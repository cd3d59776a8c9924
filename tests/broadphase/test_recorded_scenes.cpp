// Steps of real simulations: the exact number of swept-box overlaps, and no listed contact lost.
#include <onset/mesh.hpp>
#include <set>

#include "tests/broadphase/candidates.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/data.hpp"
#include "tests/scenes/frame_file.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

struct Overlaps {
  const char* scene;
  std::size_t edge_edge, vertex_face;
};
constexpr Overlaps kOverlaps[] = {
    {"cloth-ball", 5197332, 1655541}, {"armadillo-rollers", 5068080, 2031902}, {"cloth-funnel", 33770, 7319}};

std::size_t count(const BroadPhase& phase, PairKind kind) {
  std::size_t total = 0;
  phase.traverse(kind, 0, phase.blocks(kind),
                 {&total, [](void* n, const IdPair*, std::size_t k) { *static_cast<std::size_t*>(n) += k; }});
  return total;
}

void expect_all_contacts(const IdPairs& found, const std::vector<scenes::LabelledPair>& listed,
                         bool ordered) {
  std::size_t missed = 0;
  for (const scenes::LabelledPair& p : listed) {
    if (!p.collides) continue;
    const auto pair = ordered ? std::pair(std::min(p.a, p.b), std::max(p.a, p.b)) : std::pair(p.a, p.b);
    missed += !std::binary_search(found.begin(), found.end(), pair);
  }
  CHECK(missed == 0);
}

}  // namespace

TEST_CASE("recorded scenes: exact overlap counts, and every contact is a candidate", "[oracle]") {
  const std::string data = scenes::data_folder("recorded scenes: exact overlap counts");
  if (data.empty()) return;
  for (const scenes::RecordedStep& step : scenes::recorded_steps()) {
    INFO(step.name);
    const scenes::Recording recording = scenes::read_recording(data, step);
    const Mesh mesh(recording.t0.x, recording.t0.faces);
    const Motion motion = make_motion(mesh.data().num_vertices, recording.t0.x, recording.t1.x);
    for (const Overlaps& known : kOverlaps)
      if (known.scene == std::string(step.name))
        for (const Method& m : methods()) {
          INFO(m.name);
          BroadPhaseInput input{mesh.data(), motion};
          input.test = BoxTest::swept, input.instruction_set = m.instruction_set;
          const auto phase = make_broad_phase(m.method, input);
          CHECK(count(*phase, PairKind::edge_edge) == known.edge_edge);
          CHECK(count(*phase, PairKind::vertex_face) == known.vertex_face);
        }
    const auto phase = make_broad_phase(BroadPhaseMethod::automatic, {mesh.data(), motion});
    expect_all_contacts(candidates(*phase, PairKind::edge_edge), recording.edge_edge, true);
    expect_all_contacts(candidates(*phase, PairKind::vertex_face), recording.vertex_face, false);
  }
}

TEST_CASE("cloth-funnel: every method agrees with brute force", "[oracle]") {
  const std::string data = scenes::data_folder("cloth-funnel: every method agrees with brute force");
  if (data.empty()) return;
  for (const scenes::RecordedStep& step : scenes::recorded_steps()) {
    if (std::string(step.name) != "cloth-funnel") continue;
    const scenes::Recording recording = scenes::read_recording(data, step);
    const Mesh mesh(recording.t0.x, recording.t0.faces);
    const Motion motion = make_motion(mesh.data().num_vertices, recording.t0.x, recording.t1.x);
    for (BoxTest test : {BoxTest::swept, BoxTest::both_ends, BoxTest::moving}) {
      BroadPhaseInput input{mesh.data(), motion};
      input.test = test;
      const auto brute = make_broad_phase(BroadPhaseMethod::brute, input);
      for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
        const IdPairs expected = candidates(*brute, kind);
        for (const Method& m : methods()) {
          INFO(m.name);
          input.instruction_set = m.instruction_set;
          CHECK((candidates(*make_broad_phase(m.method, input), kind) == expected));
        }
      }
    }
  }
}
