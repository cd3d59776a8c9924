#include "mpi/messages/communicator.hpp"

#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>

#include "base/assert.hpp"

namespace onset::mpi {
namespace {

// A count of MPI is an int: longer messages go in pieces.
constexpr std::int64_t kLongest = std::int64_t(1) << 30;
constexpr int kTag = 2;

std::size_t pieces(std::int64_t bytes) { return std::size_t((bytes + kLongest - 1) / kLongest); }

[[noreturn]] void raise(const Failure& failure, int rank) {
  const std::string text = "rank " + std::to_string(rank) + ": " + failure.text;
  switch (failure.kind) {
    case Failure::invalid_argument:
      throw std::invalid_argument(text);
    case Failure::logic_error:
      throw std::logic_error(text);
    case Failure::out_of_memory:
      throw std::bad_alloc();
    default:
      throw std::runtime_error(text);
  }
}

void set_text(Failure& failure, Failure::Kind kind, const char* text) noexcept {
  failure.kind = kind;
  std::snprintf(failure.text, sizeof failure.text, "%s", text);
}

}  // namespace

void Communicator::duplicate(MPI_Comm comm) {
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

// Nothing can be freed once MPI has ended.
Communicator::~Communicator() {
  int ended = 0;
  MPI_Finalized(&ended);
  if (!ended && comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
}

Failure Communicator::describe(const std::exception_ptr& error) noexcept {
  Failure failure;
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    set_text(failure, Failure::out_of_memory, "out of memory");
  } catch (const std::invalid_argument& e) {
    set_text(failure, Failure::invalid_argument, e.what());
  } catch (const std::logic_error& e) {
    set_text(failure, Failure::logic_error, e.what());
  } catch (const std::exception& e) {
    set_text(failure, Failure::other, e.what());
  } catch (...) {
    set_text(failure, Failure::other, "an exception that is no std::exception");
  }
  return failure;
}

void Communicator::agree(const Failure& mine) const {
  int first = mine.kind == Failure::none ? size_ : rank_;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm_);
  if (first == size_) return;
  Failure failure = mine;
  MPI_Bcast(&failure, int(sizeof failure), MPI_BYTE, first, comm_);
  raise(failure, first);
}

void Communicator::require_same(std::initializer_list<Named> values) const {
  ONSET_ASSERT(values.size() <= kMostNamed);
  std::uint64_t least[2 * kMostNamed], *next = least;
  for (const Named& of : values) *next++ = of.value, *next++ = ~of.value;
  MPI_Allreduce(MPI_IN_PLACE, least, int(next - least), MPI_UINT64_T, MPI_MIN, comm_);
  next = least;
  for (const Named& of : values) {
    const std::uint64_t smallest = *next++, largest = ~*next++;
    if (smallest != largest) throw std::invalid_argument(std::string(of.name) + " differs from rank to rank");
  }
}

void Communicator::sum(std::int64_t* values, int count) const {
  MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_INT64_T, MPI_SUM, comm_);
}
void Communicator::minimum(std::int64_t* values, int count) const {
  MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_INT64_T, MPI_MIN, comm_);
}
void Communicator::maximum(std::int64_t* values, int count) const {
  MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_INT64_T, MPI_MAX, comm_);
}
void Communicator::minimum(double* values, int count) const {
  MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_MIN, comm_);
}
void Communicator::maximum(double* values, int count) const {
  MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_MAX, comm_);
}

std::int64_t Communicator::sum_before(std::int64_t value) const {
  std::int64_t before = 0;
  MPI_Exscan(&value, &before, 1, MPI_INT64_T, MPI_SUM, comm_);
  return rank_ == 0 ? 0 : before;  // rank 0 is given none
}

void Communicator::swap_counts(const std::int64_t* out, std::int64_t* in) const {
  MPI_Alltoall(out, 1, MPI_INT64_T, in, 1, MPI_INT64_T, comm_);
}

std::size_t Communicator::requests_for(const std::vector<Bytes>& bytes) {
  std::size_t count = 0;
  for (const Bytes& b : bytes) count += pieces(b.out_count) + pieces(b.in_count);
  return count;
}

// Only ranks that have something to say send. `requests` has room for all.
void Communicator::swap_bytes(const std::vector<Bytes>& bytes, std::vector<MPI_Request>& requests) const {
  const auto post = [&](std::int64_t count, const auto& start) {
    for (std::int64_t first = 0; first < count; first += kLongest) {
      requests.emplace_back();
      start(first, int(std::min(kLongest, count - first)), &requests.back());
    }
  };
  for (int r = 0; r < size_; ++r) {
    const Bytes& b = bytes[std::size_t(r)];
    if (r == rank_) continue;
    post(b.in_count, [&](std::int64_t first, int count, MPI_Request* request) {
      MPI_Irecv(static_cast<char*>(b.in) + first, count, MPI_BYTE, r, kTag, comm_, request);
    });
  }
  for (int r = 0; r < size_; ++r) {
    const Bytes& b = bytes[std::size_t(r)];
    if (r == rank_) {
      if (b.out_count > 0) std::memcpy(b.in, b.out, std::size_t(b.out_count));
      continue;
    }
    post(b.out_count, [&](std::int64_t first, int count, MPI_Request* request) {
      MPI_Isend(static_cast<const char*>(b.out) + first, count, MPI_BYTE, r, kTag, comm_, request);
      traffic_.bytes += count, ++traffic_.messages;
    });
  }
  MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

}  // namespace onset::mpi
