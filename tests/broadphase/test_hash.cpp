// The cells of the hash: nothing is lost between levels, and meshes of uneven sizes cost no more than even
// ones.
#include <tbb/task_arena.h>

#include "base/parallel.hpp"
#include "broadphase/bvh/space_curve.hpp"
#include "broadphase/hash/cell_order.hpp"
#include "broadphase/hash/cell_width.hpp"
#include "broadphase/hash/hash_side.hpp"
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

// Small triangles over a sphere.
Soup shell(int faces, scenes::Random& random) {
  Soup soup = scattered("shell", faces, 0.005, 0, random);
  for (std::size_t f = 0; f < 9 * std::size_t(faces); f += 9) {
    const double x = soup.x_t0[f], y = soup.x_t0[f + 1], z = soup.x_t0[f + 2];
    const double by = 1 / std::sqrt(x * x + y * y + z * z) - 1;
    for (std::size_t i = f; i < f + 9; ++i) soup.x_t0[i] += by * soup.x_t0[f + i % 3];
  }
  soup.x_t1 = soup.x_t0;
  return soup;
}

// Moves `of` of each hundred triangles to a body of its own, `scale` times as large and `offset` away.
Soup two_bodies(Soup soup, const std::string& name, int of, double scale, double offset) {
  soup.name = name;
  for (std::size_t i = 0; i < soup.x_t0.size(); ++i)
    if (int(i / 9 % 100) < of)
      for (auto* x : {&soup.x_t0, &soup.x_t1}) (*x)[i] = scale * (*x)[i] + offset;
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
          REQUIRE(level >= order.level(q));
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

TEST_CASE(
    "of two sides one asks for its own level and above, one for what is above, and each overlap is found "
    "once",
    "[property]") {
  scenes::Random random(19);
  for (int exponent : {CellUnits::kLeastExponent, -6, 0, 40}) {
    const std::vector<FloatBox> boxes[2] = {uneven_boxes(900, random), uneven_boxes(700, random)};
    const CellUnits units(exponent);
    const CellOrder sides[2] = {CellOrder(boxes[0], units, {}), CellOrder(boxes[1], units, {})};
    std::vector<int> found(boxes[0].size() * boxes[1].size(), 0);
    const auto ask = [&](int asking, int above) {
      const CellOrder &own = sides[asking], &other = sides[1 - asking];
      for (std::size_t q = 0; q < own.blocks(); ++q)
        other.each_run(own.box(q), own.level(q) + above, [&](int level, int first, int last) {
          REQUIRE(level >= own.level(q) + above);
          for (std::size_t i = 8 * q; i < 8 * q + 8; ++i)
            for (std::size_t j = 8 * std::size_t(first); j < 8 * std::size_t(last); ++j) {
              const int a = own.slots()[i], b = other.slots()[j];
              if (a < 0 || b < 0) continue;
              ++found[std::size_t(asking == 0 ? a : b) * boxes[1].size() + std::size_t(asking == 0 ? b : a)];
            }
        });
    };
    ask(0, 0), ask(1, 1);
    INFO("cells of 2^" << exponent);
    for (std::size_t a = 0; a < boxes[0].size(); ++a)
      for (std::size_t b = 0; b < boxes[1].size(); ++b) {
        const int n = found[a * boxes[1].size() + b];
        REQUIRE(n <= 1);
        if (n == 0) REQUIRE_FALSE(overlap(boxes[0][a], boxes[1][b]));
      }
  }
}

// Simple loops over items ask once in kItemsALook of them. One thread asks in the same order each time.
TEST_CASE("all that makes the cells asks whether it is still wanted", "[property]") {
  constexpr int kLooks = 8, kCount = kLooks * int(kItemsALook);
  std::vector<FloatBox> apart, together;
  for (int i = 0; i < kCount; ++i) {
    const float x = float(i % 300), y = float(i / 300), size = 0x1p-4f;
    apart.push_back({{0, x, y}, {size, x + size, y + size}});
    together.push_back({{x, y, 0}, {x + size, y + size, size}});
  }
  MeshData mesh;
  mesh.num_vertices = kCount;
  const std::vector<double> x(3 * std::size_t(kCount), 0.0);
  const Motion motion = make_motion(kCount, {x.data(), kCount}, {x.data(), kCount});
  const BroadPhaseInput input{mesh, motion};
  const FloatMap map(motion);
  tbb::task_arena(1).execute([&] {
    Asks width, loops, rows, curve, crowd, ranks, supports;
    cell_exponent({&apart}, width.stop());
    CHECK(width.count >= kLooks);
    for (int i = 0; i < 2; ++i)  // boxes to units, and to keys
      parallel_ranges(kCount, 4096, [&](std::size_t first, std::size_t last) {
        each_unless(loops.stop(), first, last, [](std::size_t) {});
      });
    // levels, five times in a sort, blocks, rows and a table
    CHECK(CellOrder(apart, CellUnits(-3), rows.stop()).blocks() == std::size_t(kCount));
    CHECK(rows.count >= loops.count + 9 * kLooks);
    std::vector<float> points;
    for (const FloatBox& box : together)
      for (std::size_t k = 0; k < 3; ++k) points.push_back(box.lo[k] + box.hi[k]);
    std::vector<int> order(kCount);
    order_along_curve(points.data(), kCount, order.data(), curve.stop());
    // levels, once in a sort, cells, points and blocks
    CHECK(CellOrder(together, CellUnits(40), crowd.stop()).blocks() * 8 == std::size_t(kCount));
    CHECK(crowd.count >= loops.count + curve.count + 5 * kLooks);
    // vertices are numbered and ranked, then get supports
    const HashVertices vertices(input, map, false, ranks.stop());
    make_supports(input, 0, map, Primitive::vertex, vertices.order.vertex.data(), kCount, supports.stop());
    CHECK(ranks.count == supports.count + 2 * kLooks);
  });
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

// No input may cost work that grows with the square of the primitives: the tree's does not. Without an order
// in crowded cells, two of these ask ten times as often as they do, more so with more primitives.
TEST_CASE("meshes of wildly uneven sizes and places cost the hash little more than the tree", "[property]") {
  scenes::Random random(29);
  constexpr int kFaces = 40000;
  const Soup even = sheet(kFaces, random), round = shell(kFaces, random);
  std::vector<Soup> all(5, even);
  all[1].name = "a huge triangle";
  for (std::size_t i = 0; i < 9; ++i) all[1].x_t0[i] = all[1].x_t1[i] = i % 4 == 0 ? 1e4 : -1e4;
  all[2].name = "a vertex at 1e15";
  all[2].x_t1[0] = 1e15, all[2].x_t1[1] = -1e15;
  all[3].name = "one in fifty is fifty times as large";
  for (std::size_t f = 0; f < kFaces / 50; ++f)
    for (std::size_t i = 9 * f; i < 9 * f + 9; ++i) {
      const std::size_t first = 9 * f + i % 3;
      for (auto* x : {&all[3].x_t0, &all[3].x_t1})
        if (i != first) (*x)[i] = (*x)[first] + 50 * ((*x)[i] - (*x)[first]);
    }
  all[4].name = "at rest, so that vertices are points";
  all[4].x_t1 = all[4].x_t0;
  for (double offset : {100.0, 1000.0, 4000.0, 1e6})
    all.push_back(two_bodies(round, "two bodies " + std::to_string(offset) + " apart", 45, 1, offset));
  for (double scale : {1e-2, 1e-4, 1e-6})
    for (int of : {40, 60})
      all.push_back(two_bodies(
          even, std::to_string(of) + " % in a place " + std::to_string(1e6 * scale) + " / 1e6 as wide", of,
          scale, 0));
  all.push_back(
      two_bodies(two_bodies(even, "", 60, 1e-4, 0.3), "three sizes in three places", 30, 1e-2, 1e5));
  for (const Soup& soup : all) {
    const Motion motion = soup.motion();
    const BroadPhaseInput input{soup.mesh, motion};
    const auto tree = make_broad_phase(BroadPhaseMethod::bvh, input),
               hash = make_broad_phase(BroadPhaseMethod::hash, input);
    for (PairKind kind : kKinds) {
      IdPairs by_tree, by_hash;
      const std::int64_t least = questions(*tree, kind, by_tree), asked = questions(*hash, kind, by_hash);
      INFO(soup.name << ", " << asked << " questions, " << least << " of the tree, " << by_tree.size()
                     << " pairs");
      CHECK((sorted(by_hash) == sorted(by_tree)));
      const std::size_t units = hash->blocks(kind);  // each is a question
      CHECK(asked <= std::int64_t(units) + 6 * least);
      const std::size_t each_face = kind == PairKind::vertex_face ? 4 : 3;  // vertices and faces, or edges
      CHECK(64 * units <= 3 * each_face * kFaces + 2048);
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
