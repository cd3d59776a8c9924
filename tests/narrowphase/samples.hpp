// Queries to try a property on: every family, and configurations full of ties, which are where an order or a
// sign may be chosen arbitrarily.
#pragma once

#include <string>
#include <vector>

#include "tests/scenes/families.hpp"

namespace onset::tests {

struct Source {
  std::string name;
  scenes::Query (*make)(PairKind, scenes::Random&);
};

// Small integers, equal columns, equal extents on two or three axes, planar motion, translation along an
// axis.
std::vector<Source> tied_sources();

// The families and the tied sources.
std::vector<Source> all_sources();

scenes::Random seeded(const Source& source, PairKind kind, std::uint64_t seed);

// visit(source name, query) for `count` queries of each source and kind.
template <class F>
void for_each_query(const std::vector<Source>& sources, int count, std::uint64_t seed, F&& visit) {
  for (const Source& source : sources)
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
      scenes::Random random = seeded(source, kind, seed);
      for (int i = 0; i < count; ++i) visit(source.name, source.make(kind, random), random);
    }
}

// The largest difference of corners per axis at either end, as a Euclidean length: the rho of the error
// bounds.
double extent(const scenes::Query& query);

}  // namespace onset::tests
