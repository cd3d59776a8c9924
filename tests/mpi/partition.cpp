#include "tests/mpi/partition.hpp"

#include <algorithm>

namespace onset::tests {

const char* to_string(Cut cut) {
  constexpr const char* kNames[] = {"blocks", "rcb", "random", "all on one", "an empty rank"};
  return kNames[int(cut)];
}

std::vector<int> ranks_of_vertices(const WholeScene& scene, Cut cut, int ranks, unsigned seed) {
  if (cut == Cut::all_on_one)
    return std::vector<int>(std::size_t(scene.x_t0.rows()), int(seed % unsigned(ranks)));
  if (cut != Cut::empty_rank || ranks == 1)
    return app::ranks_of_vertices(scene.x_t0,
                                  cut == Cut::rcb      ? app::Partition::rcb
                                  : cut == Cut::random ? app::Partition::random
                                                       : app::Partition::blocks,
                                  ranks, seed);
  std::vector<int> rank_of = app::ranks_of_vertices(scene.x_t0, app::Partition::blocks, ranks - 1);
  const int empty = int(seed % unsigned(ranks));
  for (int& r : rank_of) r += r >= empty;
  return rank_of;
}

mpi::MeshPart part_of(const WholeScene& scene, const std::vector<int>& rank_of, int rank) {
  return app::part_of(scene.mesh, rank_of, rank, scene.edges_are_given);
}

}  // namespace onset::tests
