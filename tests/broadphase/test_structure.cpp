// Blocks, refits, kernels and threads: none of them changes what is found.
#include <tbb/task_arena.h>

#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};

Soup middle_soup(std::uint64_t seed) {
  scenes::Random random(seed);
  return scattered("middle", 500, 0.1, 0.1, random);
}

}  // namespace

TEST_CASE("blocks traversed one by one give what one call gives, each pair once", "[unit]") {
  const Soup soup = middle_soup(1);
  const Motion motion = soup.motion();
  for (const Method& m : methods()) {
    BroadPhaseInput input{soup.mesh, motion};
    input.instruction_set = m.instruction_set;
    const auto phase = make_broad_phase(m.method, input);
    for (PairKind kind : kKinds) {
      INFO(m.name);
      const std::size_t blocks = phase->blocks(kind);
      REQUIRE(blocks > 3);
      IdPairs pieces;
      for (std::size_t b = 0; b < blocks; ++b) {
        const IdPairs piece = emitted(*phase, kind, b, b + 1);
        pieces.insert(pieces.end(), piece.begin(), piece.end());
      }
      CHECK((sorted(pieces) == candidates(*phase, kind)));
    }
  }
}

TEST_CASE("a tree suits the motions after its own, and not another scene", "[unit]") {
  const Soup soup = middle_soup(2);
  Soup later = soup, other = soup;
  later.x_t0 = soup.x_t1;
  const Motion motion = soup.motion();
  const auto tree = make_broad_phase(BroadPhaseMethod::bvh, {soup.mesh, motion});
  CHECK(tree->suits(motion));
  CHECK(tree->suits(later.motion()));
  for (std::vector<double>* x : {&other.x_t0, &other.x_t1}) {
    const std::vector<double> before = *x;
    for (std::size_t v = 0; v < x->size() / 3; ++v)
      for (std::size_t a = 0; a < 3; ++a) (*x)[3 * v + a] = before[7919 * v % (x->size() / 3) * 3 + a];
  }
  CHECK(!tree->suits(other.motion()));
}

TEST_CASE("both kernels emit the same pairs in the same order", "[simd]") {
  if (!has_avx2()) return;
  for (const Soup& soup : hard_soups()) {
    const Motion motion = soup.motion();
    for (int i = 0; i < 5; ++i) {
      BroadPhaseInput scalar{soup.mesh, motion}, avx2{soup.mesh, motion};
      scalar.diagonals.used = avx2.diagonals.used = i >= 3;
      scalar.test = avx2.test = BoxTest(i < 3 ? i : i - 2);  // the last two with diagonals
      scalar.instruction_set = InstructionSet::scalar, avx2.instruction_set = InstructionSet::avx2;
      for (const BroadPhaseMethod method : {BroadPhaseMethod::bvh, BroadPhaseMethod::hash}) {
        const auto a = make_broad_phase(method, scalar), b = make_broad_phase(method, avx2);
        for (PairKind kind : kKinds) {
          INFO(soup.name << ", " << a->name());
          REQUIRE(a->blocks(kind) == b->blocks(kind));
          CHECK((emitted(*a, kind, 0, a->blocks(kind)) == emitted(*b, kind, 0, b->blocks(kind))));
        }
      }
    }
  }
}

TEST_CASE("a refit finds what a new broad phase finds", "[property]") {
  const Soup soup = middle_soup(2);
  scenes::Random random(23);
  for (const Method& m : methods()) {
    const Motion first = soup.motion();
    BroadPhaseInput input{soup.mesh, first};
    input.instruction_set = m.instruction_set;
    const auto reused = make_broad_phase(m.method, input);
    CHECK(reused->suits(first));
    CHECK_FALSE(make_broad_phase(BroadPhaseMethod::brute, input)->suits(first));  // it has nothing to keep
    for (int round = 0; round < 6; ++round) {
      Soup next = soup;
      for (double& x : next.x_t1) x += scenes::uniform(random, -0.3, 0.3);
      const Motion motion = next.motion();
      BroadPhaseInput changed{soup.mesh, motion};
      changed.instruction_set = m.instruction_set;
      changed.test = BoxTest(round % 3);  // motion boxes need more memory
      changed.t_max = round < 3 ? 1 : 0.25;
      changed.inflation = round == 4 ? 0.02 : 0;
      changed.diagonals.used = changed.test != BoxTest::swept && round != 2;
      reused->refit(changed);
      const auto fresh = make_broad_phase(m.method, changed);
      for (PairKind kind : kKinds) {
        INFO(m.name << ", round " << round);
        CHECK((candidates(*reused, kind) == candidates(*fresh, kind)));
      }
    }
  }
}

TEST_CASE("the number of threads changes neither blocks nor the order of pairs", "[determinism]") {
  scenes::Random random(31);
  const Soup soup = scattered("many", 4000, 0.05, 0.05, random);
  const Motion motion = soup.motion();
  for (const Method& m : methods()) {
    BroadPhaseInput input{soup.mesh, motion};
    input.instruction_set = m.instruction_set;
    input.diagonals.used = true;
    IdPairs reference[2];
    for (int threads : {1, 2, 4}) {
      tbb::task_arena arena(threads);
      arena.execute([&] {
        const auto phase = make_broad_phase(m.method, input);
        for (PairKind kind : kKinds) {
          const IdPairs pairs = emitted(*phase, kind, 0, phase->blocks(kind));
          IdPairs& expected = reference[int(kind)];
          if (threads == 1) expected = pairs;
          CHECK((pairs == expected));
        }
      });
    }
  }
}
