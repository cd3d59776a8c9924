// Any number of threads, either kernel, any broad phase, every run: the same bytes.
#include <tbb/global_control.h>

#include <cstdio>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/scenes/data.hpp"
#include "tests/scenes/frame_file.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

struct Answers {
  ActiveSet active;
  StepResult step;
};
Answers ask(const Mesh& mesh, const scenes::Scene& scene, const Options& o) {
  return {construct_active_set(mesh, scene.x_t0, scene.x_t1, o),
          compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1, o)};
}
bool same_bytes(const Answers& a, const Answers& b) {
  return tests::same_bytes(a.active, b.active) && tests::same_bytes(a.step, b.step);
}

// The methods that this build has.
std::vector<BroadPhaseMethod> broad_phases() {
  std::vector<BroadPhaseMethod> all;
  const Mesh mesh(Eigen::MatrixXd::Zero(1, 3), Eigen::MatrixXi(0, 3));
  for (BroadPhaseMethod method : {BroadPhaseMethod::brute, BroadPhaseMethod::bvh, BroadPhaseMethod::hash}) {
    Options o;
    o.broad_phase = method;
    try {
      compute_candidates(mesh, Eigen::MatrixXd::Zero(1, 3), Eigen::MatrixXd::Zero(1, 3), o);
      all.push_back(method);
    } catch (const std::invalid_argument& e) {
      std::printf("skipped: broad phase %d (%s)\n", int(method), e.what());
    }
  }
  return all;
}

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

}  // namespace

TEST_CASE("threads and kernels give the same bytes, run after run", "[determinism][simd]") {
  for (const NamedScene& named : some_scenes())
    for (double separation : {0.0, 0.02}) {
      const Mesh mesh = named.mesh();
      Options o;
      o.min_separation = separation;
      o.threads = 1;
      o.instruction_set = InstructionSet::scalar;
      const Answers reference = ask(mesh, named.scene, o);
      for (InstructionSet kernel : kernels())
        for (int threads : {0, 1, 2, 4})
          for (int run = 0; run < 2; ++run) {
            o.instruction_set = kernel;
            o.threads = threads;
            CAPTURE(named.name, threads, to_string(kernel), run);
            CHECK(same_bytes(reference, ask(mesh, named.scene, o)));
          }
    }
}

TEST_CASE("what earlier calls left on a mesh changes no byte", "[determinism]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh used = named.mesh();
    scenes::Scene scene = named.scene;
    for (int round = 0; round < 5; ++round) {
      for (BroadPhaseMethod method : broad_phases()) {
        Options o;
        o.broad_phase = method;
        o.check_limit = round == 3 ? 200 : Options{}.check_limit;
        CAPTURE(named.name, round, int(method));
        CHECK(same_bytes(ask(named.mesh(), scene, o), ask(used, scene, o)));
      }
      if (round == 2) used.release_memory();
      // A little later; in the last round, all vertices elsewhere.
      const Eigen::MatrixXd moved = scene.x_t1 - scene.x_t0;
      scene.x_t0 += 0.3 * moved, scene.x_t1 += 0.3 * moved;
      if (round == 3) scene.x_t0.col(0).reverseInPlace(), scene.x_t1.col(0).reverseInPlace();
    }
  }
}

// A pair that spends its budget stops early: whether it is looked at must not depend on what was found before
// it.
TEST_CASE("spent budgets give the same bytes whatever the order of work", "[determinism][simd]") {
  for (const NamedScene& named : some_scenes())
    for (std::int64_t budget : {1, 2, 3, 5}) {
      const Mesh mesh = named.mesh();
      Options o;
      o.max_checks = budget;
      o.threads = 1;
      o.broad_phase = BroadPhaseMethod::brute;
      const Answers reference = ask(mesh, named.scene, o);
      for (BroadPhaseMethod method : broad_phases())
        for (int threads : {1, 2, 4}) {
          o.broad_phase = method;
          o.threads = threads;
          CAPTURE(named.name, budget, int(method), threads);
          CHECK(same_bytes(reference, ask(mesh, named.scene, o)));
        }
    }
}

TEST_CASE("every broad phase gives the same active set and step", "[determinism]") {
  const auto methods = broad_phases();
  for (const NamedScene& named : some_scenes())
    for (double separation : {0.0, 0.02, 0.3}) {
      const Mesh mesh = named.mesh();
      Options o;
      o.min_separation = separation;
      o.broad_phase = BroadPhaseMethod::brute;
      const Answers reference = ask(mesh, named.scene, o);
      o.broad_phase = BroadPhaseMethod::automatic;
      CHECK(same_bytes(reference, ask(mesh, named.scene, o)));
      for (BroadPhaseMethod method : methods) {
        o.broad_phase = method;
        CAPTURE(named.name, int(method), separation);
        CHECK(same_bytes(reference, ask(mesh, named.scene, o)));
      }
    }
}

TEST_CASE("recorded steps give the same bytes on both kernels and any number of threads",
          "[determinism][simd][data]") {
  const std::string folder =
      scenes::data_folder("recorded steps give the same bytes on both kernels and any number of threads");
  if (folder.empty()) return;
  for (const scenes::RecordedStep& step : scenes::recorded_steps()) {
    const scenes::Recording recording = scenes::read_recording(folder, step);
    const Mesh mesh(recording.t0.x, recording.t0.faces);
    const scenes::Scene scene{recording.t0.x, recording.t1.x, recording.t0.faces};
    Options o;
    o.threads = 1;
    o.instruction_set = InstructionSet::scalar;
    const Answers reference = ask(mesh, scene, o);
    CHECK(reference.active.size() > 0);
    for (InstructionSet kernel : kernels())
      for (int threads : {2, 4}) {
        o.instruction_set = kernel;
        o.threads = threads;
        CAPTURE(step.name, threads, to_string(kernel));
        CHECK(same_bytes(reference, ask(mesh, scene, o)));
      }
  }
}
