#include "tests/fuzz/mesh_truth.hpp"

#include <algorithm>
#include <cmath>

#include "base/instruction_set.hpp"
#include "scene/pairs/separation.hpp"
#include "tests/fuzz/digest.hpp"
#include "tests/narrowphase/exact/exact_query.hpp"
#include "tests/oracle/quick.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/scenes/families.hpp"
#include "tests/scenes/rule_filter.hpp"
#include "tests/src/start/brute_intersections.hpp"
#include "tests/steps/support/pair_separations.hpp"
#include "tests/steps/support/promises.hpp"

namespace onset::fuzz {
namespace {

using scenes::Query;
using tests::Key;

bool within_rings(const MeshInput& input, const std::vector<int>& A, const std::vector<int>& B) {
  const int rings = input.rules.excluded_rings;
  return rings > 0 && scenes::EdgeDistances(input.vertices, input.edges).within(rings, A, B);
}

bool lets_meet(const MeshInput& input, PairKind kind, int a, int b, const std::array<int, 4>& v) {
  const int first = scenes::first_body(kind);
  const std::vector<int> A(v.begin(), v.begin() + first), B(v.begin() + first, v.end());
  return scenes::left_out(input.rules, A, B) == scenes::LeftOut::no &&
         !scenes::excludes_pair(input.rules, kind, a, b) && !within_rings(input, A, B);
}

// `wrong`: empty, or a pair that keeps another distance than the rules say.
tests::Asked asked_of(const MeshInput& input, const Mesh& mesh, std::string& wrong) {
  tests::Asked asked{mesh, input.x_t0, input.x_t1, input.options, input.rules.thickness, input.rules.weld};
  asked.lets = [input](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    return lets_meet(input, kind, a, b, v);
  };
  if (has_pair_separations(mesh.data())) asked.keeps = tests::separations_of(mesh, input.options, wrong);
  return asked;
}

// The rules at one time, where copies that are to be welded are at one place.
bool is_welded_at_start(const MeshInput& input, PairKind kind, const std::array<int, 4>& v) {
  for (int i = 0; i < scenes::first_body(kind); ++i)
    for (int j = scenes::first_body(kind); j < 4; ++j)
      if (input.rules.weld && input.x_t0.row(v[std::size_t(i)]) == input.x_t0.row(v[std::size_t(j)]))
        return true;
  return false;
}

std::string about(const char* what, const Key& pair, const Query& motion) {
  return std::string(what) + ": " + scenes::name(pair.kind) + " " + std::to_string(pair.a) + " and " +
         std::to_string(pair.b) + ", " + scenes::to_text(motion);
}

bool is_listed(const Candidates& candidates, const Key& pair) {
  const auto& list = pair.kind == PairKind::vertex_face ? candidates.vertex_face : candidates.edge_edge;
  return std::binary_search(list.begin(), list.end(), std::array<int, 2>{pair.a, pair.b});
}
template <class List>
bool is_among(const List& pairs, const Key& key) {
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const Pair& p) { return p.kind == key.kind && p.a == key.a && p.b == key.b; });
}

// Every call, as bytes with a name each.
std::vector<std::pair<const char*, std::string>> all_answers(const MeshInput& input, const Mesh& mesh,
                                                             const Options& o) {
  const Eigen::MatrixXd &x0 = input.x_t0, &x1 = input.x_t1;
  std::vector<std::pair<const char*, std::string>> all;
  const auto add = [&](const char* name, const auto& answer) { all.emplace_back(name, digest(answer)); };
  const Candidates candidates = compute_candidates(mesh, x0, x1, o);
  const ClosePairs close = close_pairs(mesh, x0, input.d_hat, o);
  add("active set", construct_active_set(mesh, x0, x1, o));
  add("step", compute_collision_free_stepsize(mesh, x0, x1, o));
  add("is free", is_step_collision_free(mesh, x0, x1, o));
  add("candidates", candidates), add("counted candidates", count_candidates(mesh, x0, x1, o));
  add("close pairs", close);
  add("intersections", intersections(mesh, x0, o)), add("has intersections", has_intersections(mesh, x0, o));
  add("check", check(mesh, x0, o));
  LineSearchOptions with_gap(o);
  with_gap.gap_share = input.gap_share, with_gap.d_hat = input.d_hat;
  const LineSearch search(mesh, x0, Eigen::MatrixXd(x1 - x0), with_gap);
  add("line search", search.largest_step()), add("line search to a half", search.largest_step(0.5));
  add("close pairs of a line search", search.close_pairs(0.25));
  if (candidates.outcome == Outcome::free)
    add("step of candidates", compute_collision_free_stepsize(mesh, candidates, x0, x1, o, input.gap_share));
  if (close.outcome == Outcome::free) {
    add("safe distances", safe_distances(mesh, x0, close));
    add("step of close pairs", compute_cfl_stepsize(mesh, x0, x1, close, o, input.gap_share));
  }
  return all;
}

// Whether the ends of both motions are usable: a difference may be infinite where positions are not.
bool has_direction(const MeshInput& input) { return (input.x_t1 - input.x_t0).allFinite(); }

}  // namespace

std::string broken_by_methods(const MeshInput& input) {
  const Mesh mesh = input.mesh();
  Options o = input.options;
  o.broad_phase = BroadPhaseMethod::brute, o.instruction_set = InstructionSet::scalar, o.threads = 1;
  const auto expected = all_answers(input, mesh, o);
  struct Way {
    const char* name;
    BroadPhaseMethod method;
    InstructionSet instruction_set;
    int threads;
  };
  const InstructionSet narrow = has_avx2() ? InstructionSet::avx2 : InstructionSet::scalar;
  const Way ways[] = {
      {"tree", BroadPhaseMethod::bvh, InstructionSet::scalar, 1},
      {"tree, the widest packs, two threads", BroadPhaseMethod::automatic, InstructionSet::automatic, 2},
      {"hash, AVX2", BroadPhaseMethod::hash, narrow, 1}};
  for (const Way& way : ways) {
    mesh.release_memory();  // what an earlier way found at rest is found anew
    o.broad_phase = way.method, o.instruction_set = way.instruction_set, o.threads = way.threads;
    const auto found = all_answers(input, mesh, o);
    for (std::size_t i = 0; i < std::max(expected.size(), found.size()); ++i)
      if (i >= found.size() || i >= expected.size() || found[i] != expected[i])
        return std::string("other bytes by ") + way.name + ": " +
               expected[std::min(i, expected.size() - 1)].first;
  }
  return {};
}

std::string broken_by_integers(const MeshInput& input) {
  const Mesh mesh = input.mesh();
  std::string wrong;
  const tests::Asked asked = asked_of(input, mesh, wrong);
  const Eigen::MatrixXd &x0 = input.x_t0, &x1 = input.x_t1;
  Options o = input.options;
  o.threads = 1;
  const Candidates candidates = compute_candidates(mesh, x0, x1, o);
  const ActiveSet set = construct_active_set(mesh, x0, x1, o);
  const StepResult step = compute_collision_free_stepsize(mesh, x0, x1, o);
  const bool free = is_step_collision_free(mesh, x0, x1, o);
  const ClosePairs close = close_pairs(mesh, x0, input.d_hat, o);
  const StartReport start = check(mesh, x0, o);
  std::string broken;
  asked.for_pairs([&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    if (!broken.empty()) return;
    const Key key{kind, a, b};
    const Query motion = tests::query_of(kind, v, x0, x1);
    if (oracle::surely_apart(motion)) return;
    const auto first = exact_first_contact(scenes::exact_pair(motion));
    if (!first) return;
    const auto fail = [&](const char* what) { broken = about(what, key, motion); };
    const bool at_start = first->hi == 0, listed = at_start && !is_welded_at_start(input, kind, v),
               passes = at_start && o.touching_may_pass_through;
    if (!is_listed(candidates, key)) return fail("no candidate");
    const std::size_t row = tests::row_of(set, key);
    if (row == set.size() && first->lo < set.complete_until) return fail("missed by the active set");
    if (row < set.size() && !(set[row].toi <= first->lo)) return fail("late in the active set");
    if (!passes && free) return fail("called free");
    if (!passes && !(step.toi <= first->lo)) return fail("toi of the step is late");
    if (!passes &&
        !(first->lo == first->hi && first->lo > 0 ? step.step < first->lo : step.step <= first->lo))
      return fail("the step goes into it");
    if (listed && !is_among(close, key)) return fail("touches, but is no close pair");
    if (listed && !is_among(start.touching, key)) return fail("touches, but check() does not list it");
  });
  for (const Pair& p : start.touching) {
    const Query rest = tests::query_of(p.kind, p.vertices, x0, x0);
    const bool meets =
        lets_meet(input, p.kind, p.a, p.b, p.vertices) && !is_welded_at_start(input, p.kind, p.vertices);
    if (broken.empty() && (!meets || !exact_first_contact(scenes::exact_pair(rest))))
      broken = about("check() lists a pair that does not touch", {p.kind, p.a, p.b}, rest);
  }
  if (!broken.empty()) return broken;
  double limit = INFINITY;
  for (const Contact& row : set) limit = std::min(limit, row.step_limit);
  if (step.step > limit) return "the step is beyond a row's step_limit";
  for (const Contact& row : set)
    if (!lets_meet(input, row.kind, row.a, row.b, row.vertices)) return "a row that the rules leave out";
  return {};
}

namespace {

std::string wrong_close_pairs(const MeshInput& input, const tests::Asked& asked, const Mesh& mesh) {
  const ClosePairs close = close_pairs(mesh, input.x_t0, input.d_hat, input.options);
  std::string wrong;
  asked.for_pairs([&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    const Query rest = tests::query_of(kind, v, input.x_t0, input.x_t0);
    const double norm = input.options.norm == Norm::maximum ? std::sqrt(3.0) : 1;
    const double reach = input.d_hat + norm * asked.separation(kind, v),
                 slack = 0x1p-44 * (oracle::extent(rest) + reach);
    if (!wrong.empty() || reach > 0x1p500 || is_welded_at_start(input, kind, v)) return;
    const bool listed = is_among(close, {kind, a, b});
    if (!listed && !oracle::boxes_apart(rest, reach) &&
        oracle::compare_distance(rest, 0, reach * (1 - 0x1p-50)) < 0)
      wrong = about("a close pair is left out", {kind, a, b}, rest);
    if (listed &&
        (oracle::boxes_apart(rest, reach + slack) || oracle::compare_distance(rest, 0, reach + slack) > 0))
      wrong = about("a close pair is too far apart", {kind, a, b}, rest);
  });
  return wrong;
}

std::string wrong_intersections(const MeshInput& input, const Mesh& mesh) {
  const auto lets = [&](int e, int f) {
    const auto edge = mesh.edge(e);
    const auto face = mesh.face(f);
    const std::vector<int> A(edge.begin(), edge.end()), B(face.begin(), face.end());
    if (scenes::left_out(input.rules, A, B) != scenes::LeftOut::no) return false;
    if (scenes::excludes_intersection(input.rules, e, f) || within_rings(input, A, B)) return false;
    for (int v : A)
      for (int w : B)
        if (input.rules.weld && input.x_t0.row(v) == input.x_t0.row(w)) return false;
    return true;
  };
  const auto expected = tests::brute_intersections(mesh, input.x_t0, lets);
  const Intersections found = intersections(mesh, input.x_t0, input.options);
  if (has_intersections(mesh, input.x_t0, input.options) == expected.empty())
    return "has_intersections() is wrong";
  return tests::plain(found.pairs) == expected ? std::string() : "other intersections than brute force finds";
}

}  // namespace

std::string broken_by_rationals(const MeshInput& input) {
  MeshInput whole = input;
  whole.options.window = INFINITY, whole.options.threads = 1;
  const Mesh mesh = whole.mesh();
  std::string wrong;
  const tests::Asked asked = asked_of(whole, mesh, wrong);
  if (!wrong.empty()) return wrong;
  tests::StepScene scene;
  scene.x_t0 = whole.x_t0, scene.x_t1 = whole.x_t1;
  const Mesh plain = whole.mesh_without_rules();
  scene.edges.resize(plain.num_edges(), 2), scene.faces.resize(plain.num_faces(), 3);
  for (Eigen::Index e = 0; e < scene.edges.rows(); ++e)
    scene.edges.row(e) << plain.edge(e)[0], plain.edge(e)[1];
  for (Eigen::Index f = 0; f < scene.faces.rows(); ++f)
    scene.faces.row(f) << plain.face(f)[0], plain.face(f)[1], plain.face(f)[2];
  tests::Calls calls(scene);
  calls.mesh().set_rules(whole.rules);
  std::string broken = tests::broken_promise(asked, calls, whole.d_hat, whole.gap_share);
  if (broken.empty()) broken = wrong_intersections(whole, mesh);
  return broken.empty() ? wrong_close_pairs(whole, asked, mesh) : broken;
}

namespace {

bool spent(Outcome outcome) {
  return outcome == Outcome::out_of_checks || outcome == Outcome::out_of_memory ||
         outcome == Outcome::out_of_time || outcome == Outcome::cancelled;
}

}  // namespace

std::string broken_by_budgets(const MeshInput& input, std::int64_t check_limit, std::int64_t memory_limit,
                              int cancel_after) {
  const Mesh mesh = input.mesh();
  const Eigen::MatrixXd &x0 = input.x_t0, &x1 = input.x_t1;
  Options whole = input.options;
  whole.threads = 1, whole.window = INFINITY;
  // A memory limit, of any size, has the times of an active set compared: at Exactness::exact all are exact.
  if (memory_limit < whole.memory_limit) --whole.memory_limit;
  Options o = whole;
  o.check_limit = check_limit, o.memory_limit = memory_limit;
  int calls = 0;
  if (cancel_after > 0) o.progress = [&](double) { return ++calls < cancel_after; };
  const StepResult full = compute_collision_free_stepsize(mesh, x0, x1, whole);
  const ActiveSet all = construct_active_set(mesh, x0, x1, whole);
  const StepResult step = compute_collision_free_stepsize(mesh, x0, x1, o);
  if (spent(step.outcome) ? step.step != 0 : step.step > full.step)
    return "a spent budget lets a step go farther";
  if (!spent(step.outcome) && digest(step) != digest(full))
    return "a budget that is not spent changes the step";
  calls = 0;
  const ActiveSet set = construct_active_set(mesh, x0, x1, o);
  for (const Contact& row : set)
    if (tests::row_of(all, {row.kind, row.a, row.b}) == all.size()) return "a spent budget adds a contact";
  // By exact times: with a budget a row may be told less exactly, and earlier.
  for (const Contact& row : all) {
    const Query motion = tests::query_of(row.kind, row.vertices, x0, x1);
    const auto first = exact_first_contact(scenes::exact_pair(motion));
    if (first && first->lo < set.complete_until && tests::row_of(set, {row.kind, row.a, row.b}) == set.size())
      return "a spent budget leaves out a contact before complete_until";
  }
  if (!spent(set.outcome) && digest(set) != digest(all))
    return "a budget that is not spent changes the active set";
  calls = 0;
  const Candidates candidates = compute_candidates(mesh, x0, x1, o);
  if (spent(candidates.outcome) && !(candidates.vertex_face.empty() && candidates.edge_edge.empty()))
    return "candidates of a spent budget";
  calls = 0;
  const ClosePairs close = close_pairs(mesh, x0, input.d_hat, o);
  if (spent(close.outcome) && close.size() > 0) return "close pairs of a spent budget";
  calls = 0;
  const StartReport start = check(mesh, x0, o);
  if (spent(start.outcome) && start.acceptable()) return "an acceptable start, unseen";
  calls = 0;
  o.threads = 2;
  if (cancel_after == 0 && digest(construct_active_set(mesh, x0, x1, o)) != digest(set))
    return "a spent budget depends on the threads";
  return {};
}

std::string broken_by_bad_positions(const MeshInput& input) {
  const Mesh mesh = input.mesh();
  const Eigen::MatrixXd &x0 = input.x_t0, &x1 = input.x_t1;
  Options o = input.options;
  o.threads = 1;
  const auto bad = [](Outcome outcome) {
    return outcome == Outcome::non_finite || outcome == Outcome::out_of_range;
  };
  const auto is_bad = [](const Eigen::MatrixXd& x, int v) {
    return v >= 0 && v < x.rows() && !(x.row(v).allFinite() && x.row(v).cwiseAbs().maxCoeff() <= 0x1p1020);
  };
  const StepResult step = compute_collision_free_stepsize(mesh, x0, x1, o);
  if (!bad(step.outcome) || step.step != 0) return "a step from or to bad positions";
  if (!is_bad(x0, step.vertex) && !is_bad(x1, step.vertex)) return "a vertex is named that is not bad";
  const ActiveSet set = construct_active_set(mesh, x0, x1, o);
  if (!bad(set.outcome) || !set.empty()) return "an active set of bad positions";
  if (is_step_collision_free(mesh, x0, x1, o)) return "bad positions are called free";
  const Candidates candidates = compute_candidates(mesh, x0, x1, o);
  if (!bad(candidates.outcome) || candidates.counts.total() != 0) return "candidates of bad positions";
  bool bad_start = false;
  for (int v = 0; v < input.vertices; ++v) bad_start = bad_start || is_bad(x0, v);
  if (bad(close_pairs(mesh, x0, input.d_hat, o).outcome) != bad_start) return "close pairs of bad positions";
  if (bad(intersections(mesh, x0, o).outcome) != bad_start) return "intersections of bad positions";
  if (bad_start && !has_intersections(mesh, x0, o)) return "bad positions without intersections";
  if (bad(check(mesh, x0, o).outcome) != bad_start) return "check() of bad positions";
  if (has_direction(input)) {
    const LineSearch search(mesh, x0, Eigen::MatrixXd(x1 - x0), o);
    if (search.largest_step().step != 0 && bad_start) return "a line search from bad positions";
  }
  return {};
}

}  // namespace onset::fuzz
