// Candidates listed, counted and visited are the same ones, whatever budget or thread looks at them.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <onset/onset.hpp>
#include <stdexcept>
#include <utility>

#include "tests/catch.hpp"
#include "tests/scenes/rules.hpp"
#include "tests/src/support/crowds.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using Ids = std::vector<std::array<int, 2>>;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

struct Moving {
  std::string name;
  Mesh mesh;
  Eigen::MatrixXd x_t0, x_t1;
};

// Scenes, and crowds whose vertices at one place stay together, welded or not.
std::vector<Moving> all_moving() {
  std::vector<Moving> all;
  for (const NamedScene& named : some_scenes())
    all.push_back({named.name, named.mesh(), named.scene.x_t0, named.scene.x_t1});
  scenes::Random random(61);
  for (const bool weld : {false, true}) {
    Crowd crowd = grid_crowd(30, 2, random);
    scenes::set_rule(crowd.mesh, &CollisionRules::weld, weld);
    all.push_back({weld ? "welded" : "not welded", crowd.mesh, crowd.x, 1.25 * crowd.x});
  }
  return all;
}

struct Visited {
  Ids vertex_face, edge_edge;
  Candidates result;
  std::atomic<int> inside{0}, most_inside{0};
};
// What is visited, in order; with room for what a broken build would hand out twice.
void visit(const Moving& m, const Options& o, Visited& v) {
  std::mutex mutex;
  v.result = visit_candidates(
      m.mesh, m.x_t0, m.x_t1,
      [&](PairKind kind, const std::array<int, 2>* pairs, std::size_t count) {
        const int now = ++v.inside;
        const std::lock_guard<std::mutex> lock(mutex);
        v.most_inside = std::max(v.most_inside.load(), now);
        Ids& out = kind == PairKind::vertex_face ? v.vertex_face : v.edge_edge;
        out.insert(out.end(), pairs, pairs + count);
        --v.inside;
      },
      o);
  for (Ids* ids : {&v.vertex_face, &v.edge_edge}) std::sort(ids->begin(), ids->end());
}

bool same_counts(const Candidates& a, const Candidates& b) {
  return a.counts.vertex_face == b.counts.vertex_face && a.counts.edge_edge == b.counts.edge_edge &&
         a.stats.swept.vertex_face == b.stats.swept.vertex_face &&
         a.stats.swept.edge_edge == b.stats.swept.edge_edge && a.outcome == b.outcome && a.vertex == b.vertex;
}

}  // namespace

TEST_CASE("candidates listed, counted and visited are the same", "[property][determinism]") {
  std::int64_t welded = 0, found = 0;
  for (const Moving& m : all_moving())
    for (const double separation : {0.0, 0.02})
      for (const int threads : {1, 2}) {
        Options o;
        o.min_separation = separation, o.threads = threads;
        CAPTURE(m.name, separation, threads);
        const Candidates listed = compute_candidates(m.mesh, m.x_t0, m.x_t1, o);
        REQUIRE(listed.outcome == Outcome::free);
        CHECK(listed.counts.vertex_face == std::int64_t(listed.vertex_face.size()));
        CHECK(listed.counts.edge_edge == std::int64_t(listed.edge_edge.size()));
        o.memory_limit = 0;  // neither of the others keeps pairs
        const Candidates counted = count_candidates(m.mesh, m.x_t0, m.x_t1, o);
        CHECK(same_counts(counted, listed));
        CHECK((counted.vertex_face.empty() && counted.edge_edge.empty()));
        Visited visited;
        visit(m, o, visited);
        CHECK(same_counts(visited.result, listed));
        CHECK((visited.result.vertex_face.empty() && visited.result.edge_edge.empty()));
        CHECK((visited.vertex_face == listed.vertex_face));
        CHECK((visited.edge_edge == listed.edge_edge));
        CHECK((threads > 1 || visited.most_inside <= 1));
        found += listed.counts.total();
        if (!m.mesh.rules().weld) continue;
        Mesh loose = m.mesh;
        scenes::set_rule(loose, &CollisionRules::weld, false);
        welded += count_candidates(loose, m.x_t0, m.x_t1, o).counts.total() - listed.counts.total();
      }
  CHECK(found > 1000);
  CHECK(welded > 100);
}

TEST_CASE("candidates cut off by time or cancelled are visited once at most", "[property]") {
  const NamedScene named = some_scenes()[5];
  const Moving m{named.name, named.mesh(), named.scene.x_t0, named.scene.x_t1};
  Options o;
  o.min_separation = 0.1;
  const Candidates all = compute_candidates(m.mesh, m.x_t0, m.x_t1, o);
  REQUIRE(all.counts.total() > 1000);
  const auto check = [&](const Options& options, Outcome why, bool maybe_done) {
    const Candidates counted = count_candidates(m.mesh, m.x_t0, m.x_t1, options);
    Visited visited;
    visit(m, options, visited);
    for (const Candidates* c : {&counted, &std::as_const(visited.result)}) {
      CHECK((c->outcome == why || (maybe_done && c->outcome == Outcome::free)));
      CHECK(c->counts.total() <= all.counts.total());
      CHECK((c->vertex_face.empty() && c->edge_edge.empty()));
      CHECK((c->stats.looked_at < 1 || c->counts.total() == all.counts.total()));
    }
    for (const auto& [part, whole] :
         {std::pair(&visited.vertex_face, &all.vertex_face), std::pair(&visited.edge_edge, &all.edge_edge)}) {
      CHECK(std::adjacent_find(part->begin(), part->end()) == part->end());
      CHECK(std::includes(whole->begin(), whole->end(), part->begin(), part->end()));
    }
    if (visited.result.outcome == Outcome::free)
      CHECK(std::int64_t(visited.vertex_face.size() + visited.edge_edge.size()) == all.counts.total());
    return visited.vertex_face.size() + visited.edge_edge.size();
  };
  for (const int threads : {1, 2}) {
    o.threads = threads;
    Options none = o;
    none.time_limit = 0;
    CHECK(check(none, Outcome::out_of_time, false) == 0);
    for (const double limit : {1e-6, 1e-5, 1e-4, 1e-3}) {
      none.time_limit = limit;
      check(none, Outcome::out_of_time, true);
    }
    Options cancelled = o;
    cancelled.progress = [](double) { return false; };
    CHECK(check(cancelled, Outcome::cancelled, false) == 0);
    for (const double share : {0.01, 0.3, 0.9}) {
      cancelled.progress = [&](double done) { return done < share; };
      check(cancelled, Outcome::cancelled, true);
    }
  }
}

TEST_CASE("an exception of a visitor leaves the call, and the mesh answers on", "[unit]") {
  const NamedScene named = some_scenes()[5];
  const Mesh mesh = named.mesh();
  const Eigen::MatrixXd &x_t0 = named.scene.x_t0, &x_t1 = named.scene.x_t1;
  Options o;
  for (const int threads : {1, 2}) {
    o.threads = threads;
    const Candidates before = compute_candidates(mesh, x_t0, x_t1, o);
    REQUIRE(before.counts.total() > 0);
    const auto enough = [](PairKind, const std::array<int, 2>*, std::size_t count) {
      if (count > 0) throw std::runtime_error("enough");
    };
    CHECK_THROWS_WITH(visit_candidates(mesh, x_t0, x_t1, enough, o), "enough");
    CHECK((compute_candidates(mesh, x_t0, x_t1, o).edge_edge == before.edge_edge));
  }
  Eigen::MatrixXd bad = x_t1;
  bad(7, 2) = NAN;
  const auto never = [](PairKind, const std::array<int, 2>*, std::size_t) { FAIL("visited"); };
  CHECK(visit_candidates(mesh, x_t0, bad, never).vertex == 7);
  CHECK(count_candidates(mesh, x_t0, bad).vertex == 7);
  CHECK_THROWS_AS(visit_candidates(mesh, x_t0, bad.topRows(3), never), std::invalid_argument);
  CHECK_THROWS_AS(count_candidates(mesh, x_t0, bad.topRows(3)), std::invalid_argument);
}

TEST_CASE("listed candidates obey the rules of the mesh, and must be complete", "[unit]") {
  Eigen::MatrixXd x_t0(6, 3), x_t1;
  x_t0 << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1;
  x_t1 = x_t0;
  x_t1.bottomRows(3).col(2).setConstant(-1);
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 3, 4, 5;
  Mesh mesh(x_t0, F);
  Candidates list = compute_candidates(mesh, x_t0, x_t1);
  REQUIRE(compute_collision_free_stepsize(mesh, list, x_t0, x_t1).step < 1);
  CollisionRules rules;
  rules.bodies = mesh.components();
  rules.excluded_bodies = {{0, 1}};
  mesh.set_rules(rules);
  CHECK(compute_collision_free_stepsize(mesh, list, x_t0, x_t1).step == 1);
  rules = {};
  rules.static_vertices = {false, false, false, true, false, false};
  mesh.set_rules(rules);
  CHECK_THROWS_WITH(compute_collision_free_stepsize(mesh, list, x_t0, x_t1),
                    Catch::Contains("vertex 3 is static"));
  mesh.set_rules({});
  list.outcome = Outcome::out_of_memory;
  CHECK_THROWS_WITH(compute_collision_free_stepsize(mesh, list, x_t0, x_t1),
                    Catch::Contains("out_of_memory"));
  CHECK_THROWS_WITH(visit_candidates(mesh, x_t0, x_t1, CandidateVisitor()), Catch::Contains("visit"));
}

TEST_CASE("progress may run parallel work of its own", "[unit][tbb]") {
  const NamedScene named = some_scenes().front();
  const Mesh mesh = named.mesh();
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> calls{0};
    Options options;
    options.threads = 4;
    options.progress = [&](double) {
      tbb::parallel_for(0, 100, [&](int) { ++calls; });
      return true;
    };
    CHECK(compute_candidates(mesh, named.scene.x_t0, named.scene.x_t1, options).outcome == Outcome::free);
    CHECK(intersections(mesh, named.scene.x_t0, options).outcome == Outcome::free);
    CHECK(close_pairs(mesh, named.scene.x_t0, 0.1, options).outcome == Outcome::free);
    CHECK(calls > 0);
  }
}

TEST_CASE("close pairs and the making of a line search can be cancelled, and obey their memory", "[unit]") {
  const NamedScene named = some_scenes().front();
  const Mesh mesh = named.mesh();
  const double d_hat = 10;
  REQUIRE(close_pairs(mesh, named.scene.x_t0, d_hat).size() > 0);
  Options options;
  options.memory_limit = 0;
  const ClosePairs none = close_pairs(mesh, named.scene.x_t0, d_hat, options);
  CHECK((none.outcome == Outcome::out_of_memory && none.size() == 0));
  options = {};
  int calls = 0;
  options.threads = 1;
  options.progress = [&](double) { return ++calls < 2; };
  CHECK(close_pairs(mesh, named.scene.x_t0, d_hat, options).outcome == Outcome::cancelled);
  calls = 0;
  const LineSearch search(mesh, named.scene.x_t0, named.scene.x_t1 - named.scene.x_t0, options);
  CHECK(search.largest_step().outcome == Outcome::cancelled);
}

// A vertex flies over a face, beyond the separation by less than the tolerance.
TEST_CASE(
    "with a separation the step of listed candidates may be later than that of the call, for a near miss",
    "[unit]") {
  const double d = 0.1;
  Eigen::MatrixXd x0(4, 3), x1;
  x0 << -1, -1, 0, 1, -1, 0, 0, 1, 0, -3, 0, d;
  const Mesh mesh(x0, Eigen::RowVector3i(0, 1, 2));
  Options o;
  o.min_separation = d;
  const auto compare = [&](double beyond, bool listed) {
    CAPTURE(beyond);
    x0(3, 2) = d + beyond;
    x1 = x0;
    x1(3, 0) = 3;
    const Candidates list = compute_candidates(mesh, x0, x1, o);
    const StepResult call = compute_collision_free_stepsize(mesh, x0, x1, o),
                     of_list = compute_collision_free_stepsize(mesh, list, x0, x1, o);
    REQUIRE(call.stats.tolerance > 1e-6);
    CHECK(list.vertex_face.size() == (listed ? 1 : 0));
    CHECK((call.outcome == Outcome::contact && call.step < 0.42));
    if (listed)
      CHECK(of_list.step == call.step);
    else
      CHECK((of_list.step == 1 && of_list.outcome == Outcome::free));
  };
  compare(0x1p-40, false);
  compare(0, true);
  compare(-0x1p-40, true);
}
