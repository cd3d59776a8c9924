#include "tests/steps/support/scene_truth.hpp"

#include "tests/oracle/quick.hpp"

namespace onset::tests {

std::vector<int> StepScene::points() const {
  std::vector<int> ids;
  for (int v = 0; v < int(x_t0.rows()); ++v)
    if (!(edges.array() == v).any()) ids.push_back(v);
  return ids;
}

double Asked::separation(PairKind kind, const std::array<int, 4>& v) const {
  const int first = scenes::first_body(kind);
  if (keeps) return keeps(kind, v);
  if (thickness.empty()) return options.min_separation;
  return options.min_separation + thickest(thickness, v, 0, first) + thickest(thickness, v, first, 4);
}

// By a vertex on each side that are at one place at both ends.
bool Asked::is_welded(PairKind kind, const std::array<int, 4>& v) const {
  for (int i = 0; i < scenes::first_body(kind); ++i)
    for (int j = scenes::first_body(kind); j < 4; ++j) {
      const int p = v[std::size_t(i)], q = v[std::size_t(j)];
      if (x_t0.row(p) == x_t0.row(q) && x_t1.row(p) == x_t1.row(q)) return true;
    }
  return false;
}

SceneTruth::SceneTruth(const Asked& asked) {
  asked.for_pairs([&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    const scenes::Query motion = query_of(kind, v, asked.x_t0, asked.x_t1);
    const double d = asked.separation(kind, v);
    if (oracle::boxes_apart(motion, d) || (d == 0 && oracle::surely_apart(motion))) return;
    const oracle::Truth within = oracle::exact_within(motion, d, asked.options.norm);
    if (!within.collides) return;
    const bool touching = within.toi_hi == 0 && oracle::compare_distance(motion, 0, 0) == 0;
    contacts.push_back({{kind, a, b}, v, motion, d, within, touching});
  });
}

static void take_earlier(oracle::Truth& first, const oracle::Truth& t) {
  first.collides = true;
  first.toi_lo = std::min(first.toi_lo, t.toi_lo), first.toi_hi = std::min(first.toi_hi, t.toi_hi);
}

oracle::Truth SceneTruth::first_met() const {
  oracle::Truth first;
  for (const PairTruth& pair : contacts)
    if (pair.touching || !pair.initial()) take_earlier(first, pair.within);
  return first;
}

oracle::Truth SceneTruth::first() const {
  oracle::Truth first;
  for (const PairTruth& pair : contacts) take_earlier(first, pair.within);
  return first;
}

const PairTruth* SceneTruth::touching() const {
  for (const PairTruth& pair : contacts)
    if (pair.touching) return &pair;
  return nullptr;
}

}  // namespace onset::tests
