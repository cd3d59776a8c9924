// The step is the earliest time of the active set, and the three calls agree.
#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"
#include "tests/src/support/scene_set.hpp"

using namespace onset;
using namespace onset::tests;

namespace {

std::vector<Options> ways_to_ask() {
  std::vector<Options> all(6);
  all[1].min_separation = 0.02;
  all[2].min_separation = 0.02, all[2].norm = Norm::maximum, all[2].max_checks = 500;
  all[3].relative_tolerance = 1e-2;
  all[4].max_checks = 1;
  all[5].narrow_phase = NarrowPhaseMethod::inclusion, all[5].max_checks = 100;
  return all;
}

// Entries that limit a step by their toi: what separates at the start does not.
bool limits(const Contact& contact) { return contact.outcome != PairOutcome::initial_separating; }

}  // namespace

TEST_CASE("the step is the smallest toi of the active set, bit for bit", "[property]") {
  int limited = 0, free = 0;
  for (const NamedScene& named : some_scenes())
    for (const Options& o : ways_to_ask()) {
      const Mesh mesh = named.mesh();
      const ActiveSet active = construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1, o);
      const StepResult step = compute_collision_free_stepsize(mesh, named.scene.x_t0, named.scene.x_t1, o);
      CAPTURE(named.name, o.min_separation, int(o.norm), o.max_checks, active.size(), step.step,
              to_string(step.outcome));
      double smallest = 1;
      const Contact* at = nullptr;
      bool parting = false;
      for (const Contact& c : active) {
        CHECK(c.toi >= 0);
        CHECK(c.toi <= 1);
        CHECK((c.toi > 0 || c.outcome == PairOutcome::initial_contact ||
               c.outcome == PairOutcome::initial_separating));
        parting |= !limits(c);
        if (limits(c) && c.toi < smallest) smallest = c.toi, at = &c;
      }
      CHECK(step.step <= smallest);
      CHECK((step.step > 0 || step.outcome == Outcome::initial_contact ||
             step.outcome == Outcome::below_rounding));
      if (!parting) {  // what parts at the start may be met again, which only the step tells
        CHECK(step.toi == (at == nullptr ? INFINITY : smallest));
        CHECK(step.step >= smallest * (1 - 1e-6) - 1e-9);  // rounding takes little
        CHECK((at == nullptr || step.limiting));
        CHECK((at == nullptr || at == active.earliest()));
      }
      CHECK((step.step == 1) == (step.outcome == Outcome::free));
      CHECK(is_step_collision_free(mesh, named.scene.x_t0, named.scene.x_t1, o) ==
            (step.outcome == Outcome::free));
      ++(step.step < 1 ? limited : free);
    }
  CHECK(limited > 10);
  CHECK(free > 5);
}

TEST_CASE("the active set is sorted and names each pair once, with its vertices", "[property]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    const ActiveSet s = construct_active_set(mesh, named.scene.x_t0, named.scene.x_t1);
    CAPTURE(named.name);
    CHECK(s.outcome == (s.size() > 0 ? Outcome::contact : Outcome::free));
    CHECK(s.stats.contacts.total() == std::int64_t(s.size()));
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (i > 0)
        CHECK(std::tuple(s[i - 1].kind, s[i - 1].a, s[i - 1].b) < std::tuple(s[i].kind, s[i].a, s[i].b));
      const auto& v = s[i].vertices;
      if (s[i].kind == PairKind::vertex_face) {
        const auto f = mesh.face(s[i].b);
        CHECK(v == std::array<int, 4>{s[i].a, f[0], f[1], f[2]});
      } else {
        const auto e = mesh.edge(s[i].a), g = mesh.edge(s[i].b);
        CHECK(s[i].a < s[i].b);
        CHECK(v == std::array<int, 4>{e[0], e[1], g[0], g[1]});
      }
      CHECK(std::count(v.begin(), v.end(), v[0]) == 1);
    }
  }
}

// A simulator's loop: step, and go on from there. Each step starts apart, so none is zero.
TEST_CASE("steps taken one after the other are not zero", "[property]") {
  for (const NamedScene& named : some_scenes()) {
    const Mesh mesh = named.mesh();
    Options o;
    if (compute_collision_free_stepsize(mesh, named.scene.x_t0, named.scene.x_t1, o).outcome ==
        Outcome::initial_contact)
      continue;  // soups may start in contact
    Eigen::MatrixXd x = named.scene.x_t0;
    for (int i = 0; i < 3; ++i) {
      const StepResult r = compute_collision_free_stepsize(mesh, x, named.scene.x_t1, o);
      CAPTURE(named.name, i, r.step, to_string(r.outcome));
      CHECK(r.step > 0);
      x += 0.9 * r.step * (named.scene.x_t1 - x);
    }
  }
}
