// Whether and when two closed primitives that move linearly touch: exact for the stored doubles at separation
// 0, in every degenerate case (docs/theory.md, §15).
#pragma once

#include <optional>

#include "narrowphase/exact/pair.hpp"
#include "narrowphase/exact/root.hpp"

namespace onset {

// Coordinates are finite, of any magnitude. An answer takes a microsecond or two; tens of them where f has a
// double root, primitives are degenerate at the contact, or magnitudes differ by more than 2^100.

// Tells whether they touch at a time in [from, 1], from in [0, 1].
bool exactly_touches(const ExactPair& pair, double from = 0);

// Finds the first time in [0, 1] at which they touch, between adjacent doubles.
std::optional<DoubleBracket> exact_first_contact(const ExactPair& pair);

// Tells whether they touch in [0, 1], and an interval that holds the first time. quick: `unknown` rather than
// more than a few microseconds.
enum class Effort { quick, complete };
struct ExactAnswer {
  Answer answer;
  DoubleBracket time;  // where the answer is yes
};
ExactAnswer exact_answer(const ExactPair& pair, Effort effort);

}  // namespace onset
