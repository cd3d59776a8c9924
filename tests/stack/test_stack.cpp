// No call needs more than 64 KiB of a thread's stack, what TBB needs among it, but beyond what the system
// puts there. It is measured in optimised builds: others have frames several times as large.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstdio>
#include <map>
#include <string>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/src/support/every_call.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/stack/painted_threads.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

constexpr std::size_t kMost = 64 << 10;

// Two threads even where there are fewer cores.
const tbb::global_control two_threads(tbb::global_control::max_allowed_parallelism, 2);

bool is_measured(const char* what) {
#ifdef ONSET_PAINTS_THREADS
  (void)what;
  return true;
#else
  std::printf("skipped: %s (not an optimised build)\n", what);
  return false;
#endif
}

// What the system needs of a stack before anything is called.
std::size_t bare() {
  static const std::size_t used = stack_used_by([] {});
  return used;
}

struct Deepest {
  std::size_t used = 0;
  std::string what;
  void add(std::size_t bytes, const std::string& who) {
    if (bytes > used) used = bytes, what = who;
  }
  void check(const std::string& name) const {
    std::printf("%s: %zu bytes, beyond %zu that the thread needs (%s)\n", name.c_str(), used - bare(), bare(),
                what.c_str());
    CHECK(used <= bare() + kMost);
  }
};

// Every way that a pair may be decided in.
std::vector<Options> settings() {
  std::vector<Options> all;
  for (const Exactness exactness : {Exactness::conservative, Exactness::certify, Exactness::exact})
    for (const NarrowPhaseMethod method : {NarrowPhaseMethod::automatic, NarrowPhaseMethod::inclusion}) {
      Options o;
      o.exactness = exactness, o.narrow_phase = method;
      all.push_back(o);
      o.norm = Norm::maximum, o.min_separation = 1e-3;
      all.push_back(o);
    }
  all.emplace_back(), all.back().min_separation = 1e-3;
  all.emplace_back(), all.back().max_checks = 1;
  all.emplace_back(), all.back().instruction_set = InstructionSet::scalar;
  all.emplace_back(), all.back().broad_phase = BroadPhaseMethod::hash;
  all.emplace_back(), all.back().broad_phase = BroadPhaseMethod::brute;
  return all;
}

// The vertex meets the plane of the face, or the face is flat, at three times that are closer to each other
// and to the start than 1e-300 / size.
scenes::Query roots_close_together(double size) {
  scenes::Query q;
  q.t0 = {{{0, 0, -1e-300}, {0, 0, 0}, {-2e-300, 0, 0}, {0, -3e-300, 0}}};
  q.t1 = {{{0, 0, size}, {0, 0, 0}, {size, 0, 0}, {0, size, 0}}};
  return q;
}

}  // namespace

TEST_CASE("hard pairs stay within the stack", "[stack]") {
  if (!is_measured("hard pairs stay within the stack")) return;
  Deepest query, step;
  const auto ask = [&](const std::string& source, const scenes::Query& q) {
    const Mesh mesh = mesh_of(q.kind);
    const Eigen::MatrixXd x_t0 = positions(q.t0), x_t1 = positions(q.t1);
    query.add(stack_used_by([&] {
                for (const Options& o : settings()) scenes::ccd(q, o);
              }),
              source);
    step.add(stack_used_by([&] {
               for (Options o : settings()) {
                 o.threads = 1;
                 compute_collision_free_stepsize(mesh, x_t0, x_t1, o);
                 construct_active_set(mesh, x_t0, x_t1, o);
               }
             }),
             source);
  };
  for (const double size : {1.0, 1e300}) ask("roots close together", roots_close_together(size));
  for_each_query(all_sources(), fuzz(5), 3,
                 [&](const std::string& source, const scenes::Query& q, auto&) { ask(source, q); });
  query.check("vertex_face_ccd, edge_edge_ccd");
  step.check("steps and sets of one pair");
}

TEST_CASE("every call stays within the stack, of the caller and of workers", "[stack]") {
  if (!is_measured("every call stays within the stack")) return;
  for (const int threads : {1, 2}) {
    std::map<std::string, Deepest> calls;
    for (const Subject& subject : small_subjects())
      for (const Call& call : every_call())
        for (Options o : settings()) {
          o.threads = threads;
          const Mesh mesh = subject.mesh();
          calls[call.name].add(stack_used_by([&] { call(mesh, subject, o); }), subject.name);
        }
    for (const auto& [name, deepest] : calls) deepest.check(name + ", threads " + std::to_string(threads));
  }
  // Deeper trees, and callbacks that run parallel work, which must not take on work of the call around them.
  const Subject large("larger spheres", scenes::sphere_onto_sphere(60, 80, 0.01, 0.5));
  Options two;
  two.threads = 2;
  Deepest visits, steps;
  const auto parallel_work = [] { tbb::parallel_for(0, 200, [](int) {}); };
  visits.add(stack_used_by([&] {
               const Mesh mesh = large.mesh();
               const auto visit = [&](PairKind, const std::array<int, 2>*, std::size_t) { parallel_work(); };
               for (int i = 0; i < 10; ++i)
                 visit_candidates(mesh, large.scene.x_t0, large.scene.x_t1, visit, two);
             }),
             large.name);
  visits.check("visit_candidates with parallel work");
  two.progress = [&](double) { return parallel_work(), true; };
  steps.add(stack_used_by([&] {
              const Mesh mesh = large.mesh();
              for (int i = 0; i < 10; ++i)
                compute_collision_free_stepsize(mesh, large.scene.x_t0, large.scene.x_t1, two);
            }),
            large.name);
  steps.check("compute_collision_free_stepsize with parallel work");
  const WorkerStacks workers = stacks_of_workers();
  CHECK(workers.threads > 0);
  Deepest{workers.used, "all calls"}.check(std::to_string(workers.threads) + " workers");
}
