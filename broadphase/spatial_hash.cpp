#include "broadphase/spatial_hash.hpp"

#include <algorithm>
#include <optional>

#include "base/parallel.hpp"
#include "broadphase/cell_grid.hpp"
#include "broadphase/pair_batch.hpp"

namespace onset {

namespace {

constexpr std::size_t kEntriesEach = 8;      // cells a primitive may cover on average: bounds the memory
constexpr std::size_t kEntriesABlock = 512;  // of traversal, more where one cell holds more

// The primitives of both sides of a kind of pairs, by cell.
class Cells {
 public:
  Cells(const FloatMap& map, const std::vector<MotionBox>& first, const std::vector<MotionBox>& second,
        bool self) {
    std::vector<const std::vector<MotionBox>*> sets{&first};
    if (!self) sets.push_back(&second);
    const CellGrid grid(map, sets, kEntriesEach * (first.size() + (self ? 0 : second.size())));
    grid.append(first, false, entries_);
    if (!self) grid.append(second, true, entries_);
    parallel_sort(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) { return a < b; });
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (i == 0 || (i - block_starts_.back() >= kEntriesABlock && entries_[i].cell != entries_[i - 1].cell))
        block_starts_.push_back(i);
    block_starts_.push_back(entries_.size());
    for (const MotionBox& b : first) first_ranges_.push_back(grid.range(b));
    if (!self)
      for (const MotionBox& b : second) second_ranges_.push_back(grid.range(b));
  }

  std::size_t blocks() const { return block_starts_.size() - 1; }

  // f(a, b) for each pair of primitives that meet in a cell of these blocks and are to be reported there.
  template <class F>
  void visit(std::size_t first, std::size_t last, bool self, F&& f) const {
    const std::size_t end = block_starts_[last];
    const auto& other = self ? first_ranges_ : second_ranges_;
    for (std::size_t begin = block_starts_[first], stop; begin < end; begin = stop) {
      for (stop = begin; stop < end && entries_[stop].cell == entries_[begin].cell;) ++stop;
      for (std::size_t i = begin; i < stop && !entries_[i].second; ++i)
        for (std::size_t j = i + 1; j < stop; ++j) {
          if (entries_[j].second == self) continue;
          const std::size_t a = std::size_t(entries_[i].id), b = std::size_t(entries_[j].id);
          if (CellGrid::cell_of_pair(first_ranges_[a], other[b]) == entries_[i].cell) f(int(a), int(b));
        }
    }
  }

 private:
  std::vector<CellGrid::Entry> entries_;
  std::vector<std::size_t> block_starts_;
  std::vector<CellGrid::Range> first_ranges_, second_ranges_;
};

class SpatialHash final : public BroadPhase {
 public:
  explicit SpatialHash(const BroadPhaseInput& input) : mesh_(input.mesh) { refit(input); }

  const char* name() const override { return "hash"; }

  void refit(const BroadPhaseInput& input) override {
    test_ = input.test;
    finite_ = input.motion.status == Outcome::free;
    if (!finite_) return;
    const FloatMap map = make_float_map(input.motion);
    for (Primitive kind : {Primitive::vertex, Primitive::edge, Primitive::face})
      boxes_[std::size_t(kind)] = motion_boxes(input, kind);
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
      cells_[std::size_t(kind)].emplace(map, boxes(first_primitive(kind)), boxes(second_primitive(kind)),
                                        kind == PairKind::edge_edge);
  }

  std::size_t blocks(PairKind kind) const override {
    return finite_ && !boxes(second_primitive(kind)).empty() ? cells_[std::size_t(kind)]->blocks() : 0;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const auto &A = boxes(first_primitive(kind)), &B = boxes(second_primitive(kind));
    PairBatch batch(sink);
    cells_[std::size_t(kind)]->visit(first, last, kind == PairKind::edge_edge, [&](int a, int b) {
      if (boxes_pass(test_, A[std::size_t(a)], B[std::size_t(b)]) && !share_vertex(mesh_, kind, a, b))
        batch.add(a, b);
    });
    batch.flush();
  }

 private:
  const std::vector<MotionBox>& boxes(Primitive kind) const { return boxes_[std::size_t(kind)]; }

  const MeshData& mesh_;
  BoxTest test_ = BoxTest::motion;
  bool finite_ = false;
  std::array<std::vector<MotionBox>, 3> boxes_;
  std::array<std::optional<Cells>, 2> cells_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_spatial_hash(const BroadPhaseInput& input) {
  return std::make_unique<SpatialHash>(input);
}

}  // namespace onset
