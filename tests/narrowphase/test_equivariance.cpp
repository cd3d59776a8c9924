// Bit for bit the same answer in other units, at another place, with axes exchanged or mirrored.
#include <cstring>
#include <string>

#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/kernel/kernels.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/narrowphase/symmetries.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

bool same_bits(double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; }

// `unit`: the other query's unit of length.
bool same(const QueryResult& a, const QueryResult& b, double unit = 1) {
  return a.outcome == b.outcome && same_bits(a.toi, b.toi) && same_bits(a.tolerance * unit, b.tolerance) &&
         a.checks == b.checks;
}

std::string to_text(const QueryResult& r) {
  char text[200];
  std::snprintf(text, sizeof text, "%s toi %a tolerance %a checks %lld", to_string(r.outcome), r.toi,
                r.tolerance, (long long)r.checks);
  return text;
}

// The ways in which a caller may ask, for a pair of this size.
std::vector<Options> ways_to_ask(double size, Random& random) {
  std::vector<Options> all(6);
  all[1].tolerance = std::max(std::ldexp(size, -scenes::integer(random, 4, 45)), 0x1p-1074);
  all[2].min_separation = size * scenes::uniform(random, 0, 0.5);
  all[3].min_separation = size * scenes::power_of_ten(random, -6, -1);
  all[3].norm = Norm::maximum;
  all[4].narrow_phase = NarrowPhaseMethod::inclusion;
  all[4].max_checks = 200;
  all[5].max_checks = scenes::integer(random, 1, 3);
  for (Options& o : all) o.max_checks = std::min<std::int64_t>(o.max_checks, 2000);
  return all;
}

bool in_range(const Query& query) {
  const double size = extent(query);
  return std::isfinite(size) && size > 0;
}

void expect_same(const std::string& source, const Query& a, const Query& b, const Options& oa,
                 const Options& ob, double unit = 1) {
  for (InstructionSet kernel : kernels()) {
    Options first = oa, second = ob;
    first.instruction_set = second.instruction_set = kernel;
    const QueryResult x = ccd(a, first), y = ccd(b, second);
    if (!same(x, y, unit))
      FAIL_CHECK(source << " on " << to_string(kernel) << "\n  " << to_text(a) << "\n  " << to_text(b)
                        << "\n  d " << oa.min_separation << " norm " << int(oa.norm) << " method "
                        << int(oa.narrow_phase) << " max_checks " << oa.max_checks << "\n  " << to_text(x)
                        << "\n  " << to_text(y));
  }
}

}  // namespace

TEST_CASE("permuted and mirrored axes give the same bits", "[property][equivariance]") {
  const auto permutations = signed_permutations();
  for_each_query(all_sources(), fuzz(6), 1,
                 [&](const std::string& source, const Query& query, Random& random) {
                   if (!in_range(query)) return;
                   for (const Options& o : ways_to_ask(extent(query), random))
                     for (int i = 0; i < 8; ++i) {
                       const auto& p = permutations[std::size_t(scenes::integer(random, 1, 47))];
                       expect_same(source, query, mapped(query, p), o, o);
                     }
                 });
}

TEST_CASE("all 48 signed permutations of tied configurations give the same bits",
          "[property][equivariance]") {
  const auto permutations = signed_permutations();
  for_each_query(
      tied_sources(), fuzz(40), 2, [&](const std::string& source, const Query& query, Random& random) {
        if (!in_range(query)) return;
        const Options o = ways_to_ask(extent(query), random)[std::size_t(scenes::integer(random, 0, 5))];
        for (const auto& p : permutations) expect_same(source, query, mapped(query, p), o, o);
      });
}

TEST_CASE("scaling by a power of two scales the tolerance and nothing else", "[property][equivariance]") {
  int tried = 0;
  for_each_query(all_sources(), fuzz(6), 3,
                 [&](const std::string& source, const Query& query, Random& random) {
                   if (!in_range(query)) return;
                   for (const Options& o : ways_to_ask(extent(query), random))
                     for (int exponent :
                          {-300, 300, scenes::integer(random, -300, 300), scenes::integer(random, -40, 40)}) {
                       const double unit = std::ldexp(1.0, exponent),
                                    tolerance = o.tolerance.value_or(extent(query) * 1e-6);
                       if (!scales_exactly(query, exponent) || !scales_exactly(o.min_separation, exponent) ||
                           !scales_exactly(tolerance, exponent) || extent(query) * unit < 0x1p-900 ||
                           extent(query) < 0x1p-900 || extent(query) * unit > 0x1p1000)
                         continue;
                       Options there = o;
                       there.min_separation *= unit;
                       if (o.tolerance) there.tolerance = tolerance * unit;
                       expect_same(source, query, scaled(query, unit), o, there, unit);
                       ++tried;
                     }
                 });
  CHECK(tried > fuzz(1000));
}

TEST_CASE("a translation that is exact changes nothing", "[property][equivariance]") {
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(4);
    for (int i = 0; i < fuzz(300); ++i) {
      Query query = scenes::grid_query(kind, random, scenes::integer(random, 1, 20));
      if (scenes::coin(random)) query.t1 = query.t0;
      if (scenes::coin(random)) query.t1[0] = scenes::plus(query.t0[0], scenes::grid_point(random, 4));
      if (!in_range(query)) continue;
      const Point offset = scenes::grid_point(random, scenes::integer(random, 1, 45));
      for (const Options& o : ways_to_ask(extent(query), random))
        expect_same("grid", query, moved(query, offset), o, o);
    }
  }
}

// Columns x and y = x + 1, but for one point, 2^53 and 2^53 + 2: its difference to the first point, 0 and 1,
// rounds to 2^53 in both, and so do the widths; yet they are no tie, other differences are not equal. The
// third axis is the widest, so that the order of these two decides the order of sums.
TEST_CASE("columns whose rounded differences tie are told apart", "[property][equivariance]") {
  const auto permutations = signed_permutations();
  const double far = 0x1p53;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    Random random(5);
    for (int i = 0; i < fuzz(100); ++i) {
      Query query = scenes::mixed_query(kind, random);
      for (auto* points : {&query.t0, &query.t1})
        for (Point& p : *points) p = {0, 1, 0x1p56 * p[2]};
      for (auto* points : {&query.t0, &query.t1})
        for (int j = points == &query.t0; j < 4; ++j) {
          Point& p = (*points)[std::size_t(j)];
          p[0] = std::floor(scenes::uniform(random, 1, far / 2)), p[1] = p[0] + 1;
        }
      Point& other = (scenes::coin(random) ? query.t0 : query.t1)[std::size_t(scenes::integer(random, 1, 3))];
      other[0] = far, other[1] = far + 2;
      Options o;
      o.max_checks = 1000;
      for (const auto& p : permutations) expect_same("rounded tie", query, mapped(query, p), o, o);
    }
  }
}
