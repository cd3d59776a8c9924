// The calls on a mesh that is spread over ranks: the answers are those of one process, byte for byte.
#pragma once

#include <array>
#include <onset/active_set.hpp>
#include <onset/close_pairs.hpp>
#include <onset/export.hpp>
#include <onset/intersections.hpp>
#include <onset/mpi/mesh.hpp>
#include <onset/options.hpp>
#include <onset/step_size.hpp>
#include <vector>

namespace onset::mpi {

// All of these are collective (onset/mpi/mesh.hpp), and take this rank's rows of positions: Mesh::rows() of
// them, or the Mesh::owned() first ones, which alone are read. Ids in results are those of the scene.
//
// Options are the same on all ranks, but for time_limit, memory_limit, progress and threads, which are a
// rank's own. Where one rank's end its part early, all ranks answer with the outcome of the lowest rank that
// did; the others finish their part first. Options::check_limit is refused: checks are not counted over
// ranks.
//
// Guarantee: for any number of ranks and any partition the answer is that of the call of the same name in
// onset::, byte for byte, statistics, seconds, and what a spent budget cuts off excepted
// (docs/distributed.md has the proof).

// The same result on all ranks.
ONSET_API StepResult compute_collision_free_stepsize(const Mesh& mesh, const Positions& x_t0,
                                                     const Positions& x_t1, const Options& options = {});

// The same on all ranks.
ONSET_API bool is_step_collision_free(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                      const Options& options = {});

// Each contact of the scene is in the set of exactly one rank, of one that owns a primitive of it. Outcome,
// vertex and complete_until are the same on all ranks.
struct ActiveSet : onset::ActiveSet {
  // The rank that owns each of Contact::vertices; -1 where there is none. One row a contact.
  std::vector<std::array<int, 4>> owners;
};
ONSET_API ActiveSet construct_active_set(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                         const Options& options = {});

// As an active set: each pair on exactly one rank.
struct ClosePairs : onset::ClosePairs {
  std::vector<std::array<int, 4>> owners;
};
ONSET_API ClosePairs close_pairs(const Mesh& mesh, const Positions& x, double d_hat,
                                 const Options& options = {});

// Each intersection, and each vertex behind a plane, on exactly one rank.
ONSET_API Intersections intersections(const Mesh& mesh, const Positions& x, const Options& options = {});
// The same on all ranks.
ONSET_API bool has_intersections(const Mesh& mesh, const Positions& x, const Options& options = {});

}  // namespace onset::mpi
