// Eight threads call with one shared Mesh and one shared LineSearch, each in an arena of its own, in the
// caller's, from inside a callback, and from inside a task of a host that uses TBB (where the library does,
// since ThreadSanitizer does not see into TBB): equal bytes, and under ThreadSanitizer no report.
#ifdef ONSET_THREADS_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include <atomic>
#include <cstdio>
#include <cstring>
#include <functional>
#include <onset/onset.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/scenes/meshes.hpp"

using namespace onset;

namespace {

constexpr int kThreads = 8;

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}
template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

struct Shared {
  scenes::Scene scene;
  Mesh mesh;
  LineSearch search;
  explicit Shared(const scenes::Scene& s)
      : scene(s), mesh(s.x_t0, s.faces), search(mesh, s.x_t0, Eigen::MatrixXd(s.x_t1 - s.x_t0)) {}

  // Every call, its answer as bytes.
  std::string ask(const Options& o) const {
    std::string bytes;
    const StepResult step = compute_collision_free_stepsize(mesh, scene.x_t0, scene.x_t1, o);
    append(bytes, step.step), append(bytes, step.outcome);
    append(bytes, step.limiting.value_or(Pair{}).vertices);
    const ActiveSet set = construct_active_set(mesh, scene.x_t0, scene.x_t1, o);
    for (const Contact& c : set) {
      append(bytes, c.kind), append(bytes, c.a), append(bytes, c.b), append(bytes, c.toi);
      append(bytes, c.outcome), append(bytes, c.normal), append(bytes, c.weights), append(bytes, c.gap);
    }
    const Candidates pairs = compute_candidates(mesh, scene.x_t0, scene.x_t1, o);
    append(bytes, pairs.vertex_face), append(bytes, pairs.edge_edge);
    append(bytes, is_step_collision_free(mesh, scene.x_t0, scene.x_t1, o));
    for (const double upper : {1.0, 0.3}) append(bytes, search.largest_step(upper).step);
    return bytes;
  }
};

std::atomic<int> differing{0};
void expect(const std::string& reference, const std::string& bytes, const char* how) {
  if (bytes == reference) return;
  ++differing;
  std::printf("%s: other bytes\n", how);
}

void on_all_threads(const std::function<void(int)>& work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) threads.emplace_back(work, i);
  for (std::thread& t : threads) t.join();
}

void check(const Shared& shared, const char* name) {
  Options one;
  one.threads = 1;
  const std::string reference = shared.ask(one);
  on_all_threads([&](int) { expect(reference, shared.ask(one), "an arena of one thread"); });
  on_all_threads([&](int) { expect(reference, shared.ask(Options()), "the caller's arena"); });
  on_all_threads([&](int i) {
    Options o;
    o.threads = 1 + i % 4;
    std::atomic<int> calls{0};
    o.progress = [&](double) { return ++calls > 0; };
    expect(reference, shared.ask(o), "arenas of one to four threads, with progress");
  });
  on_all_threads([&](int i) {
    // A callback that calls the library.
    Options o, inner;
    o.threads = 2, inner.threads = i % 4;
    std::atomic<int> calls{0};
    o.progress = [&](double) {
      if (++calls % 16 == 1) expect(reference, shared.ask(inner), "from inside a callback");
      return true;
    };
    compute_collision_free_stepsize(shared.mesh, shared.scene.x_t0, shared.scene.x_t1, o);
    expect(reference, shared.ask(o), "with calls from a callback");
  });
#ifdef ONSET_THREADS_TBB
  on_all_threads([&](int) {
    tbb::task_arena arena(4);
    arena.execute([&] {
      tbb::parallel_for(0, 4, [&](int) { expect(reference, shared.ask(Options()), "from inside a task"); });
    });
  });
  on_all_threads([&](int) {
    // A callback that runs parallel work of its own.
    Options o;
    std::atomic<int> sum{0};
    o.progress = [&](double) {
      tbb::parallel_for(0, 100, [&](int k) { sum += k; });
      return true;
    };
    expect(reference, shared.ask(o), "with parallel work in the callback");
  });
#endif
  std::printf("%s: %zu bytes, the same\n", name, reference.size());
}

// A race of our own, between tasks of one call: a sanitizer that sees TBB must report it.
void race(const Shared& shared) {
  int calls = 0;
  on_all_threads([&](int) {
    Options o;
    o.progress = [&](double) { return ++calls > 0; };
    shared.ask(o);
  });
  std::printf("%d calls\n", calls);
}

}  // namespace

int main(int argc, char**) {
#ifdef ONSET_THREADS_TBB
  const tbb::global_control workers(tbb::global_control::max_allowed_parallelism, 4);
#else
  std::printf("skipped: hosts that use TBB (the library is built without)\n");
#endif
  scenes::Random random(3);
  const Shared soup(scenes::triangle_soup(120, 0.25, 0.2, random));
  const Shared spheres(scenes::sphere_onto_sphere(12, 16, 0.01, 0.3));
  if (argc > 1) return race(soup), 0;
  check(soup, "soup");
  check(spheres, "spheres");
  return differing == 0 ? 0 : 1;
}
