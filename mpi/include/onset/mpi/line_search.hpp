// A line search on a mesh that is spread over ranks: ghosts are sent once.
#pragma once

#include <memory>
#include <onset/export.hpp>
#include <onset/line_search.hpp>
#include <onset/mpi/calls.hpp>

namespace onset::mpi {

// As onset::LineSearch, with the guarantee of onset/mpi/calls.hpp. The mesh must outlive it. All of its
// functions are collective, the destructor excepted; between the constructor and them nothing but a few
// numbers is exchanged.
class ONSET_API LineSearch {
 public:
  LineSearch(const Mesh& mesh, const Positions& x_t0, const Positions& dx,
             const LineSearchOptions& options = {});
  ~LineSearch();
  LineSearch(LineSearch&&) noexcept;
  LineSearch& operator=(LineSearch&&) noexcept;

  // The same result on all ranks.
  LineSearchStep largest_step(double upper = 1) const;
  // Each pair on exactly one rank.
  ClosePairs close_pairs(double step) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onset::mpi
