// The copies of the kernel text for AVX2 and AVX-512 give the bytes of the scalar one.
#include <cstring>
#include <numeric>

#include "base/instruction_set.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/kernel/kernel_batch.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

constexpr int kMostLanes = 16;  // of any pack

bool same(double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; }

bool same(const KernelResult& a, const KernelResult& b) {
  return same(a.t, b.t) && same(a.distance, b.distance) && same(a.delta, b.delta) &&
         same(a.separation, b.separation) && same(a.unit, b.unit) && a.checks == b.checks &&
         a.verdict == b.verdict;
}

std::vector<int> culled(const KernelTable& table, PairKind kind, const KernelPairs& pairs) {
  std::vector<int> survivors(std::size_t(pairs.count) + 1);
  survivors.resize(std::size_t(table.of_kind[int(kind)].cull(pairs, survivors.data())));
  return survivors;
}

std::vector<KernelResult> advanced(const KernelTable& table, PairKind kind, const KernelPairs& pairs,
                                   const std::vector<int>& subset, const KernelResume* resume = nullptr) {
  std::vector<KernelResult> results(subset.size());
  table.of_kind[int(kind)].advance(pairs, subset.data(), int(subset.size()), resume, results.data());
  return results;
}

void expect_same(const std::vector<KernelResult>& a, const std::vector<KernelResult>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same(a[i], b[i]))
      FAIL_CHECK("pair " << i << " of " << a.size() << ": t " << a[i].t << " " << b[i].t << " verdict "
                         << int(a[i].verdict) << " " << int(b[i].verdict) << " checks " << a[i].checks << " "
                         << b[i].checks);
}

// Resumes every pair where it stopped, in or beyond the middle of what it still may take.
std::vector<KernelResume> resumed(const std::vector<KernelResult>& results) {
  std::vector<KernelResume> resume;
  for (const KernelResult& r : results) {
    KernelResume next{};
    next.t = r.t < 1 ? r.t : 0.5;
    next.separation = r.separation;
    next.delta = r.delta;
    next.checks = 1;
    next.patience = double(resume.size() % 3) * 20;
    resume.push_back(next);
  }
  return resume;
}

void compare_frames(const KernelTable& other, const KernelBatch& batch, const KernelPairs& pairs,
                    const std::vector<KernelResult>& at) {
  std::vector<double> t;
  for (const KernelResult& r : at) t.push_back(std::min(r.t, 1.0));
  std::vector<KernelContact> a(t.size()), b(t.size());
  scalar_kernels().of_kind[int(batch.kind())].contact_geometry(pairs, t.data(), a.data());
  other.of_kind[int(batch.kind())].contact_geometry(pairs, t.data(), b.data());
  for (std::size_t i = 0; i < t.size(); ++i) {
    bool equal = a[i].ordinary == b[i].ordinary;
    if (a[i].ordinary) {
      equal = equal && same(a[i].gap, b[i].gap) && same(a[i].speed, b[i].speed);
      for (int k = 0; k < 4; ++k) equal = equal && same(a[i].weight[k], b[i].weight[k]);
      for (int k = 0; k < 3; ++k) equal = equal && same(a[i].normal[k], b[i].normal[k]);
    }
    if (!equal) FAIL_CHECK("frames differ");
  }
}

void compare_copies(const KernelTable& other, const KernelBatch& batch, const KernelPairs& pairs) {
  const KernelTable& one = scalar_kernels();
  const std::vector<int> kept = culled(one, batch.kind(), pairs);
  if (kept != culled(other, batch.kind(), pairs)) FAIL_CHECK("the culls differ");
  std::vector<int> all(std::size_t(pairs.count));
  std::iota(all.begin(), all.end(), 0);
  const auto a = advanced(one, batch.kind(), pairs, all);
  expect_same(a, advanced(other, batch.kind(), pairs, all));
  const auto resume = resumed(a);
  expect_same(advanced(one, batch.kind(), pairs, all, resume.data()),
              advanced(other, batch.kind(), pairs, all, resume.data()));
  compare_frames(other, batch, pairs, a);
  for (int row = 0; row < pairs.count; ++row) {
    double v[3], w[3];
    one.of_kind[int(batch.kind())].closest_direction(pairs, row, a[std::size_t(row)].t, v);
    other.of_kind[int(batch.kind())].closest_direction(pairs, row, a[std::size_t(row)].t, w);
    for (int i = 0; i < 3; ++i)
      if (!same(v[i], w[i])) FAIL_CHECK("directions differ");
  }
}

// Batches that mix all sources, as a scene does.
KernelBatch mixed_batch(PairKind kind, int count, Random& random) {
  static const std::vector<Source> sources = all_sources();
  KernelBatch batch(kind);
  for (int i = 0; i < count; ++i) {
    const Query query =
        sources[std::size_t(scenes::integer(random, 0, int(sources.size()) - 1))].make(kind, random);
    const double size = extent(query);
    const bool separated = scenes::coin(random) && size < 0x1p900;
    batch.add(query, separated ? size * scenes::power_of_ten(random, -8, 0.5) : 0);
  }
  return batch;
}

void compare_any_pairs(const KernelTable& table) {
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(61);
    for (int i = 0; i < fuzz(600); ++i) {
      KernelBatch batch = mixed_batch(kind, 200, random);
      if (scenes::coin(random)) batch.round();
      KernelPairs pairs = batch.pairs(scenes::power_of_ten(random, -12, 0), scenes::coin(random),
                                      scenes::integer(random, 0, 2) ? 500 : 3);
      if (scenes::coin(random)) pairs.t_max = pairs.cull_t_max = scenes::unit(random);
      if (scenes::coin(random))
        pairs.gap_share = scenes::unit(random), pairs.storing = scenes::power_of_ten(random, -16, -2),
        pairs.cull_beyond = kStoredRoundings * pairs.storing;
      compare_copies(table, batch, pairs);
    }
  }
}

void compare_small_batches(const KernelTable& table) {
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(62);
    for (int count = 1; count <= 2 * kMostLanes + 1; ++count)
      for (int i = 0; i < fuzz(10); ++i) {
        const KernelBatch batch = mixed_batch(kind, count, random);
        const KernelPairs pairs = batch.pairs(1e-6);
        compare_copies(table, batch, pairs);
        std::vector<int> all(std::size_t(count), 0);
        std::iota(all.begin(), all.end(), 0);
        const auto together = advanced(table, kind, pairs, all);
        const auto kept = culled(table, kind, pairs);
        for (int row = 0; row < count; ++row) {
          expect_same({together[std::size_t(row)]}, advanced(scalar_kernels(), kind, pairs, {row}));
          KernelPairs alone = pairs;
          alone.vertices += row, alone.separation += row, alone.count = 1;
          const bool survives = std::count(kept.begin(), kept.end(), row) > 0;
          CHECK(survives == !culled(scalar_kernels(), kind, alone).empty());
        }
      }
  }
}

// Nothing of a non-finite pair may leak into its neighbours in the lanes.
void spoil_one_lane(const KernelTable& table) {
  constexpr int kPairs = kMostLanes + 1;
  Random random(63);
  const double bad[] = {NAN, INFINITY, -INFINITY, 0x1p1023};
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (int i = 0; i < fuzz(40); ++i) {
      std::vector<Query> queries;
      for (int k = 0; k < kPairs; ++k) queries.push_back(scenes::mixed_query(kind, random));
      const int spoiled = scenes::integer(random, 0, kPairs - 1);
      KernelBatch clean(kind), dirty(kind);
      for (int k = 0; k < kPairs; ++k) {
        clean.add(queries[std::size_t(k)], 0);
        Query q = queries[std::size_t(k)];
        if (k == spoiled)
          q.t1[std::size_t(scenes::integer(random, 0, 3))][1] = bad[scenes::integer(random, 0, 3)];
        dirty.add(q, 0);
      }
      std::vector<int> all(kPairs);
      std::iota(all.begin(), all.end(), 0);
      const auto a = advanced(table, kind, clean.pairs(1e-6), all),
                 b = advanced(table, kind, dirty.pairs(1e-6), all);
      for (int k = 0; k < kPairs; ++k)
        if (k != spoiled) expect_same({a[std::size_t(k)]}, {b[std::size_t(k)]});
    }
}

const KernelTable* avx2() {
#ifdef ONSET_HAVE_AVX2
  if (has_avx2()) return &avx2_kernels();
#endif
  WARN("skipped: no AVX2 here");
  return nullptr;
}
const KernelTable* avx512() {
#ifdef ONSET_HAVE_AVX512
  if (has_avx512()) return &avx512_kernels();
#endif
  WARN("skipped: no AVX-512 here");
  return nullptr;
}

}  // namespace

TEST_CASE("scalar and AVX2 kernels give the same bytes for any pair", "[simd][property]") {
  if (const KernelTable* table = avx2()) compare_any_pairs(*table);
}
TEST_CASE("small batches give the same bytes with AVX2, and the same as one by one", "[simd]") {
  if (const KernelTable* table = avx2()) compare_small_batches(*table);
}
TEST_CASE("a pair with NaN or infinity leaves the others of its batch alone", "[simd]") {
  spoil_one_lane(scalar_kernels());
  if (const KernelTable* table = avx2()) spoil_one_lane(*table);
}

// By a test of their own, which says that it is skipped where the machine has no AVX-512.
TEST_CASE("scalar and AVX-512 kernels give the same bytes for any pair", "[.avx512]") {
  if (const KernelTable* table = avx512()) compare_any_pairs(*table);
}
TEST_CASE("small batches give the same bytes with AVX-512, and the same as one by one", "[.avx512]") {
  if (const KernelTable* table = avx512()) compare_small_batches(*table);
}
TEST_CASE("a pair with NaN or infinity leaves the others of its AVX-512 batch alone", "[.avx512]") {
  if (const KernelTable* table = avx512()) spoil_one_lane(*table);
}
