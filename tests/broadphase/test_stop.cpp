// A broad phase asks whether to go on, while it is made and within blocks of any size, and ends when told to.
#include <tbb/task_arena.h>

#include "tests/asks.hpp"
#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

constexpr std::int64_t kPairsAnAsk = 1 << 14;  // as scene/pair_source.hpp promises

std::vector<Method> all_methods() {
  std::vector<Method> all = methods();
  all.push_back({"brute", BroadPhaseMethod::brute, InstructionSet::scalar});
  return all;
}

// Triangles in one place: all boxes overlap, and one cell holds them all.
Soup crowd(int faces) {
  scenes::Random random(3);
  return triangles("crowd", faces, random, [](scenes::Random& r) { return scenes::coin(r) ? 1.0 : -1.0; });
}
// Edges that all share their first vertex: all boxes overlap, and no pair may meet.
Soup star(int edges) {
  scenes::Random random(4);
  Soup soup = triangles("star", (edges + 3) / 3, random, [](scenes::Random& r) { return scenes::unit(r); });
  soup.mesh.faces.clear(), soup.mesh.edges.clear();
  for (int e = 1; e <= edges; ++e) soup.mesh.edges.push_back({0, e});
  for (int a = 0; a < 3; ++a) soup.x_t0[std::size_t(a)] = soup.x_t1[std::size_t(a)] = 0;
  return soup;
}

// Counts the pairs handed on: all, since the last ask, and the most between two asks.
struct Counter {
  Asks asks;
  std::int64_t pairs = 0, since = 0, most = 0;

  explicit Counter(std::int64_t n) : asks(n) {}
  PairSink sink() { return {this, &Counter::consume, {this, &Counter::asked}}; }
  static void consume(void* context, const IdPair*, std::size_t count) {
    Counter& c = *static_cast<Counter*>(context);
    c.pairs += std::int64_t(count), c.since += std::int64_t(count);
    c.most = std::max(c.most, c.since);
  }
  static bool asked(void* context) {
    Counter& c = *static_cast<Counter*>(context);
    c.since = 0;
    return c.asks.stop().requested();
  }
};

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

}  // namespace

TEST_CASE("every broad phase asks within a block, however many pairs it hands on", "[property]") {
  const Soup soup = crowd(600);
  const Motion motion = soup.motion();
  for (const Method& m : all_methods()) {
    BroadPhaseInput input{soup.mesh, motion};
    input.instruction_set = m.instruction_set;
    const auto phase = make_broad_phase(m.method, input);
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      INFO(m.name);
      Counter all(kNever);
      phase->traverse(kind, 0, phase->blocks(kind), all.sink());
      REQUIRE(all.pairs > 20 * kPairsAnAsk);
      CHECK(all.most <= kPairsAnAsk + std::int64_t(kBatchSize));
      for (std::int64_t n = 0; n < all.asks.count; n += 1 + n / 3) {
        Counter some(n);
        phase->traverse(kind, 0, phase->blocks(kind), some.sink());
        CHECK(some.since <= std::int64_t(kBatchSize));  // since the ask that said so
        CHECK(some.pairs <= (n + 1) * kPairsAnAsk + std::int64_t(kBatchSize));
      }
    }
  }
}

TEST_CASE("every broad phase asks within a block, also where it hands on nothing", "[property]") {
  const std::int64_t edges = 3000;
  const Soup soup = star(int(edges));
  const Motion motion = soup.motion();
  for (const Method& m : all_methods()) {
    INFO(m.name);
    BroadPhaseInput input{soup.mesh, motion};
    input.instruction_set = m.instruction_set;
    const auto phase = make_broad_phase(m.method, input);
    Counter all(kNever);
    phase->traverse(PairKind::edge_edge, 0, phase->blocks(PairKind::edge_edge), all.sink());
    CHECK(all.pairs == 0);
    CHECK(all.asks.count >= edges * (edges - 1) / 2 / kPairsAnAsk);
    Counter one(1);
    phase->traverse(PairKind::edge_edge, 0, phase->blocks(PairKind::edge_edge), one.sink());
    CHECK(one.asks.count <= 2);
  }
}

// One thread asks in the same order each time.
TEST_CASE("a broad phase that was stopped while it was made is none", "[property]") {
  scenes::Random random(5);
  const Soup soup = scattered("many", 3000, 0.05, 0.05, random);
  const Motion motion = soup.motion();
  tbb::task_arena alone(1);
  for (const Method& m : all_methods())
    alone.execute([&] {
      INFO(m.name);
      BroadPhaseInput input{soup.mesh, motion};
      input.instruction_set = m.instruction_set;
      Asks all;
      const auto whole = make_broad_phase(m.method, input, all.stop());
      REQUIRE((whole && whole->ready()));
      REQUIRE(all.count >= 3);
      const IdPairs expected = candidates(*whole, PairKind::edge_edge);
      for (std::int64_t n = 0; n < all.count; ++n) {
        Asks some(n);
        CHECK(make_broad_phase(m.method, input, some.stop()) == nullptr);
      }
      Asks fitting;
      whole->refit(input, fitting.stop());
      for (std::int64_t n = 0; n < fitting.count; ++n) {
        Asks some(n);
        whole->refit(input, some.stop());
        CHECK_FALSE(whole->ready());
        CHECK(whole->blocks(PairKind::edge_edge) == 0);
      }
      whole->refit(input);
      CHECK((candidates(*whole, PairKind::edge_edge) == expected));
    });
}
