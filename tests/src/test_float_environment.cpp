// Whatever floating-point environment the host has set, in the calling thread and in TBB's workers, answers
// are those of a clean process, and the host finds its environment and flags as they were.
#if defined(__SSE2__)
#include <fenv.h>
#include <immintrin.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/src/support/one_pair.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

constexpr unsigned kClean = 0x1f80;
struct Mode {
  const char* name;
  unsigned mxcsr;
};
constexpr Mode kModes[] = {{"downward", 0x3f80},      {"upward", 0x5f80},
                           {"toward zero", 0x7f80},   {"subnormal numbers are zero", 0x1f80 | 0x8040},
                           {"every trap on", 0x0000}, {"flags raised", 0x1f80 | 0x3f}};

// While it lives: in this thread, and in as many workers as can be had.
struct Host {
  explicit Host(unsigned mxcsr) : mxcsr_(mxcsr) { set(mxcsr); }
  ~Host() { set(kClean); }
  bool untouched() const { return _mm_getcsr() == mxcsr_; }
  static void set(unsigned mxcsr) {
    tbb::parallel_for(0, 2000, [&](int) { _mm_setcsr(mxcsr); });
    _mm_setcsr(mxcsr);
  }
  unsigned mxcsr_;
};

struct Answers {
  ActiveSet set, exact;
  StepResult step;
  LineSearchStep searched;
  ClosePairs close, close_on_the_way;
  Candidates candidates;
  std::vector<double> safe;
  double safe_length = 0;
  StepResult cfl;
  Constraints constraints;
  Intersections crossings;
  StartReport report;
  bool free = false;
};

Answers ask(const Mesh& mesh, const Eigen::MatrixXd& x_t0, const Eigen::MatrixXd& x_t1,
            const Eigen::MatrixXd& dx, double d_hat, const Options& options) {
  Answers a;
  a.set = construct_active_set(mesh, x_t0, x_t1, options);
  Options exactly = options;
  exactly.exactness = Exactness::exact;
  a.exact = construct_active_set(mesh, x_t0, x_t1, exactly);
  a.step = compute_collision_free_stepsize(mesh, x_t0, x_t1, options);
  LineSearchOptions search = options;
  search.d_hat = d_hat;
  const LineSearch line(mesh, x_t0, dx, search);
  a.searched = line.largest_step();
  a.close_on_the_way = line.close_pairs(0.5);
  a.close = close_pairs(mesh, x_t0, d_hat, options);
  a.candidates = compute_candidates(mesh, x_t0, x_t1, options);
  a.safe = safe_distances(mesh, x_t0, a.close);
  a.safe_length = safe_step(a.safe, dx);
  a.cfl = compute_cfl_stepsize(mesh, x_t0, x_t1, a.close, options);
  a.constraints = assemble_constraints(a.set, 1e-3);
  a.crossings = intersections(mesh, x_t0, options);
  a.report = check(mesh, x_t0, options);
  a.free = is_step_collision_free(mesh, x_t0, x_t1, options);
  return a;
}

bool same(const ClosePairs& a, const ClosePairs& b) {
  return a.outcome == b.outcome && a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const ClosePair& p, const ClosePair& q) {
           return p.kind == q.kind && p.a == q.a && p.b == q.b && p.weights == q.weights &&
                  p.distance == q.distance && p.gap == q.gap && p.separation == q.separation;
         });
}

void check_same(const Answers& a, const Answers& b) {
  CHECK(same_bytes(a.set, b.set));
  CHECK(same_bytes(a.exact, b.exact));
  CHECK(same_bytes(a.step, b.step));
  CHECK(same_bytes(static_cast<const StepResult&>(a.searched), b.searched));
  CHECK(a.searched.gap_share == b.searched.gap_share);
  CHECK(same(a.close, b.close));
  CHECK(same(a.close_on_the_way, b.close_on_the_way));
  CHECK((a.candidates.vertex_face == b.candidates.vertex_face &&
         a.candidates.edge_edge == b.candidates.edge_edge));
  CHECK((a.safe == b.safe && a.safe_length == b.safe_length));
  CHECK(same_bytes(a.cfl, b.cfl));
  CHECK(a.constraints.value == b.constraints.value);
  CHECK(a.crossings.size() == b.crossings.size());
  CHECK((a.report.touching.size() == b.report.touching.size() &&
         a.report.copied_vertices == b.report.copied_vertices));
  CHECK(a.free == b.free);
}

}  // namespace

TEST_CASE("no floating-point environment of the host changes a byte of any call", "[determinism]") {
  for (const auto& named : some_scenes()) {
    const auto& scene = named.scene;
    const Mesh mesh(scene.x_t0.rows(), scene.faces);
    const Eigen::MatrixXd dx = scene.x_t1 - scene.x_t0;
    const double d_hat = 0.02 * (scene.x_t0.maxCoeff() - scene.x_t0.minCoeff()) + 1e-12;
    for (const int threads : {0, 1, 2}) {
      Options options;
      options.threads = threads;
      const Answers clean = ask(mesh, scene.x_t0, scene.x_t1, dx, d_hat, options);
      for (const Mode& mode : kModes) {
        CAPTURE(named.name, threads, mode.name);
        const Mesh fresh(scene.x_t0.rows(), scene.faces);
        Answers found;
        bool untouched = false;
        {
          const Host host(mode.mxcsr);
          found = ask(fresh, scene.x_t0, scene.x_t1, dx, d_hat, options);
          untouched = host.untouched();
        }
        CHECK(untouched);
        check_same(clean, found);
      }
    }
  }
}

TEST_CASE("single queries mind no floating-point environment either", "[determinism]") {
  VertexFaceQuery query;
  query.t0 = {{{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  query.t1 = {{{0.25, 0.25, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  VertexFaceQuery tiny = query;
  for (auto* end : {&tiny.t0, &tiny.t1})
    for (Point& p : *end)
      for (double& x : p) x *= 0x1p-1060;
  for (const VertexFaceQuery& q : {query, tiny}) {
    const QueryResult clean = vertex_face_ccd(q);
    CHECK((clean.outcome == PairOutcome::contact && clean.toi <= 0.5));
    for (const Mode& mode : kModes) {
      CAPTURE(mode.name);
      QueryResult found;
      bool untouched = false;
      {
        const Host host(mode.mxcsr);
        found = vertex_face_ccd(q);
        untouched = host.untouched();
      }
      CHECK(untouched);
      CHECK((found.toi == clean.toi && found.normal == clean.normal && found.weights == clean.weights));
    }
  }
}
#endif
