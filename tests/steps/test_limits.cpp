// Active sets cut off by a window or by memory hold what they say, and spent checks are the same for any
// number of threads.
#include <tbb/global_control.h>

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/src/support/scene_set.hpp"
#include "tests/steps/support/promises.hpp"
#include "tests/steps/support/random_scenes.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

// Four threads even where there are fewer cores.
const tbb::global_control four_workers(tbb::global_control::max_allowed_parallelism, 4);

// Vertices over faces of their own, far from each other: the first a hair above its face and touching at 1/2,
// the others high and touching a little before.
StepScene many_pairs(int pairs) {
  StepScene s;
  s.x_t0.resize(4 * pairs, 3), s.faces.resize(pairs, 3);
  for (int i = 0; i < pairs; ++i) {
    const double x = 8 * (i % 40), y = 8 * (i / 40), height = i == 0 ? 1e-12 : 1;
    s.x_t0.middleRows(4 * i, 4) << x, y, height, x - 1, y - 1, 0, x + 1, y - 1, 0, x, y + 1, 0;
    s.faces.row(i) << 4 * i + 1, 4 * i + 2, 4 * i + 3;
  }
  s.x_t1 = s.x_t0;
  for (int i = 0; i < pairs; ++i) {
    const double at = i == 0 ? 0.5 : 0.45002 + 0.04 * ((i * 7919) % pairs) / pairs;
    s.x_t1(4 * i, 2) -= s.x_t0(4 * i, 2) / at;
  }
  s.edges = onset::edges(s.faces);
  return s;
}

std::int64_t bytes_of(std::int64_t contacts) { return 256 * contacts; }

// All calls that take a scene, with so many threads.
struct Answers {
  StepResult step, searched, listed, close;
  ActiveSet set;
  bool free;
};
Answers ask(const Calls& calls, const StepScene& s, Options o, int threads) {
  o.threads = threads;
  return {calls.ask(Call::whole, s.x_t0, s.x_t1, o, 0.1).result,
          calls.ask(Call::line_search, s.x_t0, s.x_t1, o, 0.1).result,
          calls.ask(Call::listed, s.x_t0, s.x_t1, o, 0.1).result,
          calls.ask(Call::close, s.x_t0, s.x_t1, o, 0.1).result,
          construct_active_set(calls.mesh(), s.x_t0, s.x_t1, o),
          is_step_collision_free(calls.mesh(), s.x_t0, s.x_t1, o)};
}

bool same(const Answers& a, const Answers& b) {
  return same_bytes(a.step, b.step) && same_bytes(a.searched, b.searched) && same_bytes(a.listed, b.listed) &&
         same_bytes(a.close, b.close) && same_bytes(a.set, b.set) &&
         a.set.complete_until == b.set.complete_until && a.free == b.free;
}

}  // namespace

TEST_CASE("every contact before complete_until is in a set cut off by memory", "[oracle][regression]") {
  const StepScene scene = many_pairs(1500);
  const Mesh mesh = scene.mesh();
  Options options;
  const SceneTruth truth(Asked{mesh, scene.x_t0, scene.x_t1, options, {}});
  REQUIRE(truth.contacts.size() == 1500);
  for (Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact})
    for (double tolerance : {1e-6, 1e-3})
      for (int contacts : {0, 1, 3, 10, 700, 1499, 1500}) {
        options.exactness = level, options.relative_tolerance = tolerance,
        options.memory_limit = bytes_of(contacts);
        const ActiveSet set = construct_active_set(mesh, scene.x_t0, scene.x_t1, options);
        CAPTURE(int(level), tolerance, contacts, set.complete_until, set.size());
        CHECK(set.size() <= std::size_t(contacts));
        CHECK(set.outcome == (contacts < 1500 ? Outcome::out_of_memory : Outcome::contact));
        for (const PairTruth& pair : truth.contacts)
          if (row_of(set, pair.key) == set.size() && pair.within.toi_lo < set.complete_until)
            FAIL_CHECK("without the contact of vertex " << pair.key.a << " at " << pair.within.toi_lo);
      }
}

TEST_CASE("windows and memory limits leave out no contact before complete_until", "[property][oracle]") {
  Random random(oracle::fuzz_seed() * 1000 + 61);
  int cut = 0;
  for (int i = 0; i < oracle::fuzz(120); ++i) {
    const StepScene scene = random_scene(random);
    const Mesh mesh = scene.mesh();
    Options options = random_options(scene, random);
    if (options.norm == Norm::maximum) options.min_separation = 0;
    const Asked asked{mesh, scene.x_t0, scene.x_t1, options, {}};
    const SceneTruth truth(asked);
    const ActiveSet full = construct_active_set(mesh, scene.x_t0, scene.x_t1, options);
    CHECK(wrong_set(asked, truth, full) == "");
    Options limited = options;
    if (scenes::coin(random))
      limited.window = scenes::integer(random, 0, 2) ? scenes::power_of_ten(random, -9, 0) : 0;
    if (scenes::coin(random)) limited.memory_limit = bytes_of(scenes::integer(random, 0, 6));
    const ActiveSet set = construct_active_set(mesh, scene.x_t0, scene.x_t1, limited);
    const std::string wrong = wrong_set({mesh, scene.x_t0, scene.x_t1, limited, {}}, truth, set);
    INFO("scene " << i << ", window " << limited.window << ", memory " << limited.memory_limit
                  << ", exactness " << int(limited.exactness) << ", complete until " << set.complete_until
                  << ", rows " << set.size());
    CHECK(wrong == "");
    if (full.size() > 0 && set.size() > 0) CHECK(set.earliest()->toi == full.earliest()->toi);
    CHECK(is_step_collision_free(mesh, scene.x_t0, scene.x_t1, limited) ==
          is_step_collision_free(mesh, scene.x_t0, scene.x_t1, options));
    cut += set.size() < full.size();
  }
  CHECK(10 * cut > oracle::fuzz(120));
}

TEST_CASE(
    "few checks, values of t_max and windows give the same bytes for any number of threads and either "
    "instruction set",
    "[determinism]") {
  Random random(oracle::fuzz_seed() * 1000 + 62);
  for (int i = 0; i < oracle::fuzz(24); ++i) {
    const scenes::Scene moving =
        i % 3 == 0 ? scenes::sphere_onto_sphere(10, 16, 0.01, scenes::uniform(random, 0, 0.3))
                   : scenes::triangle_soup(150, 0.2, scenes::power_of_ten(random, -3, 0), random);
    const StepScene scene{moving.x_t0, moving.x_t1, onset::edges(moving.faces), moving.faces};
    const Calls calls(scene);
    Options o = random_options(scene, random);
    o.max_checks = std::min<std::int64_t>(o.max_checks, 20), o.broad_phase = BroadPhaseMethod::automatic;
    o.min_separation = std::min(o.min_separation, 0.01);
    if (scenes::coin(random)) o.window = scenes::coin(random) ? 0 : 0.01;
    if (scenes::integer(random, 0, 3) == 0) o.memory_limit = bytes_of(scenes::integer(random, 0, 20));
    const Answers one = ask(calls, scene, o, 1);
    INFO("scene " << i << ", checks " << o.max_checks << ", exactness " << int(o.exactness) << ", narrow "
                  << int(o.narrow_phase) << ", window " << o.window << ", " << one.set.size() << " rows");
    for (int threads : {2, 4, 4}) CHECK(same(one, ask(calls, scene, o, threads)));
    o.instruction_set =
        o.instruction_set == InstructionSet::scalar ? InstructionSet::automatic : InstructionSet::scalar;
    CHECK(same(one, ask(calls, scene, o, 1)));
  }
}
