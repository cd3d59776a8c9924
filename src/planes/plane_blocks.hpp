// Parallel visits of the vertices that meet the planes of a mesh, in blocks.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "base/parts.hpp"
#include "narrowphase/plane/oriented_plane.hpp"
#include "onset/options.hpp"
#include "scene/pair_sink.hpp"
#include "scene/planes.hpp"
#include "src/shared/budget.hpp"
#include "src/shared/visit_pairs.hpp"

namespace onset {

// The vertices of a plane, rows [first, last) of its list, which is null where they are the ids themselves.
struct PlaneBlock {
  const OrientedPlane* plane;
  int row;
  const int* list;
  std::size_t first, last;

  int vertex(std::size_t i) const { return list == nullptr ? int(i) : list[i]; }
};

class PlaneBlocks {
 public:
  // The axes of the positions that the planes are asked about: Motion::axes.
  PlaneBlocks(const MeshData& mesh, const std::array<int, 3>& axes, Norm norm) {
    if (!mesh.mesh_planes) return;
    const std::vector<MeshPlane>& rows = mesh.mesh_planes->rows;
    planes_.reserve(rows.size());  // blocks point to them
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const MeshPlane& row = rows[p];
      planes_.emplace_back(row, axes, norm == Norm::maximum);
      const std::size_t count = row.all ? std::size_t(mesh.num_vertices) : row.vertices.size();
      for (std::size_t first = 0; first < count; first += kVertices)
        blocks_.push_back({&planes_.back(), int(p), row.all ? nullptr : row.vertices.data(), first,
                           std::min(first + kVertices, count)});
    }
  }
  PlaneBlocks(const PlaneBlocks&) = delete;
  PlaneBlocks& operator=(const PlaneBlocks&) = delete;

  std::size_t size() const { return blocks_.size(); }
  const std::vector<OrientedPlane>& planes() const { return planes_; }

  // Calls visit(index, block) for all, from any thread, until the budget is spent.
  template <class Visit>
  void visit(Budget& budget, const Visit& visit) const {
    parallel_ranges(blocks_.size(), 1, [&](std::size_t first, std::size_t last) {
      for (; first < last && !budget.spent(); ++first) {
        visit(first, blocks_[first]);
        if (budget.outcome() == Outcome::free) budget.advance(1);
      }
    });
  }

 private:
  static constexpr std::size_t kVertices = 4096;
  std::vector<OrientedPlane> planes_;
  std::vector<PlaneBlock> blocks_;
};

// Says, once in so many decisions, whether the call must end.
class PlaneWatch {
 public:
  explicit PlaneWatch(Budget& budget) : stop_(budget.stop()) {}
  bool ended() { return stop_.asked != nullptr && ++count_ % kWatchedPairs == 0 && stop_.requested(); }

 private:
  const Stop stop_;
  std::size_t count_ = 0;
};

// Calls take(found), from any thread, with what visit(block, vertex, found) has appended to `found` for the
// vertices of one block, for all blocks. A spent budget ends it early.
template <class Found, class Visit, class Take>
void visit_planes(const PlaneBlocks& blocks, Budget& budget, const Visit& visit, const Take& take) {
  budget.begin_traversal(blocks.size());
  blocks.visit(budget, [&](std::size_t, const PlaneBlock& block) {
    std::vector<Found> found;
    PlaneWatch watch(budget);
    for (std::size_t i = block.first; i < block.last && !watch.ended(); ++i)
      visit(block, block.vertex(i), found);
    take(found);
  });
}

// Appends to `all` what visit(block, vertex, found) appends to `found` for the vertices of all planes,
// ordered by ids_of(found): not too many are then `most`, with those that are there already. A spent budget
// ends it early, with some of what was found until then: kRowsCutOff at most.
template <class Found, class Visit, class IdsOf>
void gather_planes(const PlaneBlocks& blocks, std::size_t most, Budget& budget, const Visit& visit,
                   const IdsOf& ids_of, Gathered<Found>& all) {
  if (blocks.size() == 0 || all.too_many) return;
  Parts<Found> parts;
  std::atomic<std::size_t> count{all.found.size()};
  visit_planes<Found>(blocks, budget, visit, [&](std::vector<Found>& found) {
    if ((count += found.size()) <= most) parts.add(found);
  });
  all.too_many = count > most;
  if (all.too_many) {
    parts.clear();
    all.found = {};
    return;
  }
  const auto key = [&](const Found& f) {
    const IdPair ids = ids_of(f);
    return std::uint64_t(ids.a) << 32 | std::uint64_t(ids.b);
  };
  sort_within(budget, parts, key, all.found);
}

}  // namespace onset
