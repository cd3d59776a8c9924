// Whole scenes in other units, at another place, with axes exchanged or mirrored: the same active set and
// step, bit for bit.
#include <cmath>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/narrowphase/symmetries.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Random;
using scenes::Scene;

namespace {

Scene permuted(const Scene& scene, const SignedPermutation& p) {
  Scene other = scene;
  for (int i = 0; i < 3; ++i) {
    other.x_t0.col(i) = p.signs[i] * scene.x_t0.col(p.axes[i]);
    other.x_t1.col(i) = p.signs[i] * scene.x_t1.col(p.axes[i]);
  }
  return other;
}

Scene scaled(Scene scene, double s) {
  scene.x_t0 *= s, scene.x_t1 *= s;
  return scene;
}

std::vector<Options> ways_to_ask() {
  std::vector<Options> all(4);
  all[1].min_separation = 0.01;
  all[2].min_separation = 0.003, all[2].norm = Norm::maximum, all[2].broad_phase = BroadPhaseMethod::brute;
  all[2].max_checks = 300;
  all[3].tolerance = 1e-3, all[3].max_checks = 3;
  return all;
}

const SignedPermutation kIdentity{{0, 1, 2}, {1, 1, 1}};

// The contacts' geometry as the other scene has it; zeros without a sign.
ActiveSet in_other_scene(ActiveSet set, double unit, const SignedPermutation& p) {
  for (Contact& c : set.contacts) {
    const auto n = c.normal;
    for (int a = 0; a < 3; ++a) c.normal[a] = p.signs[a] * n[p.axes[a]] + 0.0;
    c.gap *= unit, c.tolerance *= unit, c.speed = c.speed * unit + 0.0;
  }
  return set;
}

// Where a step ends depends on how coarse positions are where the scene lies, and on nothing else but the
// unit.
void expect_same_step(StepResult a, const StepResult& b, double unit) {
  a.rounding *= unit;
  if (a.rounding == b.rounding) {
    CHECK(same_bytes(a, b));
    return;
  }
  CHECK(a.toi == b.toi);
  CHECK(a.toi_hi == b.toi_hi);
  CHECK(a.certainty == b.certainty);
  CHECK((b.step <= b.toi && a.step <= a.toi));
}

// The other scene is asked in its own units.
void expect_same(const NamedScene& named, const Scene& other, const Options& o, double unit = 1,
                 const SignedPermutation& p = kIdentity) {
  const Mesh mesh = named.mesh();
  Options there = o;
  there.min_separation *= unit;
  if (o.tolerance) there.tolerance = *o.tolerance * unit;
  for (InstructionSet kernel : kernels()) {
    Options first = o;
    first.instruction_set = there.instruction_set = kernel;
    const auto a = construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, first);
    const auto b = construct_active_set(mesh, other.x_t0, other.x_t1, there);
    CAPTURE(named.name, to_string(kernel), o.min_separation, unit, a.size(), b.size());
    CHECK(same_bytes(in_other_scene(a, unit, p), in_other_scene(b, 1, kIdentity)));
    expect_same_step(compute_collision_free_stepsize(mesh, named.scene.x_t0, named.scene.x_t1, first),
                     compute_collision_free_stepsize(mesh, other.x_t0, other.x_t1, there), unit);
    CHECK(a.stats.tolerance * unit == b.stats.tolerance);
    CHECK(a.stats.extent * unit == b.stats.extent);
  }
}

}  // namespace

TEST_CASE("scenes with permuted and mirrored axes give the same bits", "[property][equivariance]") {
  const auto permutations = signed_permutations();
  Random random(101);
  for (const NamedScene& named : some_scenes())
    for (const Options& o : ways_to_ask())
      for (int i = 0; i < fuzz(5); ++i) {
        const SignedPermutation& p = permutations[std::size_t(scenes::integer(random, 1, 47))];
        expect_same(named, permuted(named.scene, p), o, 1, p);
      }
}

TEST_CASE("scenes scaled by powers of two give the same bits", "[property][equivariance]") {
  for (const NamedScene& named : some_scenes())
    for (const Options& o : ways_to_ask())
      for (int exponent : {-300, -37, 1, 300})
        expect_same(named, scaled(named.scene, std::ldexp(1.0, exponent)), o, std::ldexp(1.0, exponent));
}

TEST_CASE("scenes translated exactly give the same bits", "[property][equivariance]") {
  Random random(102);
  for (NamedScene named : some_scenes()) {
    named.scene = on_grid(named.scene);
    for (const Options& o : ways_to_ask())
      for (int bits : {2, 20, 31}) {
        const Point p = scenes::grid_point(random, bits);
        expect_same(named, translated(named.scene, {p[0], p[1], p[2]}), o);
      }
  }
}

// The separation is exactly the gap, or one unit in the last place less or more: whether the boxes overlap
// must not depend on where the scene is.
TEST_CASE("translation does not decide whether a pair is near enough to be tested",
          "[property][equivariance]") {
  Random random(103);
  const double gap = 0x1.2345p-3;
  NamedScene named{"falling triangle", {}};
  named.scene = scenes::translated(scenes::triangle_soup(1, 0, 0, random), {0, 0, 0});
  named.scene.x_t0.resize(4, 3), named.scene.faces.resize(1, 3);
  named.scene.x_t0 << 0, 0, 1, -1, -1, 0, 1, -1, 0, 0, 1, 0;
  named.scene.faces << 1, 2, 3;
  named.scene.x_t1 = named.scene.x_t0;
  named.scene.x_t1(0, 2) = gap;
  for (double d : {std::nextafter(gap, 0), gap, std::nextafter(gap, 1), gap * (1 - 0x1p-40), gap * 0.75})
    for (int bits : {0, 10, 25, 31}) {
      Options o;
      o.min_separation = d;
      const Point p = scenes::grid_point(random, bits);
      expect_same(named, translated(named.scene, {p[0], p[1], p[2]}), o);
    }
}
