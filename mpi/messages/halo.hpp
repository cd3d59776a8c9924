// The vertices that a rank needs of others for its own elements, in every call.
#pragma once

#include <vector>

#include "mpi/messages/communicator.hpp"

namespace onset::mpi {

// Slots [0, owned) are this rank's own vertices, the others those of elements that it owns.
class Halo {
 public:
  Halo() = default;
  // (c) owned_ids: of slots [0, owned). wanted: ids of vertices of other ranks, each once, in the order of
  // their slots; owners: theirs.
  Halo(const Communicator& comm, const std::vector<int>& owned_ids, const std::vector<int>& wanted,
       const std::vector<int>& owners);

  // (c) Puts the owner's value into each slot of the halo; `values` has one a slot, or `stride` of them.
  template <class T>
  void fill(const Communicator& comm, T* values, std::size_t stride = 1) const {
    PerRank<T> out;
    comm.agreed([&] {
      out.resize(sent_.size());
      for (std::size_t r = 0; r < sent_.size(); ++r)
        for (const int slot : sent_[r])
          out[r].insert(out[r].end(), values + std::size_t(slot) * stride,
                        values + (std::size_t(slot) + 1) * stride);
    });
    const PerRank<T> in = comm.exchange(out);
    for (std::size_t r = 0; r < in.size(); ++r)
      for (std::size_t i = 0; i < received_[r].size(); ++i)
        std::copy_n(in[r].data() + i * stride, stride, values + std::size_t(received_[r][i]) * stride);
  }

 private:
  PerRank<int> sent_, received_;  // slots, by the other rank
};

}  // namespace onset::mpi
