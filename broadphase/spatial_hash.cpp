#include "broadphase/spatial_hash.hpp"

#include <algorithm>
#include <optional>

#include "base/parallel.hpp"
#include "broadphase/bvh/float_boxes.hpp"
#include "broadphase/cell_grid.hpp"
#include "scene/pair_source.hpp"

namespace onset {

namespace {

constexpr std::size_t kEntriesEach = 8;      // cells that a primitive may cover on average: bounds the memory
constexpr std::size_t kEntriesABlock = 512;  // more where one cell holds more

struct Boxes {
  std::vector<int> ids;
  std::vector<MotionBox> exact;
  std::vector<FloatBox> swept;
};

Boxes make_boxes(const BroadPhaseInput& input, const FloatMap& map, Primitive kind) {
  Boxes boxes;
  MotionBoxes made = motion_boxes(input, kind);
  boxes.ids = std::move(made.ids), boxes.exact = std::move(made.boxes);
  boxes.swept.reserve(boxes.exact.size());
  for (const MotionBox& b : boxes.exact) {
    FloatBox f;
    for (std::size_t i = 0; i < 3; ++i) {
      f.lo[i] = map(std::min(b.lo_t0[i], b.lo_t1[i]), i);
      f.hi[i] = map(std::max(b.hi_t0[i], b.hi_t1[i]), i);
    }
    boxes.swept.push_back(f);
  }
  return boxes;
}

struct Entry {
  std::uint64_t cell;
  int id;       // in its side
  bool second;  // which side of the pair
};

// Sorts the primitives of both sides of a kind of pairs by cell.
class Cells {
 public:
  Cells(const std::vector<FloatBox>& first, const std::vector<FloatBox>& second, bool self)
      : sides_{&first, &second},
        self_(self),
        grid_(self ? std::vector{&first} : std::vector{&first, &second},
              kEntriesEach * (first.size() + (self ? 0 : second.size()))) {
    for (int side = 0; side < (self ? 1 : 2); ++side)
      for (std::size_t id = 0; id < sides_[side]->size(); ++id)
        grid_.visit((*sides_[side])[id], [&](std::uint64_t cell) {
          entries_.push_back({cell, int(id), side == 1});
        });
    parallel_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.second != b.second ? b.second : a.id < b.id;
    });
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (i == 0 || (i - block_starts_.back() >= kEntriesABlock && entries_[i].cell != entries_[i - 1].cell))
        block_starts_.push_back(i);
    block_starts_.push_back(entries_.size());
  }

  std::size_t blocks() const { return block_starts_.size() - 1; }

  // Calls f(a, b) once for each pair whose swept float boxes overlap, in the cell where it is to be reported.
  template <class F>
  void visit(std::size_t first, std::size_t last, F&& f) const {
    std::vector<Member> members;
    const std::size_t end = block_starts_[last];
    for (std::size_t i = block_starts_[first]; i < end;) {
      const std::uint64_t cell = entries_[i].cell;
      members.clear();
      for (; i < end && entries_[i].cell == cell; ++i)
        members.push_back(
            {(*sides_[entries_[i].second])[std::size_t(entries_[i].id)], entries_[i].id, entries_[i].second});
      sweep(members, cell, f);
    }
  }

 private:
  struct Member {
    FloatBox box;
    int id;
    bool second;
  };

  // Sorts by lower end along the first axis, and compares each with those that begin before it ends.
  template <class F>
  void sweep(std::vector<Member>& members, std::uint64_t cell, F&& f) const {
    std::sort(members.begin(), members.end(), [](const Member& p, const Member& q) {
      if (p.box.lo[0] != q.box.lo[0]) return p.box.lo[0] < q.box.lo[0];
      return p.second != q.second ? q.second : p.id < q.id;
    });
    for (auto p = members.begin(); p != members.end(); ++p)
      for (auto q = p + 1; q != members.end() && q->box.lo[0] <= p->box.hi[0]; ++q) {
        if (p->second == q->second && !self_) continue;
        const FloatBox &a = p->box, &b = q->box;
        if (b.lo[1] > a.hi[1] || a.lo[1] > b.hi[1] || b.lo[2] > a.hi[2] || a.lo[2] > b.hi[2]) continue;
        if (grid_.cell({b.lo[0], std::max(a.lo[1], b.lo[1]), std::max(a.lo[2], b.lo[2])}) != cell) continue;
        const bool swap = self_ ? p->id > q->id : p->second;
        swap ? f(q->id, p->id) : f(p->id, q->id);
      }
  }

  const std::vector<FloatBox>* sides_[2];
  bool self_;
  CellGrid grid_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> block_starts_;
};

class SpatialHash final : public BroadPhase {
 public:
  explicit SpatialHash(const BroadPhaseInput& input) : mesh_(input.mesh) { refit(input); }

  const char* name() const override { return "hash"; }

  bool suits(const Motion&) const override { return true; }  // a grid has no order to spoil
  void refit(const BroadPhaseInput& input) override {
    test_ = input.test;
    finite_ = input.motion.status == Outcome::free;
    if (!finite_) return;
    const FloatMap map(input.motion);
    for (Primitive kind : kPrimitives)
      boxes_[std::size_t(kind)] = is_wanted(input, kind) ? make_boxes(input, map, kind) : Boxes{};
    for (PairKind kind : wanted_kinds(input))
      cells_[std::size_t(kind)].emplace(boxes(first_primitive(kind)).swept,
                                        boxes(second_primitive(kind)).swept, kind == PairKind::edge_edge);
  }

  std::size_t blocks(PairKind kind) const override {
    const std::optional<Cells>& cells = cells_[std::size_t(kind)];
    return finite_ && cells ? cells->blocks() : 0;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const Boxes &A = boxes(first_primitive(kind)), &B = boxes(second_primitive(kind));
    PairBatch batch(sink);
    cells_[std::size_t(kind)]->visit(first, last, [&](int i, int j) {
      const int a = A.ids[std::size_t(i)], b = B.ids[std::size_t(j)];
      if (boxes_overlap(test_, A.exact[std::size_t(i)], B.exact[std::size_t(j)]) &&
          may_meet(mesh_, kind, a, b))
        batch.add(a, b);
    });
    batch.flush();
  }

 private:
  const Boxes& boxes(Primitive kind) const { return boxes_[std::size_t(kind)]; }

  const MeshData& mesh_;
  BoxTest test_ = BoxTest::both_ends;
  bool finite_ = false;
  std::array<Boxes, 3> boxes_;
  std::array<std::optional<Cells>, 3> cells_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_spatial_hash(const BroadPhaseInput& input) {
  return std::make_unique<SpatialHash>(input);
}

}  // namespace onset
