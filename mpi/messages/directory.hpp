// Which rank keeps the books of an id: ids are cut into one range a rank.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "mpi/messages/communicator.hpp"

namespace onset::mpi {

class Directory {
 public:
  Directory(const Communicator& comm, std::int64_t ids)
      : chunk_(std::max<std::int64_t>(1, (ids + comm.size() - 1) / comm.size())),
        first_(std::min(ids, chunk_ * comm.rank())),
        last_(std::min(ids, first_ + chunk_)) {}

  std::size_t rank_of(std::int64_t id) const { return std::size_t(id / chunk_); }
  // The range that is kept here.
  std::int64_t first() const { return first_; }
  std::int64_t last() const { return last_; }
  std::size_t size() const { return std::size_t(last_ - first_); }
  std::size_t place(std::int64_t id) const { return std::size_t(id - first_); }

 private:
  std::int64_t chunk_, first_, last_;
};

}  // namespace onset::mpi
