// One pair as a scene: the step never reaches the exact contact, and a start in touch is left only where that
// is safe.
#include "onset/onset.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/walk.hpp"

using namespace onset;
using scenes::Query;

namespace {

Mesh mesh_of(PairKind kind) {
  Eigen::MatrixXi edges(0, 2), faces(0, 3);
  if (kind == PairKind::vertex_face) {
    faces.resize(1, 3);
    faces << 1, 2, 3;
  } else {
    edges.resize(2, 2);
    edges << 0, 1, 2, 3;
  }
  return Mesh(4, complete_edges(edges, faces), faces);
}

Eigen::MatrixXd positions(const std::array<Point, 4>& points) {
  Eigen::MatrixXd x(4, 3);
  for (int i = 0; i < 4; ++i) x.row(i) << points[i][0], points[i][1], points[i][2];
  return x;
}

std::string wrong_step(const Query& query, const StepResult& result) {
  const double step = result.step;
  if (!(step >= 0 && step <= 1)) return "step outside [0, 1]";
  const oracle::Truth truth = oracle::exact_ccd(query);
  if (truth.collides && truth.toi_lo > 0 && !(step <= truth.toi_lo)) return "steps over a contact";
  if (!truth.collides || truth.toi_lo > 0 || step == 0) return {};
  const oracle::Truth next = oracle::exact_ccd_after_start(query);
  if (next.collides && !(step <= next.toi_lo)) return "steps over the contact after the one at the start";
  if (oracle::moves_as_one(query)) return {};  // in touch for ever, and no closer
  for (double part : {0x1p-40, 0x1p-20, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99})
    if (oracle::compare_distance(query, part * step, 0) == 0) return "steps while in touch";
  return {};
}

}  // namespace

// f(family, query, options, result) for random queries of every family.
template <class F>
static void for_all_steps(F&& f) {
  const int count = oracle::fuzz(15);
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      const Mesh mesh = mesh_of(kind);
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 6);
      for (int i = 0; i < count; ++i) {
        const Query query = family.make(kind, random);
        Options options;
        options.relative_tolerance = scenes::power_of_ten(random, -14, -1);
        f(family, query, options,
          compute_collision_free_stepsize(mesh, positions(query.t0), positions(query.t1), options));
      }
    }
}

TEST_CASE("the step of a scene of one pair stays before the exact contact", "[property][oracle]") {
  for_all_steps(
      [](const scenes::Family& family, const Query& query, const Options& options, const StepResult& result) {
        const std::string wrong = wrong_step(query, result);
        if (wrong.empty()) return;
        INFO(family.name << " " << to_text(query));
        INFO("tolerance " << options.relative_tolerance << " -> " << to_string(result.outcome) << " "
                          << result.step);
        FAIL_CHECK(wrong);
      });
  SUCCEED();
}
