// Messages between ranks, and agreement: local work that fails never leaves the others waiting.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace onset::mpi {

// What went wrong on a rank. Plain data, so that telling the others allocates nothing.
struct Failure {
  enum Kind : int { none, invalid_argument, logic_error, out_of_memory, other };
  int kind = none;
  char text[500] = {};
};

// By rank.
template <class T>
using PerRank = std::vector<std::vector<T>>;

// A duplicate of a communicator, on which one thread makes one call at a time. Functions marked (c) are
// collective: every rank calls them, in the same order.
class Communicator {
 public:
  Communicator() = default;       // of nobody: only to be assigned by `duplicate`
  void duplicate(MPI_Comm comm);  // (c)
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  // Runs work() and then agrees (c): where it threw on any rank, all ranks throw what the lowest of these
  // did, as std::invalid_argument, std::logic_error, std::bad_alloc or std::runtime_error, with its rank.
  template <class Work>
  void agreed(Work&& work) const {
    Failure failure;
    try {
      std::forward<Work>(work)();
    } catch (...) {
      failure = describe(std::current_exception());
    }
    agree(failure);
  }
  struct Named {
    const char* name;
    std::uint64_t value;
  };
  static constexpr std::size_t kMostNamed = 16;
  // (c) Throws std::invalid_argument on all ranks unless all have the same values, naming the first that
  // differs. One message; nothing is allocated.
  void require_same(std::initializer_list<Named> values) const;

  // (c) In place.
  void sum(std::int64_t* values, int count) const;
  void minimum(std::int64_t* values, int count) const;
  void maximum(std::int64_t* values, int count) const;
  void minimum(double* values, int count) const;
  void maximum(double* values, int count) const;
  // (c) Returns the sum of the values of all lower ranks.
  std::int64_t sum_before(std::int64_t value) const;
  // (c) Reduces rows of plain data by add(into, from), which must not depend on the order.
  template <class T>
  void reduce(T& value, void (*add)(T& into, const T& from)) const;

  // (c) Sends out[r] to each rank r, and returns what each rank sent here. Does not throw but by agreement.
  template <class T>
  PerRank<T> exchange(const PerRank<T>& out) const;
  // (c) Returns all rows of all ranks, in the order of ranks.
  template <class T>
  std::vector<T> gather(const std::vector<T>& mine) const;

  // Bytes and messages sent to other ranks by `exchange` and `gather` since the last reset.
  struct Traffic {
    std::int64_t bytes = 0, messages = 0;
  };
  Traffic traffic() const { return traffic_; }
  void reset_traffic() const { traffic_ = {}; }

 private:
  struct Bytes {
    const void* out;
    void* in;
    std::int64_t out_count, in_count;
  };
  static Failure describe(const std::exception_ptr& error) noexcept;
  void agree(const Failure& failure) const;
  void swap_counts(const std::int64_t* out, std::int64_t* in) const;
  void swap_bytes(const std::vector<Bytes>& bytes, std::vector<MPI_Request>& requests) const;
  static std::size_t requests_for(const std::vector<Bytes>& bytes);

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  mutable Traffic traffic_;
};

template <class T>
PerRank<T> Communicator::exchange(const PerRank<T>& out) const {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t ranks = std::size_t(size_);
  std::vector<std::int64_t> counts, arriving;
  agreed([&] {
    counts.resize(ranks), arriving.resize(ranks);
    for (std::size_t r = 0; r < ranks; ++r) counts[r] = std::int64_t(out[r].size());
  });
  swap_counts(counts.data(), arriving.data());
  PerRank<T> in;
  std::vector<Bytes> bytes;
  std::vector<MPI_Request> requests;
  agreed([&] {
    in.resize(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
      in[r].resize(std::size_t(arriving[r]));
      const std::int64_t size = std::int64_t(sizeof(T));
      bytes.push_back({out[r].data(), in[r].data(), counts[r] * size, arriving[r] * size});
    }
    requests.reserve(requests_for(bytes));
  });
  swap_bytes(bytes, requests);
  return in;
}

template <class T>
std::vector<T> Communicator::gather(const std::vector<T>& mine) const {
  PerRank<T> out;
  agreed([&] { out.assign(std::size_t(size_), mine); });
  const PerRank<T> in = exchange(out);
  std::vector<T> all;
  agreed([&] {
    for (const std::vector<T>& of_rank : in) all.insert(all.end(), of_rank.begin(), of_rank.end());
  });
  return all;
}

template <class T>
void Communicator::reduce(T& value, void (*add)(T& into, const T& from)) const {
  static_assert(std::is_trivially_copyable_v<T>);
  // Along a binary tree to rank 0, and back.
  for (int bit = 1; bit < size_; bit *= 2) {
    if ((rank_ & bit) != 0) {
      MPI_Send(&value, int(sizeof(T)), MPI_BYTE, rank_ - bit, 1, comm_);
      break;
    }
    if (rank_ + bit >= size_) continue;
    T from = value;
    MPI_Recv(&from, int(sizeof(T)), MPI_BYTE, rank_ + bit, 1, comm_, MPI_STATUS_IGNORE);
    add(value, from);
  }
  MPI_Bcast(&value, int(sizeof(T)), MPI_BYTE, 0, comm_);
}

}  // namespace onset::mpi
