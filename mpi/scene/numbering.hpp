// Who owns what, and the edges of faces: found by way of directories.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpi/messages/communicator.hpp"

namespace onset::mpi {

// Checks that each id in [0, number of owned ids of all ranks) is owned once, and can then be asked for
// owners.
class VertexOwners {
 public:
  VertexOwners(const Communicator& comm, const std::vector<int>& owned_ids);  // (c)
  std::int64_t count() const { return count_; }
  // (c) Throws std::invalid_argument for an id that there is not.
  std::vector<int> of(const std::vector<int>& ids) const;

 private:
  const Communicator& comm_;
  std::int64_t count_ = 0;
  std::vector<int> owner_;  // of the ids that are kept here
};

// An element that a rank knows: its id and the ids of its vertices.
template <std::size_t N>
struct Element {
  int id;
  std::array<int, N> vertices;
};

// (c) Keeps of each rank's elements those that it owns, ordered by id: the lowest rank that gives an element
// owns it. Returns how many there are in all. Throws std::invalid_argument where ids have gaps or two ranks
// give one element different vertices. what: "face" or so.
template <std::size_t N>
std::int64_t keep_owned(const Communicator& comm, const char* what, std::vector<Element<N>>& elements);

// (c) The edges of all faces, numbered as onset::edges does, of which a rank keeps those that it owns.
// Returns how many there are in all.
std::int64_t edges_of_faces(const Communicator& comm, std::int64_t vertices,
                            const std::vector<Element<3>>& faces, std::vector<Element<2>>& edges);

// (c) Throws std::invalid_argument where a face has an edge that no rank gives.
void require_edges(const Communicator& comm, std::int64_t vertices, const std::vector<Element<3>>& faces,
                   const std::vector<Element<2>>& edges);

// (c) Throws std::invalid_argument where a point's vertex is that of another point, edge or face, of any
// rank.
void require_lone_points(const Communicator& comm, std::int64_t vertices,
                         const std::vector<Element<2>>& points, const std::vector<Element<2>>& edges,
                         const std::vector<Element<3>>& faces);

}  // namespace onset::mpi
