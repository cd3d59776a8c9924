// Every candidate pair of the recorded steps, decided exactly, against the active set at each level of
// certainty. Half a minute.
#include <map>
#include <onset/active_set.hpp>
#include <onset/candidates.hpp>

#include "tests/catch.hpp"
#include "tests/narrowphase/exact/exact_query.hpp"
#include "tests/scenes/data.hpp"
#include "tests/scenes/frame_file.hpp"

using namespace onset;

namespace {

const char* name(Exactness level) {
  return level == Exactness::exact ? "exact" : level == Exactness::certify ? "certify" : "conservative";
}

using Key = std::array<int, 3>;  // kind, a, b

// The exact first contact of those candidates that touch.
struct Truth {
  std::size_t candidates = 0, quick = 0;  // quick: decided without integers of any size
  std::map<Key, DoubleBracket> contacts;
};

Truth decide_all(const scenes::Recording& recording, const std::vector<std::array<int, 2>>& edges,
                 const Candidates& candidates) {
  Truth truth;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (const auto& [a, b] : kind == PairKind::vertex_face ? candidates.vertex_face : candidates.edge_edge) {
      const scenes::Query query = scenes::query_of(recording, kind, {a, b, false}, edges);
      const ExactPair pair = scenes::exact_pair(query);
      ++truth.candidates;
      ExactAnswer answer = exact_answer(pair, Effort::quick);
      if (answer.answer != Answer::unknown)
        ++truth.quick;
      else
        answer = exact_answer(pair, Effort::complete);
      if (answer.answer == Answer::no) continue;
      const auto first = exact_first_contact(pair);
      REQUIRE(first.has_value());
      CHECK(answer.time.lo <= first->lo);
      CHECK(first->hi <= answer.time.hi);
      truth.contacts[{int(kind), a, b}] = *first;
    }
  return truth;
}

struct Differences {
  int missed = 0, false_positives = 0, late = 0, too_early_hi = 0, wrong_flags = 0, certain = 0;
};

Differences compare(const Truth& truth, const ActiveSet& set) {
  Differences d;
  std::map<Key, std::size_t> rows;
  for (std::size_t i = 0; i < set.size(); ++i) rows[{int(set[i].kind), set[i].a, set[i].b}] = i;
  for (const auto& [key, time] : truth.contacts) {
    const auto row = rows.find(key);
    if (row == rows.end()) {
      ++d.missed;
      continue;
    }
    const std::size_t i = row->second;
    d.late += set[i].toi > time.lo;
    d.too_early_hi += set[i].toi_hi < time.hi;
    d.wrong_flags += (set[i].certainty == Certainty::touching_at_start) && time.hi > 0;
  }
  for (const auto& [key, i] : rows) {
    const bool real = truth.contacts.count(key) > 0;
    const bool certain = set[i].certainty != Certainty::within_tolerance;
    d.false_positives += !real;
    d.certain += certain;
    d.wrong_flags += certain && !real;
  }
  return d;
}

void check_step(const std::string& folder, const scenes::RecordedStep& step) {
  const scenes::Recording recording = scenes::read_recording(folder, step);
  const Mesh mesh(recording.t0.x, recording.t0.faces);
  Options options;
  options.relative_tolerance = 1e-8;
  const Candidates candidates = compute_candidates(mesh, recording.t0.x, recording.t1.x, options);
  const Truth truth = decide_all(recording, edge_list(recording.t0.faces), candidates);
  CHECK(truth.candidates == candidates.vertex_face.size() + candidates.edge_edge.size());
  std::printf("%s: %zu candidates, %zu decided quickly, %zu contacts\n", step.name, truth.candidates,
              truth.quick, truth.contacts.size());
  for (const Exactness level : {Exactness::conservative, Exactness::certify, Exactness::exact}) {
    options.exactness = level;
    const ActiveSet set = construct_active_set(mesh, recording.t0.x, recording.t1.x, options);
    const Differences d = compare(truth, set);
    std::printf(
        "  %-12s %6zu found, %d missed, %d false, %d late, %d of toi_hi early, %d certain, %d wrongly\n",
        name(level), set.size(), d.missed, d.false_positives, d.late, d.too_early_hi, d.certain,
        d.wrong_flags);
    INFO(step.name << " " << name(level));
    CHECK(d.missed == 0);
    CHECK(d.late == 0);
    CHECK(d.too_early_hi == 0);
    CHECK(d.wrong_flags == 0);
    if (level == Exactness::exact) CHECK(d.false_positives == 0);
    if (level == Exactness::exact) CHECK(d.certain == int(set.size()));
  }
}

}  // namespace

TEST_CASE("every candidate of the recorded steps: the active set holds those that touch", "[oracle][data]") {
  const std::string folder = scenes::data_folder("every candidate of the recorded steps");
  if (folder.empty()) return;
  for (const scenes::RecordedStep& step : scenes::recorded_steps()) check_step(folder, step);
}
