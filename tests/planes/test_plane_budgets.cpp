// Many contacts with planes: what memory holds of them, and how soon a call ends.
#include <algorithm>
#include <tuple>

#include "base/parallel.hpp"
#include "src/planes/plane_blocks.hpp"
#include "tests/catch.hpp"
#include "tests/counted_clock.hpp"
#include "tests/scenes/meshes.hpp"
#include "tests/scenes/random.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

// Vertices before planes that they all fall through, at different times.
struct Fall {
  Eigen::MatrixXd x0, x1;
  CollisionRules rules;

  Fall(int vertices, int planes, Random& random) : x0(vertices, 3), x1(vertices, 3) {
    for (int v = 0; v < vertices; ++v) x0.row(v) << v % 300, v / 300, scenes::uniform(random, 0.5, 1);
    x1 = x0;
    x1.col(2).array() -= 2;
    for (int p = 0; p < planes; ++p) rules.planes.push_back({{0, 0, 1}, -0.01 * p});
  }
  Mesh mesh() const { return Mesh(int(x0.rows()), Indices(), Indices(), rules); }
};

}  // namespace

TEST_CASE("what a cancelled search before planes found is not put in order but for some of it", "[planes]") {
  Random random(79);
  const Fall fall(100000, 4, random);
  const Mesh mesh = fall.mesh();
  const PlaneBlocks blocks(mesh.data(), {0, 1, 2}, Norm::euclidean);
  const std::size_t count = 400000;
  const CountedClock clock;
  for (const int last : {1, 20000, 1000000}) {
    std::int64_t told = 0, keys = 0;
    std::size_t visited = 0;
    Options o;
    o.progress = [&](double) { return ++told < last; };
    Budget budget(o);
    Gathered<IdPair> all;
    in_arena(1, [&] {
      gather_planes(
          blocks, count, budget,
          [&](const PlaneBlock& block, int v, std::vector<IdPair>& found) {
            ++visited, found.push_back({v, block.row});
          },
          [&](const IdPair& p) {
            ++keys;
            return p;
          },
          all);
    });
    CAPTURE(last, visited, keys);
    CHECK(std::is_sorted(all.found.begin(), all.found.end(), [](const IdPair& p, const IdPair& q) {
      return p.a != q.a ? p.a < q.a : p.b < q.b;
    }));
    CHECK_FALSE(all.too_many);
    CHECK(all.found.size() == (last == 1000000 ? count : std::min(visited, kRowsCutOff)));
    if (last < 1000000) CHECK(keys <= 32 * std::int64_t(kRowsCutOff));
    if (last == 20000) CHECK(visited > count / 2);
    if (last == 1000000) CHECK(clock.looks() > 100);
  }
}

TEST_CASE("the earliest contacts with planes that memory holds are kept, and time is looked at", "[planes]") {
  Random random(80);
  const Fall fall(20000, 3, random);
  const Mesh mesh = fall.mesh();
  Options o;
  o.threads = 1;
  const ActiveSet whole = construct_active_set(mesh, fall.x0, fall.x1, o);
  REQUIRE(whole.size() == 60000);
  std::vector<double> times;
  for (const Contact& c : whole) times.push_back(c.toi);
  std::sort(times.begin(), times.end());
  o.memory_limit = 1 << 20;
  const ActiveSet some = construct_active_set(mesh, fall.x0, fall.x1, o);
  REQUIRE((some.outcome == Outcome::out_of_memory && some.size() > 1000 && some.size() < 20000));
  for (const Contact& c : some) CHECK(c.toi <= times[some.size() - 1]);
  o.threads = 4;
  CHECK(same_bytes(construct_active_set(mesh, fall.x0, fall.x1, o), some));
  const CountedClock clock;
  o.threads = 1, o.time_limit = 1e12;
  const std::int64_t begun = clock.looks();
  construct_active_set(mesh, fall.x0, fall.x1, o);
  const std::int64_t looks = clock.looks() - begun;
  for (std::int64_t n = 1; n < looks; n += 1 + n / 3) {
    o.time_limit = double(n);
    const ActiveSet cut = construct_active_set(mesh, fall.x0, fall.x1, o);
    if (n < looks / 2) CHECK(cut.outcome == Outcome::out_of_time);
    CHECK((cut.outcome != Outcome::out_of_time || cut.complete_until == 0));
  }
}

TEST_CASE("of contacts among pairs and with planes the earliest that memory holds are kept", "[planes]") {
  Random random(81);
  scenes::Scene s = scenes::cloth(30, 30);
  scenes::shake(s, 0.3, random);
  s.x_t1.col(2).array() -= 2;
  CollisionRules rules;
  rules.planes = {{{0, 0, 1}, -0.5}};
  const Mesh mesh(s.x_t0, s.faces, rules);
  Options o;
  o.threads = 1;
  const ActiveSet whole = construct_active_set(mesh, s.x_t0, s.x_t1, o);
  const std::int64_t planes = whole.stats.contacts.vertex_plane, pairs = std::int64_t(whole.size()) - planes;
  REQUIRE((planes > 100 && pairs > 100));
  const auto earlier = [](const Contact& x, const Contact& y) {
    return std::tie(x.toi, x.kind, x.a, x.b) < std::tie(y.toi, y.kind, y.a, y.b);
  };
  const auto before = [](const Contact& x, const Contact& y) {
    return std::tie(x.kind, x.a, x.b) < std::tie(y.kind, y.a, y.b);
  };
  std::vector<Contact> expected(whole.begin(), whole.end());
  std::sort(expected.begin(), expected.end(), earlier);
  o.memory_limit = 256 * (std::max(planes, pairs) + std::min(planes, pairs) / 2);
  const ActiveSet some = construct_active_set(mesh, s.x_t0, s.x_t1, o);
  CHECK(some.outcome == Outcome::out_of_memory);
  REQUIRE((some.size() > 100 && some.size() < whole.size()));
  expected.resize(some.size());
  std::sort(expected.begin(), expected.end(), before);
  CHECK(std::equal(some.begin(), some.end(), expected.begin(),
                   [&](const Contact& x, const Contact& y) { return !before(x, y) && !before(y, x); }));
  const CountedClock clock;
  for (std::int64_t n = 1, ended = true; ended != 0; n += 1 + n / 3) {
    o.time_limit = double(n);
    const ActiveSet cut = construct_active_set(mesh, s.x_t0, s.x_t1, o);
    ended = cut.outcome == Outcome::out_of_time;
    CHECK(std::is_sorted(cut.begin(), cut.end(), before));
    if (ended != 0) CHECK(cut.complete_until == 0);
  }
}
