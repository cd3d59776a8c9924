// The cells of the hash: nothing is lost between levels, and meshes of uneven sizes cost no more than even
// ones.
#include "broadphase/hash/cell_order.hpp"
#include "broadphase/hash/cell_width.hpp"
#include "tests/asks.hpp"
#include "tests/broadphase/candidates.hpp"
#include "tests/broadphase/soups.hpp"
#include "tests/catch.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};

// Boxes whose widths are spread over many powers of two; some are beyond the grid.
std::vector<FloatBox> uneven_boxes(int count, scenes::Random& random) {
  std::vector<FloatBox> boxes;
  for (int i = 0; i < count; ++i) {
    FloatBox b;
    for (std::size_t a = 0; a < 3; ++a) {
      const double lo = scenes::uniform(random, -3, 3) * (i % 50 == 0 ? 1e9 : 1);
      b.lo[a] = float(lo),
      b.hi[a] = float(lo + std::exp2(scenes::uniform(random, -14, i % 20 == 0 ? 8 : -3)));
    }
    boxes.push_back(b);
  }
  return boxes;
}

bool overlap(const FloatBox& a, const FloatBox& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (a.hi[i] < b.lo[i] || b.hi[i] < a.lo[i]) return false;
  return true;
}

// Small triangles over a plane.
Soup sheet(int faces, scenes::Random& random) {
  Soup soup = scattered("sheet", faces, 0.01, 0.01, random);
  for (std::size_t i = 2; i < soup.x_t0.size(); i += 3) soup.x_t0[i] *= 0.01, soup.x_t1[i] *= 0.01;
  return soup;
}

// The question is asked at least once in so many tests of blocks, so that it measures the work.
std::int64_t questions(const BroadPhase& phase, PairKind kind, IdPairs& pairs) {
  Asks asks;
  const PairSink sink{&pairs,
                      [](void* context, const IdPair* batch, std::size_t count) {
                        auto& all = *static_cast<IdPairs*>(context);
                        for (std::size_t i = 0; i < count; ++i) all.emplace_back(batch[i].a, batch[i].b);
                      },
                      asks.stop()};
  phase.traverse(kind, 0, phase.blocks(kind), sink);
  return asks.count;
}

}  // namespace

TEST_CASE("each primitive is in one slot, and runs hold all that overlap a box, once", "[property]") {
  scenes::Random random(17);
  for (int count : {0, 1, 7, 8, 9, 100, 3000})
    for (int exponent : {CellUnits::kLeastExponent, -6, 0, 40}) {
      const std::vector<FloatBox> boxes = uneven_boxes(count, random);
      const CellUnits units(exponent);
      const CellOrder order(boxes, units, {});
      INFO(count << " boxes, cells of 2^" << exponent);
      std::vector<int> used;
      for (const int at : order.slots())
        if (at >= 0) used.push_back(at);
      std::sort(used.begin(), used.end());
      REQUIRE(used.size() == boxes.size());
      for (int i = 0; i < count; ++i) REQUIRE(used[std::size_t(i)] == i);
      REQUIRE(order.slots().size() == 8 * order.blocks());
      for (std::size_t q = 0; q < order.blocks(); q += 1 + q / 8) {
        std::vector<int> found(order.blocks(), 0), runs(CellUnits::kBits, 0);
        order.each_run(order.box(q), order.level(q), [&](int level, int first, int last) {
          ++runs[std::size_t(level)];
          for (int b = first; b < last; ++b) {
            ++found[std::size_t(b)];
            REQUIRE(order.level(std::size_t(b)) == level);
          }
        });
        for (const int n : runs) REQUIRE(n <= 16);
        for (std::size_t b = 0; b < order.blocks(); ++b) {
          REQUIRE(found[b] <= 1);
          if (found[b] == 1 || order.level(b) < order.level(q)) continue;
          for (std::size_t i = 8 * q; i < 8 * q + 8; ++i)
            for (std::size_t j = 8 * b; j < 8 * b + 8; ++j)
              if (order.slots()[i] >= 0 && order.slots()[j] >= 0)
                REQUIRE_FALSE(
                    overlap(boxes[std::size_t(order.slots()[i])], boxes[std::size_t(order.slots()[j])]));
        }
      }
    }
}

TEST_CASE("cells are as wide as boxes where these are dense, and wide enough for some where they are not",
          "[unit]") {
  scenes::Random random(37);
  for (int count : {1, 100, 3000, 100000})
    for (double size : {1e-6, 1e-3, 0.1, 2.0}) {
      std::vector<FloatBox> boxes, none;
      for (int i = 0; i < count; ++i) {
        FloatBox b;
        for (std::size_t a = 0; a < 3; ++a)
          b.lo[a] = float(scenes::uniform(random, -1, 1)), b.hi[a] = b.lo[a] + float(size);
        boxes.push_back(b);
      }
      const int exponent = cell_exponent({&none, &boxes, &none});
      const CellOrder order(boxes, CellUnits(exponent), {});
      INFO(count << " boxes of " << size << ", cells of 2^" << exponent);
      CHECK(std::exp2(exponent) >= 0.9 * size);
      if (count * size * size * size > 100) CHECK(std::exp2(exponent) <= 4 * size);
      CHECK(order.blocks() * 8 <= 3 * boxes.size() + 8);
    }
  CHECK(cell_exponent({}) == CellUnits::kLeastExponent);
}

TEST_CASE("meshes of wildly uneven sizes cost the hash little more than even ones", "[property]") {
  scenes::Random random(29);
  constexpr int kFaces = 20000;
  const Soup even = sheet(kFaces, random);
  std::int64_t usual[2];
  for (PairKind kind : kKinds) {
    const Motion motion = even.motion();
    IdPairs pairs;
    usual[int(kind)] = questions(*make_broad_phase(BroadPhaseMethod::hash, {even.mesh, motion}), kind, pairs);
  }
  std::vector<Soup> uneven(4, even);
  uneven[0].name = "a huge triangle";
  for (std::size_t i = 0; i < 9; ++i) uneven[0].x_t0[i] = uneven[0].x_t1[i] = i % 4 == 0 ? 1e4 : -1e4;
  uneven[1].name = "a vertex at 1e15";
  uneven[1].x_t1[0] = 1e15, uneven[1].x_t1[1] = -1e15;
  uneven[2].name = "one in fifty is fifty times as large";
  for (std::size_t f = 0; f < kFaces / 50; ++f)
    for (std::size_t i = 9 * f; i < 9 * f + 9; ++i) {
      const std::size_t first = 9 * f + i % 3;
      for (auto* x : {&uneven[2].x_t0, &uneven[2].x_t1})
        if (i != first) (*x)[i] = (*x)[first] + 50 * ((*x)[i] - (*x)[first]);
    }
  uneven[3].name = "half in a corner of one cell";
  for (std::size_t i = 0; i < even.x_t0.size() / 2; ++i)
    for (auto* x : {&uneven[3].x_t0, &uneven[3].x_t1}) (*x)[i] *= 1e-4;
  for (const Soup& soup : uneven) {
    const Motion motion = soup.motion();
    const BroadPhaseInput input{soup.mesh, motion};
    const auto tree = make_broad_phase(BroadPhaseMethod::bvh, input),
               hash = make_broad_phase(BroadPhaseMethod::hash, input);
    for (PairKind kind : kKinds) {
      IdPairs by_tree, by_hash;
      questions(*tree, kind, by_tree);
      const std::int64_t asked = questions(*hash, kind, by_hash);
      INFO(soup.name << ", " << asked << " questions, " << by_tree.size() << " pairs");
      CHECK((sorted(by_hash) == sorted(by_tree)));
      CHECK(asked <= 3 * usual[int(kind)] + std::int64_t(by_tree.size() / 500));
    }
  }
}

TEST_CASE("the hash agrees with brute force on sizes over all levels", "[property]") {
  scenes::Random random(31);
  for (int round = 0; round < 6; ++round) {
    Soup soup = scattered("all sizes", 300, 1, round % 2 == 0 ? 1 : 0, random);
    for (std::size_t f = 0; f < 300; ++f) {
      const double size = std::exp2(scenes::uniform(random, -20, round < 3 ? 3 : 30));
      for (std::size_t i = 9 * f; i < 9 * f + 9; ++i)
        for (auto* x : {&soup.x_t0, &soup.x_t1}) {
          const double from = soup.x_t0[9 * f + i % 3];
          if (i >= 9 * f + 3) (*x)[i] = from + size * ((*x)[i] - from);
        }
    }
    const Motion motion = soup.motion();
    for (BoxTest test : {BoxTest::swept, BoxTest::both_ends, BoxTest::moving}) {
      BroadPhaseInput input{soup.mesh, motion};
      input.test = test;
      const auto brute = make_broad_phase(BroadPhaseMethod::brute, input),
                 hash = make_broad_phase(BroadPhaseMethod::hash, input);
      for (PairKind kind : kKinds) CHECK((candidates(*hash, kind) == candidates(*brute, kind)));
    }
  }
}
