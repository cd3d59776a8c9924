// One pair as a scene: the step never reaches the exact contact, and a start in touch is not left.
#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/src/support/one_pair.hpp"

using namespace onset;
using scenes::Query;
using tests::mesh_of;
using tests::positions;

namespace {

std::string wrong_step(const Query& query, const StepResult& result) {
  const double step = result.step;
  if (!(step >= 0 && step <= 1)) return "step outside [0, 1]";
  const oracle::Truth truth = oracle::exact_ccd(query);
  if (!truth.collides || step < truth.toi_lo) return {};
  if (truth.toi_hi == 0) return step == 0 ? "" : "steps while in touch";
  const bool before = truth.toi_lo < truth.toi_hi && step == truth.toi_lo;
  return before ? "" : "steps over a contact";
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
