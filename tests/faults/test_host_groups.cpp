// A host that cancels its own work, or one of whose tasks throws, cancels nothing of the library's: answers
// are those of a clean process, and so is what a mesh keeps for later calls.
#include <tbb/parallel_for.h>
#include <tbb/task.h>
#include <tbb/task_group.h>

#include <atomic>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/src/support/every_call.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

// Large enough for loops of more than one chunk.
Subject two_spheres() { return Subject("spheres", scenes::sphere_onto_sphere(20, 30, 0.01, 0.3)); }

// Cancels the group of tasks that it is called in.
void cancel_here() { tbb::task::current_context()->cancel_group_execution(); }

}  // namespace

TEST_CASE("a call in a group of tasks that is cancelled answers as ever", "[faults]") {
  const Subject s = two_spheres();
  for (const Call& call : every_call())
    for (const int threads : {0, 2}) {
      Options o;
      o.threads = threads;
      const Answer clean = call(s.mesh(), s, o);
      const Mesh mesh = s.mesh();
      Answer inside;
      tbb::task_group group;
      group.run_and_wait([&] {
        group.cancel();
        inside = call(mesh, s, o);
      });
      CAPTURE(call.name, threads);
      CHECK(inside == clean);
      CHECK(call(mesh, s, o) == clean);  // by what the first one left
    }
}

TEST_CASE("meshes are made in a group of tasks that is cancelled", "[faults]") {
  const Subject s = two_spheres();
  const auto edges_of = [&] { return edge_list(s.scene.faces); };
  const auto all = edges_of();
  auto inside = all;
  inside.clear();
  tbb::task_group group;
  group.run_and_wait([&] {
    group.cancel();
    inside = edges_of();
  });
  CHECK(inside == all);
}

TEST_CASE("a call beside one that throws answers as ever", "[faults]") {
  const Subject s = two_spheres();
  const Eigen::MatrixXd too_few = s.scene.x_t0.topRows(3);
  const double clean = compute_collision_free_stepsize(s.mesh(), s.scene.x_t0, s.scene.x_t1).step;
  REQUIRE(clean < 1);
  for (int round = 0; round < 50; ++round) {
    const Mesh mesh = s.mesh();
    double inside = clean;
    CHECK_THROWS_AS(tbb::parallel_for(
                        0, 2,
                        [&](int i) {
                          if (i == 0)
                            inside = compute_collision_free_stepsize(mesh, s.scene.x_t0, s.scene.x_t1).step;
                          else
                            compute_collision_free_stepsize(mesh, too_few, too_few);
                        },
                        tbb::simple_partitioner()),
                    std::invalid_argument);
    CHECK(inside == clean);
    CHECK(compute_collision_free_stepsize(mesh, s.scene.x_t0, s.scene.x_t1).step == clean);
  }
}

TEST_CASE("callbacks that cancel the tasks around them cancel nothing of the call", "[faults]") {
  const Subject s = two_spheres();
  for (const Call& call : every_call()) {
    if (!call.reports) continue;
    for (const int threads : {0, 2}) {
      Options o, cancels;
      o.threads = cancels.threads = threads;
      cancels.progress = [](double) {
        cancel_here();
        return true;
      };
      const Answer clean = call(s.mesh(), s, o);
      const Mesh mesh = s.mesh();
      CAPTURE(call.name, threads);
      CHECK(call(mesh, s, cancels) == clean);
      CHECK(call(mesh, s, o) == clean);
    }
  }
  const Mesh mesh = s.mesh();
  const std::int64_t pairs = compute_candidates(mesh, s.scene.x_t0, s.scene.x_t1).counts.total();
  std::atomic<std::int64_t> visited{0};
  visit_candidates(mesh, s.scene.x_t0, s.scene.x_t1,
                   [&](PairKind, const std::array<int, 2>*, std::size_t count) {
                     visited += std::int64_t(count);
                     cancel_here();
                   });
  CHECK(visited == pairs);
}

TEST_CASE("a visitor that throws ends no call that another one makes", "[faults]") {
  const Subject s = two_spheres();
  const double clean = compute_collision_free_stepsize(s.mesh(), s.scene.x_t0, s.scene.x_t1).step;
  Options two;
  two.threads = 2;
  for (int round = 0; round < 20; ++round) {
    const Mesh mesh = s.mesh(), other = s.mesh();
    std::atomic<int> turn{0};
    double inside = clean;
    try {
      visit_candidates(
          mesh, s.scene.x_t0, s.scene.x_t1,
          [&](PairKind, const std::array<int, 2>*, std::size_t) {
            const int mine = turn++;
            if (mine == 0) inside = compute_collision_free_stepsize(other, s.scene.x_t0, s.scene.x_t1).step;
            if (mine == 1) throw std::runtime_error("a visitor's");
          },
          two);
    } catch (const std::runtime_error&) {
    }
    CHECK(inside == clean);
    CHECK(compute_collision_free_stepsize(other, s.scene.x_t0, s.scene.x_t1).step == clean);
  }
}
