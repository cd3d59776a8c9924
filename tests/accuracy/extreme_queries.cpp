// Writes queries of every family with their exact truth, for any program to be asked.
//
//   onset_extreme_queries FOLDER [COUNT] [SEED]
//
// FOLDER/<family>: COUNT queries of each kind (query_folder.hpp).
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "tests/accuracy/query_folder.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;

namespace {

void write_family(const std::string& folder, const scenes::Family& family, PairKind kind, int count,
                  std::uint64_t seed) {
  accuracy::QueryFolder to(folder + "/" + family.name, kind);
  scenes::Random random = scenes::seeded(family, kind, seed);
  for (int i = 0; i < count; ++i) to.add(family.make(kind, random));
  to.close();
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2 || argc > 4) throw std::runtime_error("usage: onset_extreme_queries FOLDER [COUNT] [SEED]");
  const int count = argc > 2 ? std::atoi(argv[2]) : 50;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
      write_family(argv[1], family, kind, count, seed);
} catch (const std::exception& e) {
  std::fprintf(stderr, "onset_extreme_queries: %s\n", e.what());
  return 1;
}
