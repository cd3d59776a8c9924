// A broad phase that sorts anew in each refit frees what it had before.
#include <tbb/task_arena.h>

#include "broadphase/broad_phase.hpp"
#include "tests/catch.hpp"
#include "tests/faults/allocations.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;
using namespace onset::tests;

TEST_CASE("a refit of the hash takes no more memory at once than making it does", "[property]") {
  scenes::Random random(47);
  constexpr int kEdges = 50000;
  MeshData mesh;
  mesh.num_vertices = 2 * kEdges;
  std::vector<double> x;
  for (int e = 0; e < kEdges; ++e) {
    mesh.edges.push_back({2 * e, 2 * e + 1});
    for (int i = 0; i < 3; ++i) x.push_back(scenes::uniform(random, -1, 1));
    for (int i = 0; i < 3; ++i) x.push_back(x[x.size() - 3] + scenes::uniform(random, -0.01, 0.01));
  }
  const Motion motion =
      make_motion(mesh.num_vertices, {x.data(), mesh.num_vertices}, {x.data(), mesh.num_vertices});
  tbb::task_arena(1).execute([&] {
    most_bytes_since();
    const auto phase = make_broad_phase(BroadPhaseMethod::hash, {mesh, motion});
    const std::int64_t made = most_bytes_since();
    phase->refit({mesh, motion});
    CHECK(double(most_bytes_since()) <= 1.01 * double(made));
  });
}
