// The whole library once more, compiled with -mavx2 -mfma -ffp-contract=fast: other bits, the same promises.
// No proof relies on what a compiler fuses.
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/check_promises.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/queries/query_file.hpp"
#include "tests/scenes/data.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

bool can_run() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

}  // namespace

TEST_CASE("contracted code keeps every promise", "[property][oracle]") {
  if (!can_run()) return;
  for_each_query(all_sources(), fuzz(12), 98,
                 [&](const std::string& source, const Query& query, Random& random) {
                   if (!(extent(query) < 0x1p900)) return;
                   Options o;
                   o.relative_tolerance = scenes::power_of_ten(random, -14, -2);
                   if (scenes::coin(random)) o.max_checks = scenes::integer(random, 1, 10);
                   check_promises(source, query, o);
                   o.narrow_phase = NarrowPhaseMethod::inclusion;
                   o.max_checks = 1000;
                   check_promises(source, query, o);
                 });
}

TEST_CASE("contracted code keeps minimum separations", "[property][oracle]") {
  if (!can_run()) return;
  for_each_query(all_sources(), fuzz(2), 99,
                 [&](const std::string& source, const Query& query, Random& random) {
                   const double size = extent(query);
                   if (!(size > 0x1p-900 && size < 0x1p900)) return;
                   Options o;
                   o.min_separation = size * scenes::power_of_ten(random, -12, 0);
                   check_promises(source, query, o);
                 });
}

TEST_CASE("contracted code answers the hand-made queries as they are labelled", "[oracle][data]") {
  const std::string folder =
      scenes::data_folder("contracted code answers the hand-made queries as they are labelled");
  if (folder.empty() || !can_run()) return;
  int missed = 0, extra = 0, free = 0;
  Options o;
  o.relative_tolerance = 1e-12;
  for (const scenes::QueryFile& file : scenes::query_files(folder))
    for (const scenes::LabelledQuery& labelled : scenes::read_queries(file.path, file.kind)) {
      const bool reported = ccd(labelled.query, o).collides();
      missed += labelled.collides && !reported;
      extra += !labelled.collides && reported;
      free += !labelled.collides && !reported;
    }
  CAPTURE(extra, free);
  CHECK(missed == 0);
  CHECK(free > fuzz(1000));
}
