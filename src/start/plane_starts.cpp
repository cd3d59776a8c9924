#include "src/start/plane_starts.hpp"

#include "narrowphase/plane/plane_decision.hpp"
#include "scene/pairs/separation.hpp"
#include "src/shared/close_set.hpp"

namespace onset {
namespace {

// Returns where the vertex is, unless a cheap test tells that it is beyond the separation.
std::optional<PlaneStart> near(const Motion& motion, const Options& options, const PlaneBlock& block, int v,
                               double separation) {
  const double* x = motion.t0(v);
  if (PlaneSpan(*block.plane, x, x).stays_beyond(*block.plane, separation, 0)) return std::nullopt;
  const bool maximum_norm = options.norm == Norm::maximum;
  const PlaneStart start =
      start_at_plane(*block.plane, question_of(*block.plane, x, x, separation, maximum_norm));
  if (!start.within) return std::nullopt;
  return start;
}

}  // namespace

Gathered<std::array<int, 2>> find_behind_planes(const Mesh& mesh, const Motion& motion,
                                                const Options& options, std::size_t most, Budget& budget) {
  using Ids = std::array<int, 2>;
  Gathered<Ids> all;
  gather_planes(
      PlaneBlocks(mesh.data(), motion.axes, options.norm), most, budget,
      [&](const PlaneBlock& block, int v, std::vector<Ids>& found) {
        if (near(motion, options, block, v, 0)) found.push_back({v, block.row});
      },
      [](const Ids& ids) {
        return IdPair{ids[0], ids[1]};
      },
      all);
  return all;
}

void add_near_planes(const Mesh& mesh, const Motion& motion, const Options& options, std::size_t most,
                     Budget& budget, Gathered<NearPair>& all) {
  gather_planes(
      PlaneBlocks(mesh.data(), motion.axes, options.norm), most, budget,
      [&](const PlaneBlock& block, int v, std::vector<NearPair>& found) {
        const auto start = near(motion, options, block, v, separation_from_planes(mesh.data(), options, v));
        if (!start) return;
        NearPair p{pair_with_plane(mesh, options, v, block.row), start->touches};
        put_plane_distance(start->distance, p.pair);
        found.push_back(p);
      },
      [](const NearPair& p) {
        return IdPair{p.pair.a, p.pair.b};
      },
      all);
}

}  // namespace onset
