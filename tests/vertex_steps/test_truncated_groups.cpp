// A step for each vertex where vertices go together: rigid bodies, copies that count as one, and bodies that
// copies hold together.
#include <numeric>
#include <onset/intersections.hpp>
#include <onset/truncate_step.hpp>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/random.hpp"
#include "tests/scenes/triangles.hpp"

using namespace onset;
using namespace onset::tests;
using Eigen::MatrixXd;
using scenes::Random;
using scenes::triangles;
using scenes::uniform;

namespace {

MatrixXd matrix(const std::vector<double>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
      rows.data(), Eigen::Index(rows.size() / 3), 3);
}

// Triangles, many with a corner where one before has one, in bodies of two triangles that may be rigid.
struct Joined {
  MatrixXd x, x_new;
  CollisionRules rules;
  explicit Joined(Random& random) {
    constexpr int kCount = 6;
    x.resize(3 * kCount, 3);
    const double size = scenes::power_of_ten(random, -6, 6);
    const auto any = [&](double most) {
      return Eigen::RowVector3d(uniform(random, -most, most), uniform(random, -most, most),
                                uniform(random, -most, most));
    };
    std::vector<int> joined(kCount, -1);
    for (int k = 0; k < kCount; ++k) {
      if (k > 0 && scenes::coin(random)) joined[std::size_t(k)] = scenes::integer(random, 0, 3 * k - 1);
      const int other = joined[std::size_t(k)];
      x.row(3 * k) = other < 0 ? any(2 * size) : Eigen::RowVector3d(x.row(other));
      for (int v = 1; v < 3; ++v) x.row(3 * k + v) = x.row(3 * k) + any(0.5 * size);
    }
    x_new = x;
    const double way = size * scenes::power_of_ten(random, -2, 1);
    for (Eigen::Index i = 0; i < x.size(); ++i) x_new(i / 3, i % 3) += uniform(random, -way, way);
    for (int k = 1; k < kCount; ++k) {
      const int other = joined[std::size_t(k)];
      if (other < 0) continue;
      if (scenes::integer(random, 0, 9) > 0) x_new.row(3 * k) = x_new.row(other);  // else no copy
    }
    rules.weld = true;
    for (int v = 0; v < 3 * kCount; ++v) rules.bodies.push_back(v / 6);
    for (int b = 0; b < kCount / 2; ++b) rules.rigid_bodies.push_back(scenes::coin(random));
    for (const auto& [v, w] : joints())  // joined elsewhere too, where these do not move alike
      if (v / 3 != w / 3 && x_new.row(v) != x_new.row(w)) rules.excluded_vertices.push_back({v, w});
  }
  std::vector<std::pair<int, int>> joints() const {
    std::vector<std::pair<int, int>> r;
    for (int v = 0; v < int(x.rows()); ++v)
      for (int w = v + 1; w < int(x.rows()); ++w)
        if (x.row(v) == x.row(w)) r.push_back({v, w});
    return r;
  }
  // Of each vertex a vertex of its group.
  std::vector<int> groups() const {
    std::vector<int> group(std::size_t(x.rows()));
    std::iota(group.begin(), group.end(), 0);
    const auto join = [&](int v, int w) {
      const int from = group[std::size_t(w)], to = group[std::size_t(v)];
      for (int& g : group)
        if (g == from) g = to;
    };
    for (const auto& [v, w] : joints())
      if (x_new.row(v) == x_new.row(w)) join(v, w);
    for (int v = 0; v < int(x.rows()); ++v)
      if (rules.rigid_bodies[std::size_t(v / 6)]) join(v / 6 * 6, v);
    return group;
  }
};

}  // namespace

TEST_CASE("d-hat opens no seam between a rigid body and what it is joined to", "[unit]") {
  MatrixXd x(6, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, -1, 0;
  MatrixXd x_new = x;
  x_new.col(2).array() += 0.1;
  x_new(2, 2) = 3;
  CollisionRules rules;
  rules.weld = true, rules.bodies = {0, 0, 0, 1, 1, 1}, rules.rigid_bodies = {true, false};
  TruncateOptions o;
  o.d_hat = 1;
  const TruncatedStep r = truncate_step(Mesh(6, triangles(2), rules), x, x_new, o);
  CHECK(r.outcome == Outcome::free);
  for (const std::size_t v : {0u, 1u, 2u, 3u}) CHECK(std::fabs(r.share[v] - 0.5 / 3) < 1e-12);
  CHECK((r.share[4] == 1 && r.share[5] == 1));
  CHECK(matrix(r.positions).row(0) == matrix(r.positions).row(3));
}

TEST_CASE("what goes together goes by one share, whatever d-hat is", "[property]") {
  int scenes_done = 0, free = 0;
  for (int i = 0; i < fuzz(600); ++i) {
    Random random(std::uint64_t(i) + 4713);
    const Joined scene(random);
    const Mesh mesh(int(scene.x.rows()), triangles(int(scene.x.rows()) / 3), scene.rules);
    if (has_intersections(mesh, scene.x)) continue;
    ++scenes_done;
    TruncateOptions o;
    const double size = scene.x.cwiseAbs().maxCoeff();
    if (i % 3 != 0) o.d_hat = size * scenes::power_of_ten(random, -3, 1);
    const TruncatedStep r = truncate_step(mesh, scene.x, scene.x_new, o);
    const MatrixXd end = matrix(r.positions);
    const std::vector<int> group = scene.groups();
    std::vector<double> least(group.size(), 1.0);
    for (std::size_t v = 0; v < group.size(); ++v) {
      const double way = (scene.x_new - scene.x).row(Eigen::Index(v)).norm();
      double& of_group = least[std::size_t(group[v])];
      if (o.d_hat && way > 0) of_group = std::min(of_group, 0.5 * *o.d_hat / way);
    }
    CAPTURE(i, int(r.outcome), o.d_hat.value_or(-1));
    free += r.outcome == Outcome::free;
    REQUIRE((r.outcome == Outcome::free || r.outcome == Outcome::contact));  // only what is joined touches
    for (std::size_t v = 0; v < group.size(); ++v) {
      CAPTURE(v);
      REQUIRE(r.share[v] == r.share[std::size_t(group[v])]);
      const double most = least[std::size_t(group[v])];
      REQUIRE(r.share[v] <= most);
      if (r.limited_by[v] < 0) REQUIRE(r.share[v] >= most * (1 - 1e-12));
    }
    for (const auto& [v, w] : scene.joints())
      if (scene.x_new.row(v) == scene.x_new.row(w)) REQUIRE(end.row(v) == end.row(w));
    REQUIRE_FALSE(has_intersections(mesh, end));
  }
  CAPTURE(scenes_done, free);
  CHECK((scenes_done > fuzz(50) && free > fuzz(10)));
}
