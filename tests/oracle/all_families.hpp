// Every family of queries, of both kinds, from seeds of its own.
#pragma once

#include "tests/catch.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/scenes/families.hpp"

namespace onset::oracle {

// f(family, query, random) for `count` queries of each.
template <class F>
void for_all_families(int count, std::uint64_t seed, F&& f) {
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = scenes::seeded(family, kind, fuzz_seed() + seed);
      for (int i = 0; i < count; ++i) {
        const scenes::Query query = family.make(kind, random);
        INFO(family.name << " " << to_text(query));
        f(family, query, random);
      }
    }
}

}  // namespace onset::oracle
