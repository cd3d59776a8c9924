// Which rows of two lists are one pair: against a search through all of them.
#include <algorithm>
#include <onset/match.hpp>

#include "tests/catch.hpp"
#include "tests/scenes/random.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

bool same(const Pair& p, const Pair& q) { return p.kind == q.kind && p.a == q.a && p.b == q.b; }

// For lists that name each pair once.
template <class List>
void check_against_search(const Matches& m, const List& from, const List& to) {
  REQUIRE((m.to_of_from.size() == from.size() && m.from_of_to.size() == to.size()));
  std::size_t count = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    int row = -1;
    for (std::size_t j = 0; j < to.size(); ++j)
      if (same(from[i], to[j])) row = int(j);
    CHECK(m.to_of_from[i] == row);
    if (row < 0) continue;
    CHECK(m.from_of_to[std::size_t(row)] == int(i));
    ++count;
  }
  CHECK(m.count == count);
  CHECK(std::size_t(std::count_if(m.from_of_to.begin(), m.from_of_to.end(),
                                  [](int row) { return row >= 0; })) == count);
}

std::vector<Pair> random_pairs(scenes::Random& random, int most) {
  std::vector<Pair> all;
  for (const PairKind kind : {PairKind::edge_edge, PairKind::vertex_face})
    for (int a = 0; a < most; ++a)
      for (int b = 0; b < most; ++b)
        if (scenes::coin(random)) all.push_back({kind, a, b, {}});
  std::shuffle(all.begin(), all.end(), random);
  return all;
}

}  // namespace

TEST_CASE("rows are matched in whatever order the lists are", "[unit]") {
  scenes::Random random(3);
  for (int most = 0; most < 7; ++most) {
    const std::vector<Pair> from = random_pairs(random, most), to = random_pairs(random, most);
    check_against_search(match(from, to), from, to);
  }
}

TEST_CASE("contacts and close pairs of one step are found again in the next", "[property]") {
  std::size_t kept = 0, gone = 0, come = 0;
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    const Eigen::MatrixXd &x = named.scene.x_t0, there = x + 0.1 * (named.scene.x_t1 - x);
    const ActiveSet last = construct_active_set(mesh, x, named.scene.x_t1),
                    now = construct_active_set(mesh, x, there);
    CAPTURE(named.name, last.size(), now.size());
    const Matches m = match(last, now);
    check_against_search(m, last.contacts, now.contacts);
    const ClosePairs near = close_pairs(mesh, x, 0.03), nearer = close_pairs(mesh, there, 0.03);
    const Matches n = match(near, nearer);
    check_against_search(n, near.pairs, nearer.pairs);
    kept += n.count, gone += near.size() - n.count, come += nearer.size() - n.count;
  }
  CHECK((kept > 100 && gone > 10 && come > 10));
}

TEST_CASE("pairs that are named several times are matched in turn", "[unit]") {
  const Pair p{PairKind::edge_edge, 1, 2, {}}, q{PairKind::vertex_face, 1, 2, {}};
  const Matches m = match(std::vector<Pair>{p, p, q, p}, {p, q, p});
  CHECK(m.to_of_from == std::vector<int>{0, 2, 1, -1});
  CHECK(m.from_of_to == std::vector<int>{0, 2, 1});
  CHECK(m.count == 3);
}
