// What the library promises about a single query, checked against the exact truth.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/oracle/oracle.hpp"
#include "tests/scenes/families.hpp"

namespace onset::oracle {

// A contact that is known to exist, no later than `latest`.
struct Known {
  bool contact = false;
  double latest = INFINITY;
};
inline Known known(const Truth& truth) { return {truth.collides, truth.toi_lo}; }

// Empty, or the promise that `result` breaks: no miss, never late. For finite positions.
std::string broken_promise(const scenes::Query& query, const Options& options, const QueryResult& result,
                           const Known& truth);

// A step of zero although the pair starts apart by more than rounding can hide.
bool silent_zero(const scenes::Query& query, const Options& options, const QueryResult& result);

// Empty, or what `result` says about itself and is not so: outcome, tolerance (up to rounding).
std::string wrong_report(const scenes::Query& query, const Options& options, const QueryResult& result);

// Whether the pair is farther apart at toi than result.tolerance beyond the separation, by more than
// rounding.
bool tolerance_understated(const scenes::Query& query, const Options& options, const QueryResult& result);

// As one line: options and result.
std::string to_text(const Options& options, const QueryResult& result);

// ONSET_FUZZ in the environment multiplies the number of random queries; ONSET_SEED changes them.
inline int fuzz(int count) {
  const char* factor = std::getenv("ONSET_FUZZ");
  return factor ? std::max(1, int(count * std::atof(factor))) : count;
}
inline std::uint64_t fuzz_seed() {
  const char* seed = std::getenv("ONSET_SEED");
  return seed ? std::strtoull(seed, nullptr, 10) : 1;
}

}  // namespace onset::oracle
