// Every broad phase gives the candidates of brute force, each once.
#include <stdexcept>

#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};

// Returns the number of candidates.
std::size_t expect_agreement(const std::string& what, BroadPhaseInput input) {
  const auto brute = make_broad_phase(BroadPhaseMethod::brute, input);
  IdPairs all[2];
  for (std::size_t k = 0; k < 2; ++k) all[k] = candidates(*brute, kKinds[k]);
  std::size_t total = 0;
  for (const Method& method : methods()) {
    input.instruction_set = method.instruction_set;
    const auto phase = make_broad_phase(method.method, input);
    for (std::size_t k = 0; k < 2; ++k) {
      const PairKind kind = kKinds[k];
      const IdPairs &expected = all[k], found = candidates(*phase, kind);
      total += expected.size();
      INFO(what << ", " << method.name << ", kind " << int(kind) << ", test " << int(input.test));
      CHECK(found.size() == expected.size());
      CHECK((found == expected));
    }
  }
  return total;
}

std::size_t expect_agreement_of_all_tests(const std::string& what, BroadPhaseInput input) {
  std::size_t total = 0;
  for (BoxTest test : {BoxTest::swept, BoxTest::both_ends, BoxTest::moving}) {
    input.test = test;
    total += expect_agreement(what, input);
    if (test == BoxTest::swept) continue;
    const bool moving = test == BoxTest::moving;
    input.diagonals = {true, moving ? Norm::maximum : Norm::euclidean, moving ? 0.01 * input.inflation : 0};
    expect_agreement(what + ", diagonals", input);
    input.diagonals = {};
  }
  return total;
}

double size_of(const Motion& motion) {
  double largest = 0;
  for (int v = 0; v < motion.num_vertices; ++v)
    for (int a = 0; a < 3; ++a) largest = std::max(largest, std::fabs(motion.t0(v)[a]));
  return largest;
}

}  // namespace

TEST_CASE("every method agrees with brute force on hard soups", "[property]") {
  for (const Soup& soup : hard_soups()) {
    const Motion motion = soup.motion();
    REQUIRE(motion.status == Outcome::free);
    expect_agreement_of_all_tests(soup.name, {soup.mesh, motion});
  }
}

TEST_CASE("every method agrees with brute force on boxes that pass corner to corner", "[property]") {
  scenes::Random random(23);
  for (double offset : {0.0, 1.0, 1e3}) {
    Soup soup;  // edges, two by two: the second meets the first on one axis just when it leaves it on another
    soup.name = "corner to corner";
    const auto add = [&](const std::array<double, 3>& at, double size, const std::array<double, 3>& by) {
      for (int end = 0; end < 2; ++end)
        for (std::size_t a = 0; a < 3; ++a) {
          soup.x_t0.push_back(at[a] + end * size);
          soup.x_t1.push_back(at[a] + end * size + by[a]);
        }
      soup.mesh.edges.push_back({soup.mesh.num_vertices, soup.mesh.num_vertices + 1});
      soup.mesh.num_vertices += 2;
    };
    for (int i = 0; i < 300; ++i) {
      const double t = scenes::integer(random, 1, 8) / 9.0, x = scenes::uniform(random, -1, 1) + offset;
      const double before = scenes::uniform(random, 0.1, 0.5), after = before * (1 - t) / t;
      const double off = scenes::coin(random) ? 0 : scenes::uniform(random, -1, 1) * 0x1p-22;
      add({x, x, x}, 0.1, {0, 0, 0});
      add({x + 0.1 + before, x + 0.1 - before + off, x}, 0.1, {-before - after, before + after, 0});
    }
    const Motion motion = soup.motion();
    BroadPhaseInput input{soup.mesh, motion};
    input.test = BoxTest::both_ends;
    const std::size_t pairs = expect_agreement(soup.name, input);
    input.test = BoxTest::moving;
    const std::size_t together = expect_agreement(soup.name, input);
    CHECK(together > methods().size() * 20);
    CHECK(pairs - together > methods().size() * 20);
  }
}

TEST_CASE("every method agrees with brute force when widened by an inflation", "[property]") {
  int turn = 0;
  for (const Soup& soup : hard_soups()) {
    const Motion motion = soup.motion();
    for (double relative :
         {1e-9, ++turn % 4 == 0 ? 0.3 : 0.01}) {  // the largest is for a few: it pairs nearly all
      BroadPhaseInput input{soup.mesh, motion};
      input.inflation = size_of(motion) * relative;
      expect_agreement_of_all_tests(soup.name + ", inflated", input);
    }
  }
}

TEST_CASE("every method agrees with brute force on vertices of different thickness", "[property]") {
  scenes::Random random(3);
  for (Soup& soup : hard_soups()) {
    const Motion motion = soup.motion();
    const double size = size_of(motion);
    for (int v = 0; v < soup.mesh.num_vertices; ++v)
      soup.mesh.thickness.push_back(scenes::coin(random) ? 0 : size * scenes::uniform(random, 0, 0.1));
    expect_agreement_of_all_tests(soup.name + ", thick", {soup.mesh, motion});
    BroadPhaseInput both{soup.mesh, motion};
    both.inflation = size * 0.01, both.t_max = 0.3;
    expect_agreement_of_all_tests(soup.name + ", thick, inflated, t_max", both);
  }
}

TEST_CASE("every method agrees with brute force up to t_max", "[property]") {
  for (const Soup& soup : hard_soups()) {
    const Motion motion = soup.motion();
    for (double t_max : {0.0, 1e-12, 0.25, 1 - 0x1p-53}) {
      BroadPhaseInput input{soup.mesh, motion};
      input.t_max = t_max;
      expect_agreement_of_all_tests(soup.name + ", t_max", input);
    }
  }
}

TEST_CASE("every method agrees with brute force on a few thousand primitives", "[property]") {
  scenes::Random random(11);
  const Soup sparse = scattered("sparse", 2000, 0.04, 0.04, random);
  const Soup dense = scattered("dense", 700, 0.3, 0.3, random);
  for (const Soup* soup : {&sparse, &dense}) {
    const Motion motion = soup->motion();
    CHECK(expect_agreement_of_all_tests(soup->name, {soup->mesh, motion}) > 5000);
  }
}

TEST_CASE("every method agrees with brute force for every small number of primitives", "[property]") {
  scenes::Random random(5);
  for (int faces = 0; faces < 30; ++faces) {
    const Soup soup = scattered("a few", faces, 0.5, 0.5, random);
    const Motion motion = soup.motion();
    expect_agreement_of_all_tests(soup.name, {soup.mesh, motion});
  }
}

// The cells of a hash are as wide as the short ones or a little wider, and it has some levels for the rest.
TEST_CASE("every method finds the same where most primitives are in one row of cells", "[property]") {
  scenes::Random random(43);
  constexpr int kShort = 40000, kLong = 400;
  Soup soup;
  soup.mesh.num_vertices = 2 * (kShort + kLong);
  const auto add = [&](double x, double length, double y) {
    const int v = int(soup.x_t0.size()) / 3;
    soup.mesh.edges.push_back({v, v + 1});
    for (const double c : {x, y, 0.0, x + length, y, 0.0}) soup.x_t0.push_back(c);
  };
  for (int i = 0; i < kShort; ++i) add(scenes::uniform(random, -0.5, 0.5), 0x1p-20, 0);
  for (int i = 0; i < kLong; ++i) add(-50, 100, 0x1p-7 * i);  // the first meets all short ones
  soup.x_t1 = soup.x_t0;
  const Motion motion = soup.motion();
  IdPairs reference;
  for (const Method& m : methods()) {
    BroadPhaseInput input{soup.mesh, motion};
    input.instruction_set = m.instruction_set;
    const auto phase = make_broad_phase(m.method, input);
    const IdPairs found = candidates(*phase, PairKind::edge_edge);
    INFO(m.name);
    if (reference.empty()) reference = found;
    CHECK(found.size() > kShort + 500);
    CHECK((found == reference));
  }
}

TEST_CASE("no method finds anything where a position is not finite", "[unit]") {
  scenes::Random random(5);
  Soup soup = scattered("not finite", 20, 1, 1, random);
  for (double bad : {double(NAN), double(INFINITY), 0x1p1022}) {
    soup.x_t1[31] = bad;
    const Motion motion = soup.motion();
    REQUIRE(motion.status != Outcome::free);
    for (BroadPhaseMethod method : {BroadPhaseMethod::brute, BroadPhaseMethod::bvh, BroadPhaseMethod::hash}) {
      const auto phase = make_broad_phase(method, {soup.mesh, motion});
      for (PairKind kind : kKinds) CHECK(phase->blocks(kind) == 0);
    }
  }
}
