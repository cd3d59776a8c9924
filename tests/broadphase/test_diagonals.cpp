// What diagonals drop is farther apart than the inflations, in exact arithmetic, and only what they drop is
// gone; every method drops the same.
#include <stdexcept>

#include "broadphase/diagonals.hpp"
#include "broadphase/diagonals/records.hpp"
#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/arithmetic/rational.hpp"

using namespace onset;
using namespace onset::tests;
using oracle::Rational;

namespace {

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};
constexpr int kDirections[6][3] = {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};

std::vector<int> vertices_of(const MeshData& mesh, PairKind kind, bool second, int id) {
  if (!second && kind != PairKind::edge_edge) return {id};
  if (kind != PairKind::vertex_face) return {mesh.edges[std::size_t(id)][0], mesh.edges[std::size_t(id)][1]};
  const auto& f = mesh.faces[std::size_t(id)];
  return {f[0], f[1], f[2]};
}

Rational thickest(const MeshData& mesh, const std::vector<int>& vertices) {
  Rational most = 0;
  for (const int v : vertices)
    if (!mesh.thickness.empty()) most = std::max(most, Rational(mesh.thickness[std::size_t(v)]));
  return most;
}

// The gap between two primitives along a direction, the second before or behind the first.
Rational gap(const BroadPhaseInput& input, const std::vector<int>& a, const std::vector<int>& b, int k,
             bool at_end, bool behind) {
  const auto along = [&](int v) {
    Rational sum = 0;
    for (int i = 0; i < 3; ++i) {
      const Rational x0 = input.motion.t0(v)[i], x1 = input.motion.t1(v)[i];
      const Rational x = at_end ? Rational(x0 + Rational(input.t_max) * (x1 - x0)) : x0;
      sum += kDirections[k][i] * x;
    }
    return Rational(behind ? -sum : sum);
  };
  Rational most = along(a[0]), least = along(b[0]);
  for (const int v : a) most = std::max(most, along(v));
  for (const int v : b) least = std::min(least, along(v));
  return least - most;
}

// Says whether a direction separates a pair by more than `reach` in the norm, on one side at both ends.
bool separated(const BroadPhaseInput& input, const std::vector<int>& a, const std::vector<int>& b,
               const Rational& reach, const Rational& slack) {
  for (int k = 0; k < 6; ++k) {
    for (const bool behind : {false, true}) {
      bool beyond = true;
      for (const bool at_end : {false, true}) {
        const Rational g = gap(input, a, b, k, at_end, behind) - slack;
        beyond = beyond && g > 0 &&
                 (input.diagonals.norm == Norm::maximum ? g > 2 * reach : g * g > 2 * reach * reach);
      }
      if (beyond) return true;
    }
  }
  return false;
}

double largest_coordinate(const Motion& motion) {
  double largest = 0;
  for (int v = 0; v < motion.num_vertices; ++v)
    for (int a = 0; a < 3; ++a)
      largest = std::max({largest, std::fabs(motion.t0(v)[a]), std::fabs(motion.t1(v)[a])});
  return largest;
}

// Compares every method with and without diagonals; returns how many pairs they drop. A pair that is kept may
// be separated by less than `slack` more.
int expect_exact(const std::string& name, BroadPhaseInput input, double slack) {
  int dropped = 0;
  for (const PairKind kind : wanted_kinds(input)) {
    input.diagonals.used = false;
    const IdPairs all = candidates(*make_broad_phase(BroadPhaseMethod::brute, input), kind);
    input.diagonals.used = true;
    const IdPairs kept = candidates(*make_broad_phase(BroadPhaseMethod::brute, input), kind);
    for (const Method& m : methods()) {
      input.instruction_set = m.instruction_set;
      INFO(name << ", " << m.name);
      CHECK((candidates(*make_broad_phase(m.method, input), kind) == kept));
    }
    CHECK(std::includes(all.begin(), all.end(), kept.begin(), kept.end()));
    for (const auto& [a, b] : all) {
      const auto va = vertices_of(input.mesh, kind, false, a), vb = vertices_of(input.mesh, kind, true, b);
      const Rational reach = 2 * Rational(input.inflation) + Rational(input.diagonals.margin) +
                             thickest(input.mesh, va) + thickest(input.mesh, vb);
      const bool is_kept = std::binary_search(kept.begin(), kept.end(), std::pair(a, b));
      if (!is_kept && !separated(input, va, vb, reach, 0)) FAIL(name << ": missed " << a << " " << b);
      if (is_kept && separated(input, va, vb, reach * (1 + Rational(0x1p-45)), slack))
        FAIL(name << ": too far apart, " << a << " " << b);
      dropped += !is_kept;
    }
  }
  return dropped;
}

std::vector<Soup> small_soups() {
  scenes::Random random(29);
  const auto whole = [](scenes::Random& r) { return double(scenes::integer(r, -3, 3)); };
  const auto tenths = [](scenes::Random& r) { return scenes::integer(r, -9, 9) / 10.0; };
  const Soup base = scattered("scattered", 16, 0.4, 0.3, random);
  Soup away = base;
  away.name = "one vertex far away", away.x_t1[0] = 1e12, away.x_t0[40] = -1e9;
  Soup group = base;  // four triangles far away that meet each other there
  group.name = "a group far away";
  for (std::size_t i = 0; i < 36; ++i)
    for (std::vector<double>* x : {&group.x_t0, &group.x_t1})
      (*x)[i] = 0.3 * scenes::uniform(random, -1, 1) + (i % 3 == 0 ? 1e5 : 0);
  return {base,
          group,
          scattered("usual", 60, 0.15, 0.05, random),
          tangled(14, 15, random),
          triangles("whole", 14, random, whole),
          triangles("tenths", 14, random, tenths),
          away,
          moved(base, "far", 1e15, 1e15, 1e15),
          scaled(base, "huge", 0x1p1015),
          scaled(base, "as large as may be", 0x1.3p1019),
          scaled(base, "tiny", 0x1p-1060),
          scaled(base, "subnormal", 0x1p-1073)};
}

}  // namespace

TEST_CASE("what diagonals drop is farther apart than its inflations, and nothing else is dropped",
          "[oracle]") {
  scenes::Random random(31);
  int dropped = 0, turn = 0;
  for (Soup& soup : small_soups()) {
    const Motion motion = soup.motion();
    REQUIRE(motion.status == Outcome::free);
    const double size = largest_coordinate(motion);
    for (const BoxTest test : {BoxTest::both_ends, BoxTest::moving})
      for (const double relative : {0.0, 0.02})
        for (const double t_max : {1.0, 0.3, 0.0}) {
          soup.mesh.thickness.clear();
          if (++turn % 3 == 0)
            for (int v = 0; v < soup.mesh.num_vertices; ++v)
              soup.mesh.thickness.push_back(turn % 2 == 0 ? 0.01 * size
                                                          : size * scenes::uniform(random, 0, 0.02));
          BroadPhaseInput input{soup.mesh, motion};
          input.test = test, input.inflation = size * relative, input.t_max = t_max;
          input.diagonals.norm = turn % 4 < 2 ? Norm::euclidean : Norm::maximum;
          input.diagonals.margin = turn % 5 == 0 ? 0.01 * size : 0;
          dropped += expect_exact(soup.name, input, size * 0x1p-44 + 0x1p-1065);
        }
  }
  CHECK(dropped > 2000);
}

TEST_CASE("a vertex far out does not blur the places of the others", "[unit]") {
  scenes::Random random(32);
  Soup soup = scattered("scattered", 16, 0.4, 0.3, random);
  const auto range = [&](InstructionSet set) {
    const Motion motion = soup.motion();
    BroadPhaseInput input{soup.mesh, motion};
    input.instruction_set = set;
    std::vector<int> ids(std::size_t(soup.mesh.num_vertices));
    std::iota(ids.begin(), ids.end(), 0);
    DiagonalRecords records;
    records.write(input, 1, LinearMap{{0, 0, 0}, 1}, ids.data(), ids.size(), ids.size(), false);
    return records.range;
  };
  for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::automatic}) {
    soup.x_t0[0] = 0;
    const DiagonalRange near = range(set);
    CHECK_FALSE(near.far_out);
    soup.x_t0[0] = 1e6;
    const DiagonalRange far = range(set);
    CHECK(far.far_out);
    CHECK(far.largest <= near.largest);
    CHECK(far.largest > 0.5);
  }
}

TEST_CASE("diagonals drop the same in a plane", "[oracle]") {
  scenes::Random random(37);
  int dropped = 0;
  for (const double offset : {0.0, 1e6}) {
    Soup soup;
    soup.mesh.dimension = 2;
    soup.mesh.num_vertices = 120;
    for (int e = 0; e < 60; ++e) {
      soup.mesh.edges.push_back({2 * e, 2 * e + 1});
      const double x = scenes::uniform(random, -1, 1), y = scenes::uniform(random, -1, 1);
      for (int k = 0; k < 2; ++k)
        for (const double c : {x, y}) soup.x_t0.push_back(c + offset + scenes::uniform(random, -0.2, 0.2));
    }
    std::vector<double> in_space;
    for (std::size_t i = 0; i < soup.x_t0.size(); i += 2)
      in_space.insert(in_space.end(), {soup.x_t0[i], soup.x_t0[i + 1], 0});
    soup.x_t0 = soup.x_t1 = in_space;
    for (std::size_t i = 0; i < soup.x_t1.size(); ++i)
      if (i % 3 != 2) soup.x_t1[i] += scenes::uniform(random, -0.1, 0.1);
    const Motion motion = make_motion(soup.mesh.num_vertices, {soup.x_t0.data(), soup.mesh.num_vertices},
                                      {soup.x_t1.data(), soup.mesh.num_vertices}, true);
    for (const double inflation : {0.0, 0.01}) {
      BroadPhaseInput input{soup.mesh, motion};
      input.inflation = inflation;
      dropped += expect_exact("in a plane", input, offset * 0x1p-44 + 0x1p-44);
    }
  }
  CHECK(dropped > 50);
}

// Sums of coordinates round elsewhere, differences do not.
TEST_CASE("diagonals drop the same wherever a scene lies, if differences stay", "[property]") {
  scenes::Random random(41);
  const auto coarse = [](scenes::Random& r) { return scenes::integer(r, -1000, 1000) * 0x1p-9; };
  const Soup soup = triangles("coarse", 60, random, coarse);
  const Soup far = moved(soup, "far", 0x1p40, -0x1p41, 0x1p39), large = scaled(soup, "large", 0x1p100);
  const Motion motion = soup.motion(), far_motion = far.motion(), large_motion = large.motion();
  REQUIRE(motion.axes == far_motion.axes);
  for (const PairKind kind : kKinds) {
    BroadPhaseInput a{soup.mesh, motion}, b{soup.mesh, far_motion}, c{soup.mesh, large_motion};
    a.diagonals.used = b.diagonals.used = c.diagonals.used = true;
    const IdPairs expected = candidates(*make_broad_phase(BroadPhaseMethod::bvh, a), kind);
    CHECK(expected.size() > 500);
    CHECK((candidates(*make_broad_phase(BroadPhaseMethod::bvh, b), kind) == expected));
    CHECK((candidates(*make_broad_phase(BroadPhaseMethod::bvh, c), kind) == expected));
  }
}

TEST_CASE("two crossing diagonals that touch are a candidate, a unit apart they are not", "[unit]") {
  for (const double apart : {0.0, 0x1p-40, 0x1p-20}) {
    Soup soup;  // parallel edges along x = y, whose boxes overlap
    soup.mesh.num_vertices = 4;
    soup.mesh.edges = {{0, 1}, {2, 3}};
    soup.x_t0 = {0, 0, 0, 1, 1, 0, 0.25 + apart, 0.25 - apart, 0, 0.75 + apart, 0.75 - apart, 0};
    soup.x_t1 = soup.x_t0;
    const Motion motion = soup.motion();
    for (const Method& m : methods()) {
      BroadPhaseInput input{soup.mesh, motion};
      input.instruction_set = m.instruction_set;
      input.diagonals.used = true;
      INFO(m.name << " apart " << apart);
      CHECK(candidates(*make_broad_phase(m.method, input), PairKind::edge_edge).size() ==
            (apart > 0 ? 0u : 1u));
    }
  }
}

TEST_CASE("diagonals drop the same of a scene whose axes are flipped and exchanged", "[property]") {
  scenes::Random random(43);
  const Soup soup = scattered("scattered", 60, 0.5, 0.3, random);
  const auto pairs = [](const Soup& of, PairKind kind) {
    const Motion motion = of.motion();
    BroadPhaseInput input{of.mesh, motion};
    input.diagonals.used = true;
    return candidates(*make_broad_phase(BroadPhaseMethod::bvh, input), kind);
  };
  for (const std::array<int, 3>& axes : {std::array<int, 3>{0, 1, 2}, {1, 2, 0}, {2, 1, 0}})
    for (int flips = 0; flips < 8; ++flips) {
      Soup other = soup;
      for (std::size_t v = 0; v < soup.x_t0.size(); v += 3)
        for (std::size_t a = 0; a < 3; ++a) {
          const double sign = flips >> a & 1 ? -1 : 1;
          other.x_t0[v + a] = sign * soup.x_t0[v + std::size_t(axes[a])];
          other.x_t1[v + a] = sign * soup.x_t1[v + std::size_t(axes[a])];
        }
      for (const PairKind kind : kKinds) CHECK((pairs(other, kind) == pairs(soup, kind)));
    }
}

TEST_CASE("two edges are apart along diagonals, or not, whichever is named first", "[unit]") {
  const auto apart = [](double gap, IdPair pair) {
    Soup soup;  // along x = y
    soup.mesh.num_vertices = 4;
    soup.mesh.edges = {{0, 1}, {2, 3}};
    soup.mesh.thickness = {0, 0, 0.01, 0.01};  // zero and more round otherwise than more and zero
    soup.x_t0 = {0, 0, 0, 1, 1, 0, gap, -gap, 0, 0.75, 0.25, 0};
    soup.x_t1 = soup.x_t0;
    const Motion motion = soup.motion();
    BroadPhaseInput input{soup.mesh, motion};
    input.diagonals.margin = 1e-7;
    return diagonals_apart(input, PairKind::edge_edge, pair);
  };
  double least = 0, most = 0.1;
  REQUIRE(apart(most, {0, 1}));
  for (int i = 0; i < 70; ++i) (apart(0.5 * (least + most), {0, 1}) ? most : least) = 0.5 * (least + most);
  for (int i = -200; i <= 200; ++i) {
    const double gap = most * (1 + i * 0x1p-53);
    CHECK(apart(gap, {0, 1}) == apart(gap, {1, 0}));
  }
}
