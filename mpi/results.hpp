// What the parts found, as one result.
#pragma once

#include <initializer_list>
#include <optional>

#include "base/function_ref.hpp"
#include "mpi/exchange/part.hpp"
#include "onset/mpi/calls.hpp"
#include "src/shared/pair_traversal.hpp"

namespace onset::mpi {

// (c) Begins a call: checks that all ranks make the same one with the same options, and forgets the traffic
// of the last one. Throws as the call of one process does, and for Options::check_limit.
// `numbers` have to be the same, too; `check` says what else may be wrong, on this rank alone.
void begin_call(const Mesh::Impl& mesh, const char* name, const Options& options,
                std::initializer_list<double> numbers = {}, FunctionRef<> check = FunctionRef<>([] {}));
// Ends it: notes the traffic, and how many pairs were looked at here.
void end_call(const Mesh::Impl& mesh, std::int64_t pairs);

// (c) Returns the outcome of the lowest rank whose part ended early, or free.
Outcome agreed_outcome(const Communicator& comm, Outcome mine);

// The limits of a part with ids of the scene, and the vertices of each pair.
struct SceneLimits {
  struct Limit {
    bool known;
    FoundPair found;
    std::array<int, 4> vertices;
  };
  Limit contact, stored, clear;
};
// (c) Returns the limits of the scene.
SceneLimits reduce(const Communicator& comm, const Part& part, const Limits& limits);

// Sets a step by them, as limit_step does.
void limit_step(const SceneLimits& limits, double upper, StepResult& result);

// (c) Makes of the statistics of a part those of the scene: sums of counts, the longest times.
void reduce(const Communicator& comm, Stats& stats);

// Gives pairs the ids of the scene, and says whose their vertices are.
template <class Pairs>
std::vector<std::array<int, 4>> rename_all(const Part& part, Pairs& pairs) {
  std::vector<std::array<int, 4>> owners;
  owners.reserve(pairs.size());
  for (auto& pair : pairs) owners.push_back(part.owners_of(pair)), part.rename(pair);
  return owners;
}

}  // namespace onset::mpi
