#include "broadphase/spatial_hash.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

#include "base/radix_sort.hpp"
#include "broadphase/bvh/float_boxes.hpp"
#include "broadphase/cell_grid.hpp"
#include "scene/pair_source.hpp"

namespace onset {

namespace {

constexpr std::size_t kEntriesEach = 8;      // cells that a primitive may cover on average: bounds the memory
constexpr std::size_t kEntriesABlock = 512;  // more where one cell holds more
constexpr std::size_t kTestsALook = 4096;    // entries and pairs between two looks at whether to stop

struct Boxes {
  std::vector<int> ids;
  std::vector<MotionBox> exact;
  std::vector<FloatBox> swept;
};

Boxes make_boxes(const BroadPhaseInput& input, const FloatMap& map, Primitive kind, const Stop& stop) {
  Boxes boxes;
  MotionBoxes made = motion_boxes(input, kind, stop);
  boxes.ids = std::move(made.ids), boxes.exact = std::move(made.boxes);
  boxes.swept.reserve(boxes.exact.size());
  each_unless(stop, 0, boxes.exact.size(), [&](std::size_t k) {
    const MotionBox& b = boxes.exact[k];
    FloatBox f;
    for (std::size_t i = 0; i < 3; ++i) {
      f.lo[i] = map(std::min(b.lo_t0[i], b.lo_t1[i]), i);
      f.hi[i] = map(std::max(b.hi_t0[i], b.hi_t1[i]), i);
    }
    boxes.swept.push_back(f);
  });
  return boxes;
}

struct Entry {
  std::uint64_t cell;
  int id;       // in its side
  bool second;  // which side of the pair
};

// A key in the order of the numbers, -0 being 0.
std::uint64_t ordered(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  if (x == 0) bits = 0;
  return bits >> 31 ? ~bits : bits | 0x80000000u;
}

// Sorts the primitives of both sides of a kind of pairs by cell, and within a cell by side and id.
class Cells {
 public:
  Cells(const std::vector<FloatBox>& first, const std::vector<FloatBox>& second, bool self, const Stop& stop)
      : sides_{&first, &second},
        self_(self),
        grid_(self ? std::vector{&first} : std::vector{&first, &second},
              kEntriesEach * (first.size() + (self ? 0 : second.size())), stop) {
    if (!stop.requested()) entries_.reserve(grid_.covered());
    for (int side = 0; side < (self ? 1 : 2); ++side)
      each_unless(stop, 0, sides_[side]->size(), [&](std::size_t id) {
        grid_.visit((*sides_[side])[id], [&](std::uint64_t cell) {
          entries_.push_back({cell, int(id), side == 1});
        });
      });
    if (!radix_sort(
            entries_, [](const Entry& e) { return e.cell; }, stop))
      entries_.clear();
    each_unless(stop, 0, entries_.size(), [&](std::size_t i) {
      if (i == 0 || (i - block_starts_.back() >= kEntriesABlock && entries_[i].cell != entries_[i - 1].cell))
        block_starts_.push_back(i);
    });
    block_starts_.push_back(entries_.size());
  }

  std::size_t blocks() const { return block_starts_.size() - 1; }

  // Calls f(a, b) once for each pair whose swept float boxes overlap, in the cell where it is to be reported.
  template <class F>
  void visit(std::size_t first, std::size_t last, const Stop& stop, F&& f) const {
    std::vector<Member> members;
    Patience patience{stop};
    const std::size_t end = block_starts_[last];
    for (std::size_t i = block_starts_[first]; i < end;) {
      const std::uint64_t cell = entries_[i].cell;
      members.clear();
      for (; i < end && entries_[i].cell == cell; ++i)
        members.push_back(
            {(*sides_[entries_[i].second])[std::size_t(entries_[i].id)], entries_[i].id, entries_[i].second});
      if (!patience.lasts(members.size()) || !sweep(members, cell, patience, f)) return;
    }
  }

 private:
  struct Member {
    FloatBox box;
    int id;
    bool second;
  };

  // Asks every kTestsALook.
  struct Patience {
    const Stop& stop;
    std::size_t tests = 0;
    bool lasts(std::size_t more) {
      if ((tests += more) < kTestsALook) return true;
      tests = 0;
      return !stop.requested();
    }
  };

  // Sorts by lower end along the first axis, then by side and id, as they come.
  static bool sort(std::vector<Member>& members, const Stop& stop) {
    if (members.size() >= kItemsALook)
      return radix_sort(
          members, [](const Member& p) { return ordered(p.box.lo[0]); }, stop);
    std::sort(members.begin(), members.end(), [](const Member& p, const Member& q) {
      if (p.box.lo[0] != q.box.lo[0]) return p.box.lo[0] < q.box.lo[0];
      return p.second != q.second ? q.second : p.id < q.id;
    });
    return true;
  }

  // Compares each with those that begin before it ends. Returns false where it was stopped.
  template <class F>
  bool sweep(std::vector<Member>& members, std::uint64_t cell, Patience& patience, F&& f) const {
    if (!sort(members, patience.stop)) return false;
    for (auto p = members.begin(); p != members.end(); ++p)
      for (auto q = p + 1; q != members.end() && q->box.lo[0] <= p->box.hi[0]; ++q) {
        if (!patience.lasts(1)) return false;
        if (p->second == q->second && !self_) continue;
        const FloatBox &a = p->box, &b = q->box;
        if (b.lo[1] > a.hi[1] || a.lo[1] > b.hi[1] || b.lo[2] > a.hi[2] || a.lo[2] > b.hi[2]) continue;
        if (grid_.cell({b.lo[0], std::max(a.lo[1], b.lo[1]), std::max(a.lo[2], b.lo[2])}) != cell) continue;
        const bool swap = self_ ? p->id > q->id : p->second;
        swap ? f(q->id, p->id) : f(p->id, q->id);
      }
    return true;
  }

  const std::vector<FloatBox>* sides_[2];
  bool self_;
  CellGrid grid_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> block_starts_;
};

class SpatialHash final : public BroadPhase {
 public:
  SpatialHash(const BroadPhaseInput& input, const Stop& stop) : mesh_(input.mesh) { refit(input, stop); }

  const char* name() const override { return "hash"; }

  bool suits(const Motion&) const override { return true; }  // a grid has no order to spoil
  void refit(const BroadPhaseInput& input, const Stop& stop) override {
    test_ = input.test;
    ready_ = false;
    finite_ = input.motion.status == Outcome::free;
    if (finite_) {
      const FloatMap map(input.motion);
      for (Primitive kind : kPrimitives)
        boxes_[std::size_t(kind)] = is_wanted(input, kind) ? make_boxes(input, map, kind, stop) : Boxes{};
      for (PairKind kind : wanted_kinds(input)) {
        if (stop.requested()) return;
        cells_[std::size_t(kind)].emplace(boxes(first_primitive(kind)).swept,
                                          boxes(second_primitive(kind)).swept, kind == PairKind::edge_edge,
                                          stop);
      }
    }
    ready_ = !stop.requested();
  }

  std::size_t blocks(PairKind kind) const override {
    const std::optional<Cells>& cells = cells_[std::size_t(kind)];
    return ready_ && finite_ && cells ? cells->blocks() : 0;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const Boxes &A = boxes(first_primitive(kind)), &B = boxes(second_primitive(kind));
    PairBatch batch(sink);
    cells_[std::size_t(kind)]->visit(first, last, sink.stop, [&](int i, int j) {
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
  std::array<std::optional<Cells>, kPairKinds> cells_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_spatial_hash(const BroadPhaseInput& input, const Stop& stop) {
  return std::make_unique<SpatialHash>(input, stop);
}

}  // namespace onset
