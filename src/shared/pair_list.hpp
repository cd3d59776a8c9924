// A list of pairs as a source: found once and streamed again for every step size.
#pragma once

#include <array>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "onset/mesh.hpp"
#include "onset/step_size.hpp"
#include "scene/motion/motion.hpp"
#include "scene/pair_source.hpp"
#include "src/shared/budget.hpp"

namespace onset {

// Streams the pairs that it holds, in batches, one a block; those with planes are only held.
class PairList final : public PairSource {
 public:
  std::size_t blocks(PairKind kind) const override;
  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override;

  const std::vector<IdPair>& of(PairKind kind) const { return pairs_[std::size_t(kind)]; }
  std::vector<IdPair>& of(PairKind kind) { return pairs_[std::size_t(kind)]; }
  PairCounts counts() const {
    const auto count = [&](PairKind kind) { return std::int64_t(of(kind).size()); };
    return {count(PairKind::vertex_face), count(PairKind::edge_edge), count(PairKind::vertex_edge),
            count(PairKind::vertex_plane)};
  }

 private:
  std::array<std::vector<IdPair>, std::size_t(PairKind::vertex_plane) + 1> pairs_;
};

// A list for the pairs that the culls of `narrow` cannot certify.
struct CulledList {
  const NarrowPhase& narrow;
  PairList& list;
};

// Fills all lists in one traversal of `broad`, each in the order of ids. Returns false, and leaves the lists
// empty, where they would hold more than `most` pairs in all or the budget is spent.
bool cull_into(const PairSource& broad, const std::vector<CulledList>& lists, std::int64_t most,
               Budget& budget);

// Returns the largest step in [0, upper] on which each of these pairs keeps the share `gap_share` of its gap,
// stored in doubles, with statistics. A motion that cannot be used is an outcome.
StepResult step_of_pairs(const Mesh& mesh, const Motion& motion, const PairList& pairs,
                         const Options& options, double gap_share, Budget& budget, double upper = 1);

}  // namespace onset
