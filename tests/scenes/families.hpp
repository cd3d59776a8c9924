// Seeded families of extreme queries, one for each way in which continuous collision detection is known to
// fail.
#pragma once

#include <string>
#include <vector>

#include "tests/queries/query.hpp"
#include "tests/scenes/random.hpp"

namespace onset::scenes {

enum class Expect { unknown, contact, free };  // what holds by construction, in exact arithmetic

struct Family {
  const char* name;
  Query (*make)(PairKind, Random&);
  Expect expect = Expect::unknown;
};

const std::vector<Family>& families();

// The generator of one family, one kind: the i-th query of a seed does not depend on other families.
Random seeded(const Family& family, PairKind kind, std::uint64_t seed);

// 24 hexadecimal floating-point numbers that reproduce the query.
std::string to_text(const Query& query);

// The parts families() is made of, one file each.
std::vector<Family> scale_families();
std::vector<Family> degenerate_families();
std::vector<Family> touching_families();
std::vector<Family> gap_families();

}  // namespace onset::scenes
