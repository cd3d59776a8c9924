// What single precision culls is apart: no contact, and never closer than the separation.
#include "base/instruction_set.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/kernel/kernel_batch.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/narrowphase/separation.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

// From positions in double or in single precision.
static bool culled(const Query& query, double separation, Norm norm) {
  KernelBatch batch(query.kind);
  batch.add(query, separation);
  const auto is_culled = [&] {
    int survivor;
    return scalar_kernels().of_kind[int(query.kind)].cull(batch.pairs(1e-6, norm == Norm::maximum),
                                                          &survivor) == 0;
  };
  if (is_culled()) return true;
  batch.round();
  return is_culled();
}

TEST_CASE("no culled pair touches", "[property][oracle]") {
  int total = 0, gone = 0;
  for_each_query(all_sources(), fuzz(40), 95, [&](const std::string& source, const Query& query, Random&) {
    ++total;
    if (!culled(query, 0, Norm::euclidean)) return;
    ++gone;
    if (oracle::exact_ccd(query).collides) FAIL_CHECK(source << "\n  " << to_text(query));
  });
  CAPTURE(total, gone);
  CHECK(gone > total / 10);
}

// Separations just above and just below the least distance: the cull has to be right by a hair.
TEST_CASE("no culled pair comes closer than its separation", "[property][oracle]") {
  int gone = 0;
  for_each_query(all_sources(), fuzz(15), 96,
                 [&](const std::string& source, const Query& query, Random& random) {
                   const double size = extent(query);
                   if (!(size > 0x1p-900 && size < 0x1p900)) return;
                   for (Norm norm : {Norm::euclidean, Norm::maximum}) {
                     const double closest = rough_distance(query, rough_closest_time(query, norm), norm);
                     const double hair = scenes::power_of_ten(random, -6, 0);
                     const double d = closest * (scenes::integer(random, 0, 4) ? 1 - hair : 1 + hair);
                     if (!(d > 0) || !culled(query, d, norm)) continue;
                     ++gone;
                     if (known_within(query, d, norm).contact)
                       FAIL_CHECK(source << " norm " << int(norm) << "\n  " << to_text(query));
                   }
                 });
  CHECK(gone > fuzz(100));
}
