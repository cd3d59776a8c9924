// In the plane too no vertex meets an edge on the way to what truncate_step returns, at any pace.
#include <cstdio>

#include "tests/catch.hpp"
#include "tests/in_plane/support/plane_scenes.hpp"
#include "tests/oracle/promises.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

PlanePoint point(const Eigen::MatrixXd& x, int v) { return {x(v, 0), x(v, 1)}; }

}  // namespace

TEST_CASE("no vertex meets an edge on the way to what is stored in the plane", "[oracle][property]") {
  const int count = oracle::fuzz(60);
  std::size_t pairs = 0, met = 0, met_then = 0;
  double kept = 0;
  for (int i = 0; i < count; ++i) {
    scenes::Random random(oracle::fuzz_seed() * 9000011 + std::uint64_t(i));
    const PlaneScene scene =
        polygons(3, scenes::power_of_ten(random, -2, 0.5), random, scenes::power_of_ten(random, -9, 9));
    const Mesh mesh = scene.mesh();
    const TruncatedStep r = truncate_step(mesh, scene.x_t0, scene.x_t1);
    REQUIRE(r.positions.size() == 2 * std::size_t(mesh.num_vertices()));
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
    const Eigen::MatrixXd end = Eigen::Map<const Rows>(r.positions.data(), mesh.num_vertices(), 2);
    kept += r.kept;
    for (int v = 0; v < mesh.num_vertices(); ++v)
      for (std::ptrdiff_t e = 0; e < mesh.num_edges(); ++e) {
        const auto [a, b] = mesh.edge(e);
        if (v == a || v == b) continue;
        CAPTURE(i, v, e);
        ++pairs;
        VertexEdgeQuery q = query_of(scene, v, int(e));
        met += plane_truth(q).collides;
        const std::array<int, 3> of{v, a, b};
        const auto meets = [&](unsigned from, unsigned to) {  // a bit for each point that has moved
          const auto at = [&](std::size_t k, unsigned moved) {
            return point((moved >> k & 1u) != 0 ? end : scene.x_t0, of[k]);
          };
          for (std::size_t k = 0; k < 3; ++k) q.t0[k] = at(k, from), q.t1[k] = at(k, to);
          return plane_truth(q).collides;
        };
        const bool meet =
            meets(0, 7) || meets(0, 1) || meets(1, 7) || meets(0, 6) || meets(6, 7) || meets(2, 7);
        met_then += meet;
        CHECK_FALSE(meet);
      }
  }
  std::printf("%d scenes, %zu pairs: %zu would have met, %zu do; kept %.3f\n", count, pairs, met, met_then,
              kept / count);
  CHECK((met > 0 || count < 15));
}
