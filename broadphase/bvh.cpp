#include "broadphase/bvh.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "broadphase/motion_box.hpp"
#include "broadphase/pair_batch.hpp"

namespace onset {

namespace {

constexpr std::size_t kWidth = 8;

MotionBox box_union(const MotionBox& a, const MotionBox& b) {
  MotionBox u;
  for (std::size_t i = 0; i < 3; ++i) {
    u.lo_t0[i] = std::min(a.lo_t0[i], b.lo_t0[i]), u.hi_t0[i] = std::max(a.hi_t0[i], b.hi_t0[i]);
    u.lo_t1[i] = std::min(a.lo_t1[i], b.lo_t1[i]), u.hi_t1[i] = std::max(a.hi_t1[i], b.hi_t1[i]);
  }
  return u;
}

std::uint32_t spread(std::uint32_t x) {  // 10 bits, two zeros between each
  x = (x | (x << 16)) & 0x030000ffu;
  x = (x | (x << 8)) & 0x0300f00fu;
  x = (x | (x << 4)) & 0x030c30c3u;
  return (x | (x << 2)) & 0x09249249u;
}

// Implicit tree: level 0 holds the primitives in Morton order, node n of level l covers nodes 8n .. 8n+7 of
// level l-1.
class Tree {
 public:
  Tree() = default;
  Tree(const BroadPhaseInput& input, Primitive kind)
      : kind_(kind), order_(primitive_count(input.mesh, kind)) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = int(i);
    refit(input);
    if (!order_.empty()) sort();
    refit(input);
  }

  void refit(const BroadPhaseInput& input) {
    levels_.assign(1, std::vector<MotionBox>(order_.size()));
    for (std::size_t i = 0; i < order_.size(); ++i) levels_[0][i] = motion_box(input, kind_, order_[i]);
    while (levels_.back().size() > kWidth) {
      const std::vector<MotionBox>& below = levels_.back();
      std::vector<MotionBox> level((below.size() + kWidth - 1) / kWidth);
      for (std::size_t n = 0; n < level.size(); ++n) {
        level[n] = below[n * kWidth];
        for (std::size_t c = n * kWidth; c < std::min(below.size(), (n + 1) * kWidth); ++c)
          level[n] = box_union(level[n], below[c]);
      }
      levels_.push_back(std::move(level));
    }
  }

  std::size_t size() const { return order_.size(); }
  int id(std::size_t place) const { return order_[place]; }
  const MotionBox& box(std::size_t place) const { return levels_[0][place]; }

  // f(place) for every primitive at or after `from` whose box passes against `query`.
  template <class F>
  void visit(BoxTest test, const MotionBox& query, std::size_t from, F&& f) const {
    visit(levels_.size() - 1, 0, levels_.back().size(), test, query, from, f);
  }

 private:
  template <class F>
  void visit(std::size_t level, std::size_t first, std::size_t last, BoxTest test, const MotionBox& query,
             std::size_t from, F&& f) const {
    for (std::size_t n = first; n < last; ++n) {
      if (((n + 1) << (3 * level)) <= from || !boxes_pass(test, levels_[level][n], query)) continue;
      if (level == 0)
        f(n);
      else
        visit(level - 1, n * kWidth, std::min(levels_[level - 1].size(), (n + 1) * kWidth), test, query, from,
              f);
    }
  }

  void sort() {
    MotionBox all = levels_[0][0];
    for (const MotionBox& b : levels_[0]) all = box_union(all, b);
    std::vector<std::pair<std::uint32_t, int>> keys(order_.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      std::uint32_t key = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double extent = all.hi_t0[a] - all.lo_t0[a];
        const double middle = 0.5 * levels_[0][i].lo_t0[a] + 0.5 * levels_[0][i].hi_t0[a];
        const double cell = extent > 0 ? (middle - all.lo_t0[a]) / extent * 1023 : 0;
        key |= spread(std::uint32_t(std::min(std::max(cell, 0.0), 1023.0))) << a;
      }
      keys[i] = {key, int(i)};
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < keys.size(); ++i) order_[i] = keys[i].second;
  }

  Primitive kind_ = Primitive::vertex;
  std::vector<int> order_;
  std::vector<std::vector<MotionBox>> levels_;
};

class Bvh final : public BroadPhase {
 public:
  explicit Bvh(const BroadPhaseInput& input)
      : mesh_(input.mesh),
        test_(input.test),
        trees_{Tree(input, Primitive::vertex), Tree(input, Primitive::edge), Tree(input, Primitive::face)} {}

  const char* name() const override { return "bvh"; }

  void refit(const BroadPhaseInput& input) override {
    test_ = input.test;
    for (Tree& tree : trees_) tree.refit(input);
  }

  std::size_t blocks(PairKind kind) const override {
    return tree(second_primitive(kind)).size() == 0
               ? 0
               : (tree(first_primitive(kind)).size() + kWidth - 1) / kWidth;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const Tree &A = tree(first_primitive(kind)), &B = tree(second_primitive(kind));
    const bool self = kind == PairKind::edge_edge;
    PairBatch batch(sink);
    for (std::size_t p = first * kWidth; p < std::min(last * kWidth, A.size()); ++p)
      B.visit(test_, A.box(p), self ? p + 1 : 0, [&](std::size_t q) {
        const int a = A.id(p), b = B.id(q);
        if (!share_vertex(mesh_, kind, a, b)) batch.add(self ? std::min(a, b) : a, self ? std::max(a, b) : b);
      });
    batch.flush();
  }

 private:
  const Tree& tree(Primitive kind) const { return trees_[std::size_t(kind)]; }

  const MeshData& mesh_;
  BoxTest test_;
  std::array<Tree, 3> trees_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_bvh(const BroadPhaseInput& input) { return std::make_unique<Bvh>(input); }

}  // namespace onset
