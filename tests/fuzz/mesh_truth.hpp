// What must hold of every call on a small mesh: the same bytes by any method, and exact truth over all pairs.
#pragma once

#include <string>

#include "tests/fuzz/mesh_input.hpp"

namespace onset::fuzz {

// All functions: empty, or what is broken.

// Brute force, tree and hash, scalar and AVX2, one thread and two: the bytes of every call.
std::string broken_by_methods(const MeshInput& input);

// Separation 0 by the integers: candidates, active set, step, yes or no, close pairs and check() over all
// pairs that the rules let meet; the step against the set.
std::string broken_by_integers(const MeshInput& input);

// Rational arithmetic, ten times slower: steps of every call, what they say, what storing them does, the
// shares of gaps; separations and norms; intersections; close pairs.
std::string broken_by_rationals(const MeshInput& input);

// Calls whose budgets are spent, or that are cancelled.
std::string broken_by_budgets(const MeshInput& input, std::int64_t check_limit, std::int64_t memory_limit,
                              int cancel_after);

// What calls answer where a position is not finite, or out of range.
std::string broken_by_bad_positions(const MeshInput& input);

}  // namespace onset::fuzz
