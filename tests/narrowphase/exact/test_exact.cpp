// The exact decision in integers against the rational oracle, which shares no code with it.
// ONSET_FUZZ=100 for a long run, ONSET_SEED=n for other queries.
#include "narrowphase/exact/complete.hpp"
#include "onset/mesh.hpp"
#include "tests/catch.hpp"
#include "tests/narrowphase/exact/exact_query.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/queries/query_file.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/data.hpp"
#include "tests/scenes/frame_file.hpp"

using namespace onset;
using scenes::Query;

namespace {

struct Tally {
  int queries = 0, contacts = 0, wrong = 0;
};

std::string text(const std::optional<DoubleBracket>& t) {
  if (!t) return "none";
  char s[80];
  std::snprintf(s, sizeof s, "[%a, %a]", t->lo, t->hi);
  return s;
}

bool agrees(const oracle::Truth& truth, const std::optional<DoubleBracket>& t) {
  return truth.collides == t.has_value() && (!t || (t->lo == truth.toi_lo && t->hi == truth.toi_hi));
}

void check(const Query& query, Tally& tally) {
  const oracle::Truth truth = oracle::exact_ccd(query);
  const ExactPair pair = scenes::exact_pair(query);
  ++tally.queries;
  tally.contacts += truth.collides;
  const auto first = exact_first_contact(pair);
  if (agrees(truth, first) && exactly_touches(pair) == truth.collides) return;
  ++tally.wrong;
  INFO(to_text(query));
  INFO("oracle " << truth.collides << " [" << truth.toi_lo << ", " << truth.toi_hi << "], here "
                 << text(first));
  CHECK(false);
}

// Full mantissas throughout, as the study's traps have them: small integers, shared points, two scales.
Query grid(PairKind kind, scenes::Random& random) {
  Query query = scenes::grid_query(kind, random, scenes::integer(random, 1, 6));
  const int shared = scenes::integer(random, 0, 5);
  if (shared == 0) query.t1 = query.t0;
  if (shared == 1) query.t0[0] = query.t0[3];
  if (shared == 2) query.t1[1] = query.t1[2], query.t0[1] = query.t0[2];
  if (shared == 3)
    for (auto* points : {&query.t0, &query.t1})
      for (Point& p : *points) p[2] = p[0];
  return query;
}
Query two_scales(PairKind kind, scenes::Random& random) {
  Query query = grid(kind, random);
  const double tiny = std::ldexp(1.0, -scenes::integer(random, 10, 200));
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points)
      for (double& x : p) x += tiny * scenes::integer(random, -2, 2);
  return query;
}

Query backwards(Query query) {
  std::swap(query.t0, query.t1);
  return query;
}

}  // namespace

TEST_CASE("exact decision and bracket agree with the oracle on every family", "[property][oracle]") {
  Tally tally;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 31);
      for (int i = 0; i < oracle::fuzz(50); ++i) {
        const Query query = family.make(kind, random);
        INFO(family.name);
        check(query, tally);
      }
    }
  CHECK(tally.wrong == 0);
  CHECK(tally.contacts > tally.queries / 4);
  std::printf("families: %d queries, %d contacts, %d wrong\n", tally.queries, tally.contacts, tally.wrong);
}

TEST_CASE("exact decision and bracket agree with the oracle on small integers and two scales",
          "[property][oracle]") {
  Tally tally;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    scenes::Random random(oracle::fuzz_seed() * 2 + (kind == PairKind::edge_edge));
    for (int i = 0; i < oracle::fuzz(1500); ++i) {
      check(grid(kind, random), tally);
      check(two_scales(kind, random), tally);
      check(scenes::mixed_query(kind, random), tally);
    }
  }
  CHECK(tally.wrong == 0);
  CHECK(tally.contacts > tally.queries / 8);
  std::printf("integers: %d queries, %d contacts, %d wrong\n", tally.queries, tally.contacts, tally.wrong);
}

// What answers most queries is not what answers the rest: the rest must be able to answer all.
TEST_CASE("the complete decision agrees with the search in fixed width", "[property]") {
  int contacts = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 32);
      for (int i = 0; i < oracle::fuzz(20); ++i) {
        const Query query = family.make(kind, random);
        const ExactPair pair = scenes::exact_pair(query);
        const auto quick = exact_first_contact(pair), complete = complete_first_contact(pair);
        INFO(family.name << " " << to_text(query) << text(quick) << text(complete));
        CHECK(quick.has_value() == complete.has_value());
        contacts += complete.has_value();
        if (!quick || !complete) continue;
        CHECK(quick->lo == complete->lo);
        CHECK(quick->hi == complete->hi);
      }
    }
  CHECK(contacts > 100);
}

// The last contact is the first one of the reversed motion.
TEST_CASE("contact from a time on: until the last contact, and no longer", "[property][oracle]") {
  int before = 0, after = 0;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, oracle::fuzz_seed() + 33);
      for (int i = 0; i < oracle::fuzz(20); ++i) {
        const Query query = family.make(kind, random);
        const oracle::Truth reversed = oracle::exact_ccd(backwards(query));
        const ExactPair pair = scenes::exact_pair(query);
        INFO(family.name << " " << to_text(query));
        const double last_lo = reversed.collides ? 1 - reversed.toi_hi : -1;
        const double last_hi = reversed.collides ? 1 - reversed.toi_lo : -1;
        for (double from : {scenes::uniform(random, 0, 1), last_lo - 0x1p-50, last_hi + 0x1p-50}) {
          if (!(from > 0) || from >= 1) continue;
          const bool touches = exactly_touches(pair, from);
          if (from < last_lo - 0x1p-52 && ++before) CHECK(touches);
          if (from > last_hi + 0x1p-52 && ++after) CHECK_FALSE(touches);
        }
      }
    }
  CHECK(before > 100);
  CHECK(after > 100);
}

TEST_CASE("exact decision of every hand-made query", "[oracle][data]") {
  const std::string folder = scenes::data_folder("exact decision of every hand-made query");
  if (folder.empty()) return;
  int queries = 0, wrong = 0;
  for (const scenes::QueryFile& file : scenes::query_files(folder))
    for (const scenes::LabelledQuery& labelled : scenes::read_queries(file.path, file.kind)) {
      ++queries;
      const ExactPair pair = scenes::exact_pair(labelled.query);
      if (exactly_touches(pair) == labelled.collides &&
          exact_first_contact(pair).has_value() == labelled.collides)
        continue;
      ++wrong;
      FAIL_CHECK(file.path << " " << to_text(labelled.query));
    }
  CHECK(queries > 2000);
  CHECK(wrong == 0);
}

TEST_CASE("exact decision of every listed pair of the recorded steps", "[oracle][data]") {
  const std::string folder = scenes::data_folder("exact decision of every listed pair of the recorded steps");
  if (folder.empty()) return;
  for (const scenes::RecordedStep& step : scenes::recorded_steps()) {
    const scenes::Recording recording = scenes::read_recording(folder, step);
    const auto edges = edge_list(recording.t0.faces);
    int wrong = 0;
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
      for (const auto& listed : kind == PairKind::vertex_face ? recording.vertex_face : recording.edge_edge) {
        const Query query = scenes::query_of(recording, kind, listed, edges);
        wrong += exactly_touches(scenes::exact_pair(query)) != listed.collides;
      }
    INFO(step.name);
    CHECK(wrong == 0);
  }
}
