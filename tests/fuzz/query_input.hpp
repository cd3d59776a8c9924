// A single query with options, from bytes, from the families or changed at random, and what must hold of its
// answer.
#pragma once

#include <string>

#include "tests/fuzz/bytes.hpp"
#include "tests/queries/query.hpp"
#include "tests/scenes/random.hpp"

namespace onset::fuzz {

struct QueryInput {
  scenes::Query query;
  Options options;
};

void describe(Bytes& bytes, QueryInput& input);

// Every option that a single query heeds, in its range; a separation in one of eight, sized for the query.
Options random_query_options(const scenes::Query& query, scenes::Random& random);
// One to three of: coordinates made equal to others, moved by a few units in the last place, zero, negated,
// any bits; a point that stays or jumps; all scaled by a power of two.
void change(scenes::Query& query, scenes::Random& random);

enum class Broken : std::uint8_t {
  none,
  missed,       // a pair that touches is called free
  late,         // toi beyond the exact first contact, or outside [0, 1]
  toi_hi,       // toi_hi before it
  false_hit,    // not a contact, though Exactness::exact was asked for, or it is called certain
  not_exact,    // Exactness::exact, but toi and toi_hi are not the doubles around the contact
  silent_zero,  // toi 0 from a start that is apart
  outcome,      // not finite or out of range, and not called so; or the other way round
  report,       // what the result says about itself is not so
  oracle,       // the integers and the rational oracle do not agree
};
constexpr int kBrokenKinds = 10;
const char* name(Broken broken);

// The answer against the integers of narrowphase/exact: a few microseconds.
Broken check_quickly(const QueryInput& input);
// That, the integers against the rational oracle, the distance within which the pair ever comes against the
// separation, and what the result says about itself: a millisecond or two. `why` tells of reports.
Broken check_fully(const QueryInput& input, std::string& why);

std::string to_text(const QueryInput& input);

}  // namespace onset::fuzz
