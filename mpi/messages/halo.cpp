#include "mpi/messages/halo.hpp"

#include <algorithm>
#include <utility>

namespace onset::mpi {

Halo::Halo(const Communicator& comm, const std::vector<int>& owned_ids, const std::vector<int>& wanted,
           const std::vector<int>& owners) {
  PerRank<int> asked;
  comm.agreed([&] {
    asked.resize(std::size_t(comm.size())), received_.resize(asked.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      asked[std::size_t(owners[i])].push_back(wanted[i]);
      received_[std::size_t(owners[i])].push_back(int(owned_ids.size() + i));
    }
  });
  sent_ = comm.exchange(asked);
  comm.agreed([&] {
    std::vector<std::pair<int, int>> slots;
    for (std::size_t i = 0; i < owned_ids.size(); ++i) slots.push_back({owned_ids[i], int(i)});
    std::sort(slots.begin(), slots.end());
    for (std::vector<int>& of_rank : sent_)
      for (int& id : of_rank) id = std::lower_bound(slots.begin(), slots.end(), std::pair(id, 0))->second;
  });
}

}  // namespace onset::mpi
