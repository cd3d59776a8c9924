// Whatever the size of a scene and of its gaps, what truncate_step returns brings no pair together, exactly,
// at any pace.
#include <cstdio>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/oracle/stored.hpp"
#include "tests/vertex_steps/near_scenes.hpp"

using namespace onset;
using namespace onset::tests;
using Eigen::MatrixXd;
using scenes::Query;

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

MatrixXd matrix(const std::vector<double>& rows) {
  return Eigen::Map<const Rows>(rows.data(), Eigen::Index(rows.size() / 3), 3);
}

struct Tally {
  std::size_t scenes = 0, pairs = 0, crossings = 0, kept_apart = 0, touching = 0, too_close = 0;
  std::size_t asked_exactly = 0, limited = 0;
  double kept = 0;
};

bool touches(const Query& q, Tally& tally) {
  if (oracle::surely_apart(q)) return false;
  ++tally.asked_exactly;
  return oracle::exact_ccd(q).collides;
}

// The pair on its way from `q.t0` to `q.t1`: all vertices at once, one primitive before the other, and some
// vertices before the others.
bool meets_at_some_pace(const Query& q, unsigned pick, Tally& tally) {
  const unsigned side = q.kind == PairKind::vertex_face ? 1u : 3u;
  if (touches(q, tally)) return true;
  for (const unsigned first : {side, 15u - side, pick & 15u}) {
    Query before = q, after = q;
    for (std::size_t i = 0; i < 4; ++i)
      before.t1[i] = after.t0[i] = (first >> i & 1u) != 0 ? q.t1[i] : q.t0[i];
    if (touches(before, tally) || touches(after, tally)) return true;
  }
  return false;
}

void check_pairs(const NearScene& near, const Mesh& mesh, const TruncatedStep& r, unsigned pick,
                 Tally& tally) {
  const MatrixXd &x = near.scene.x_t0, end = matrix(r.positions), sum = x + matrix(r.displacements);
  for_all_pairs(mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    CAPTURE(int(kind), a, b);
    ++tally.pairs;
    const Query asked = query_of(kind, v, x, near.scene.x_t1), kept = query_of(kind, v, x, end);
    if (oracle::boxes_apart(asked, 1.5 * near.options.min_separation)) return;
    if (oracle::compare_distance_at_rest(kind, kept.t0, 0) == 0) {
      ++tally.touching;
      CHECK(r.outcome == Outcome::initial_contact);
      for (const int w : v) CHECK(r.share[std::size_t(w)] == 0);
      return;
    }
    const bool met = touches(asked, tally), meets = meets_at_some_pace(kept, pick, tally);
    tally.crossings += meets, tally.kept_apart += met && !meets;
    CHECK_FALSE(meets);
    if (sum != end) CHECK_FALSE(touches(query_of(kind, v, x, sum), tally));
    const double d = near.options.min_separation;
    if (d > 0 && oracle::compare_distance_at_rest(kind, kept.t0, d, near.options.norm) > 0) {
      const bool within = oracle::exact_within(kept, d, near.options.norm).collides;
      tally.too_close += within;
      CHECK_FALSE(within);
    }
  });
}

void check_report(const NearScene& near, const Mesh& mesh, const TruncatedStep& r) {
  const MatrixXd &x = near.scene.x_t0, end = matrix(r.positions);
  REQUIRE(r.share.size() == std::size_t(mesh.num_vertices()));
  std::vector<bool> named(r.pairs.size());
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double share = r.share[std::size_t(v)];
    const int by = r.limited_by[std::size_t(v)];
    CAPTURE(v, share, by);
    CHECK((share >= 0 && share <= 1));
    if (share == 1 && by < 0) CHECK(end.row(v) == near.scene.x_t1.row(v));
    if (share == 0) CHECK(end.row(v) == x.row(v));
    if (by < 0) continue;
    REQUIRE(by < int(r.pairs.size()));
    named[std::size_t(by)] = true;
    const auto& of_pair = r.pairs[std::size_t(by)].vertices;
    CHECK(std::count(of_pair.begin(), of_pair.end(), int(v)) > 0);
  }
  CHECK(std::count(named.begin(), named.end(), false) == 0);
  CHECK((r.outcome == Outcome::free) == !r.limiting);
  CHECK((r.kept >= 0 && r.kept <= 1));
}

}  // namespace

TEST_CASE("no pair meets on the way to what is stored, whatever the pace, size and gap",
          "[oracle][property]") {
  Tally tally;
  const int count = oracle::fuzz(300);
  for (int i = 0; i < count; ++i) {
    scenes::Random random(oracle::fuzz_seed() * 1000003 + std::uint64_t(i));
    const NearScene near = near_scene(random);
    const Mesh mesh = near.scene.mesh();
    CAPTURE(i, near.options.min_separation, near.options.gap_share, near.options.d_hat.value_or(-1));
    const TruncatedStep r = truncate_step(mesh, near.scene.x_t0, near.scene.x_t1, near.options);
    ++tally.scenes;
    tally.kept += r.kept, tally.limited += r.outcome == Outcome::contact;
    check_report(near, mesh, r);
    check_pairs(near, mesh, r, unsigned(random()), tally);
  }
  std::printf(
      "%zu scenes, %zu pairs: %zu that would have met do not, %zu crossings, %zu within their separation; "
      "%zu touch at "
      "the start; %zu scenes limited, %zu answers exact; kept %.3f\n",
      tally.scenes, tally.pairs, tally.kept_apart, tally.crossings, tally.too_close, tally.touching,
      tally.limited, tally.asked_exactly, tally.kept / double(tally.scenes));
  CHECK(tally.crossings + tally.too_close == 0);
  CHECK(tally.kept_apart > tally.scenes);
  CHECK(tally.touching > tally.scenes / 10);
}
