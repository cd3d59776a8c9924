// Writes the same motions at every scale and offset with their exact truth, for any program to be asked.
//
//   onset_stability_queries FOLDER [COUNT] [SEED]
//
// FOLDER/scale/<1e-12, 1e-10 .. 1e12>, FOLDER/offset/<0, 1e0, 1e2 .. 1e12>: COUNT queries of each kind
// (query_folder.hpp), of unit size before they are scaled, or moved by (s, s, s). Coordinates are rounded to
// doubles, and the truth is that of the rounded ones: at a large offset it is another question than at none,
// and as exact.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "tests/accuracy/query_folder.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;

namespace {

// Contacts, near ones and far ones; of six pairs one touches at the start and one at the end.
scenes::Query unit_query(PairKind kind, scenes::Random& random, int index) {
  scenes::Query query = scenes::mixed_query(kind, random);
  if (index % 6 == 2) scenes::aim(query, 0, 0.25, 0.5);
  if (index % 6 == 5) scenes::aim(query, 1, 0.25, 0.5);
  return query;
}

template <class Change>
void write(const std::string& folder, int count, std::uint64_t seed, Change&& change) {
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    accuracy::QueryFolder to(folder, kind);
    scenes::Random random(seed);
    for (int i = 0; i < count; ++i) to.add(change(unit_query(kind, random, i)));
    to.close();
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2 || argc > 4) throw std::runtime_error("usage: onset_stability_queries FOLDER [COUNT] [SEED]");
  const std::string folder = argv[1];
  const int count = argc > 2 ? std::atoi(argv[2]) : 50;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  for (int exponent = -12; exponent <= 12; exponent += 2) {
    const double s = std::pow(10.0, exponent);
    const std::string value = "1e" + std::to_string(exponent);
    write(folder + "/scale/" + value, count, seed, [s](const auto& q) { return scenes::scaled(q, s); });
    if (exponent >= 0)
      write(folder + "/offset/" + value, count, seed, [s](const auto& q) { return moved(q, {s, s, s}); });
  }
  write(folder + "/offset/0", count, seed, [](const auto& q) { return q; });
} catch (const std::exception& e) {
  std::fprintf(stderr, "onset_stability_queries: %s\n", e.what());
  return 1;
}
