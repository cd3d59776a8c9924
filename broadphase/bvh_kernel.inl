// The text of bvh_kernel.hpp, compiled once per instruction set: see base/pack8f.hpp.
#include "base/pack8f.hpp"
#include "broadphase/bvh_kernel.hpp"

namespace onset {
namespace ONSET_KERNEL {
namespace {

constexpr int opposite(int row) { return (row + 3) % 6; }

// Supports of one box, `stride` floats apart, against a block of eight: per lane the smallest overlap over
// the six directions, each the larger of its values at the two ends. Negative: separated on the same side at
// both ends.
template <bool kMotion>
inline F8 overlap(const float* box, int stride, const float* block) {
  F8 least{};
  for (int k = 0; k < 6; ++k) {
    F8 reach = broadcast(box + opposite(k) * stride) + load(block + k * kLanes);
    if (kMotion)
      reach = max(broadcast(box + (6 + opposite(k)) * stride) + load(block + (6 + k) * kLanes), reach);
    least = k == 0 ? reach : min(reach, least);
  }
  return least;
}

// Lanes of `mask` whose boxes only touch the lane box's, in float, on an axis where that may be due to
// rounding.
template <bool kMotion>
int touching(int mask, int rounded_axes, const float* box, const float* block) {
  int result = 0;
  for (int k = 0; k < 6; ++k) {
    if ((rounded_axes >> k % 3 & 1) == 0) continue;
    F8 reach = broadcast(box + opposite(k) * kLanes) + load(block + k * kLanes);
    if (kMotion)
      reach = max(broadcast(box + (6 + opposite(k)) * kLanes) + load(block + (6 + k) * kLanes), reach);
    result |= mask_zero(reach);
  }
  return mask & result;
}

// Entries are written eight at a time, so there is room for eight more than may count.
constexpr int kCapacity = 256;

struct Pairs {
  int a[kCapacity + kLanes], b[kCapacity + kLanes];
  int count = 0;

  bool full() const { return count > kCapacity - kLanes; }
  void add(I8 as, I8 bs, int lanes) {
    store(a + count, as), store(b + count, bs);
    count += count_lanes(lanes);
  }
};

// Two trees descended side by side. Every step is a loop over a list that writes the next list without
// branches, eight entries at a time and as many of them counted as the test says; a list that is full is
// emptied downward first, so memory is constant and the work depth first.
template <bool kMotion, bool kSelf>
class Traversal {
 public:
  explicit Traversal(const TraverseArguments& arguments) : t_(arguments) {}

  void run() {
    const int top = t_.tree.levels - 1;
    for (std::size_t q = t_.first; q < t_.last; ++q) {
      Pairs& start = blocks_[top];
      start.a[start.count] = int(q), start.b[start.count++] = 0;
      if (start.full()) empty_blocks(top);
    }
    for (int level = top; level >= 0; --level) empty_blocks(level);
    flush();
  }

 private:
  static constexpr int kRows = kRowsOf[kMotion];
  static constexpr int kBoxStride = kBoxStrideOf[kMotion];
  static constexpr int kOwn = kSelf ? 2 : 1, kOther = kSelf ? 2 : 3;  // vertices of a primitive

  static const float* block_of(const TreeView& tree, int level, int n) {
    return tree.level[level] + std::size_t(n) * (kRows * kLanes);
  }
  static const float* box_of(const TreeView& tree, int level, int n) {
    return tree.box[level] + std::size_t(n) * kBoxStride;
  }

  // blocks_[l] pairs a block of `query` at level min(l, 1) with one of `tree` at level l.
  void empty_blocks(int level) {
    if (level > 1)
      descend(level);
    else
      split(level);
    blocks_[level].count = 0;
  }

  // A block of the query, still whole, against the children of a node above.
  void descend(int level) {
    const Pairs& from = blocks_[level];
    Pairs& to = blocks_[level - 1];
    for (int e = 0; e < from.count; ++e) {
      const int q = from.a[e], n = from.b[e];
      int mask = mask_not_negative(overlap<kMotion>(box_of(t_.query, 1, q), 1, block_of(t_.tree, level, n)));
      if (kSelf) {  // nothing before q itself
        const int skip = (q >> 3 * (level - 2)) - n * kBlock;
        mask &= 0xff << (skip > 0 ? skip : 0);
      }
      to.add(broadcast(q), compress(lane_numbers() + broadcast(n * kBlock), mask), mask);
      if (to.full()) empty_blocks(level - 1);
    }
  }

  // Which children of a meet the box of b.
  void split(int level) {
    const Pairs& from = blocks_[level];
    for (int e = 0; e < from.count; ++e) {
      const int a = from.a[e], b = from.b[e];
      const int mask =
          mask_not_negative(overlap<kMotion>(box_of(t_.tree, level, b), 1, block_of(t_.query, level, a)));
      children_[level].add(compress(lane_numbers() + broadcast(a * kBlock), mask), broadcast(b), mask);
      if (children_[level].full()) empty_children(level);
    }
    empty_children(level);
  }

  void empty_children(int level) {
    if (level > 0)
      pair_children(level);
    else
      emit();
    children_[level].count = 0;
  }

  // Lanes of block b that meet child c of a block of the query, each unordered pair once.
  int hits(int level, int c, int b, int& touching_lanes) const {
    const F8 depth = overlap<kMotion>(block_of(t_.query, level, c / kBlock) + c % kBlock, kLanes,
                                      block_of(t_.tree, level, b));
    touching_lanes = mask_zero(depth);
    const int skip = kSelf && c / kBlock == b ? c % kBlock + (level == 0) : 0;
    return mask_not_negative(depth) & 0xff << skip;
  }

  void pair_children(int level) {
    const Pairs& from = children_[level];
    Pairs& to = blocks_[level - 1];
    for (int e = 0; e < from.count; ++e) {
      int unused;
      const int mask = hits(level, from.a[e], from.b[e], unused);
      to.add(broadcast(from.a[e]), compress(lane_numbers() + broadcast(from.b[e] * kBlock), mask), mask);
      if (to.full()) empty_blocks(level - 1);
    }
  }

  void emit() {
    const Pairs& from = children_[0];
    for (int e = 0; e < from.count; ++e) {
      const int slot = from.a[e], b = from.b[e];
      int touching_lanes, mask = hits(0, slot, b, touching_lanes);
      mask &= ~sharing(slot, b);
      if ((mask & touching_lanes) != 0 && t_.rounded_axes != 0) mask = settle(mask, slot, b);
      const I8 others = compress(load(t_.tree.ids + b * kBlock), mask), same = broadcast(t_.query.ids[slot]);
      if (kSelf)
        store_interleaved(&out_[count_].a, min(same, others), max(same, others));
      else
        store_interleaved(&out_[count_].a, same, others);
      count_ += std::size_t(count_lanes(mask));
      if (count_ > kBatchSize - kLanes) flush();
    }
  }

  // Lanes of leaf block b that share a vertex with the primitive in `slot` of the query.
  int sharing(int slot, int b) const {
    const int* own = t_.query.vertices + std::size_t(slot / kBlock) * (kOwn * kBlock) + slot % kBlock;
    const int* others = t_.tree.vertices + std::size_t(b) * (kOther * kBlock);
    I8 shared = broadcast(0);
    for (int j = 0; j < kOwn; ++j)
      for (int k = 0; k < kOther; ++k)
        shared = shared | (broadcast(own[j * kBlock]) == load(others + k * kBlock));
    return mask_true(shared);
  }

  // Takes out the lanes that touch in float but not in double.
  int settle(int mask, int slot, int b) const {
    int open = touching<kMotion>(mask, t_.rounded_axes, block_of(t_.query, 0, slot / kBlock) + slot % kBlock,
                                 block_of(t_.tree, 0, b));
    for (; open != 0; open &= open - 1) {
      const int lane = lowest_lane(open);
      if (!t_.touches(t_.touches_context, t_.query.ids[slot], t_.tree.ids[b * kBlock + lane]))
        mask &= ~(1 << lane);
    }
    return mask;
  }

  void flush() {
    if (count_ > 0) t_.consume(t_.consume_context, out_, count_);
    count_ = 0;
  }

  const TraverseArguments& t_;
  Pairs blocks_[kMaxLevels], children_[2];
  std::size_t count_ = 0;
  IdPair out_[kBatchSize];
};

template <bool kMotion>
void fit_leaf(const FitArguments& a, std::size_t n) {
  constexpr std::size_t kStride = kBoxStrideOf[kMotion];
  const int* members = a.members + n * unsigned(a.members_each * kBlock);
  float* out = a.tree.level[0] + n * unsigned(kRowsOf[kMotion] * kLanes);
  for (int end = 0; end < (kMotion ? 2 : 1); ++end) {
    const float* supports = a.supports + end * kLanes;
    F8 row[8];
    for (int lane = 0; lane < kLanes; ++lane) {
      row[lane] = load(supports + std::size_t(members[lane]) * kStride);
      for (int k = 1; k < a.members_each; ++k)
        row[lane] = max(load(supports + std::size_t(members[k * kBlock + lane]) * kStride), row[lane]);
    }
    transpose(row);
    for (int k = 0; k < 6; ++k) store(out + (end * 6 + k) * kLanes, row[k < 3 ? k : k + 1]);
  }
}

}  // namespace

void fit_leaves(const FitArguments& a, std::size_t first, std::size_t last) {
  for (std::size_t n = first; n < last; ++n) a.motion ? fit_leaf<true>(a, n) : fit_leaf<false>(a, n);
}

void fit_level(const TreeView& tree, int level, bool motion, std::size_t first, std::size_t last) {
  const int rows = kRowsOf[motion], stride = kBoxStrideOf[motion];
  const std::size_t size = std::size_t(rows * kLanes), below = std::size_t(tree.blocks[level - 1]);
  const float nowhere = kNowhere;
  for (std::size_t n = first; n < last; ++n) {
    F8 lanes[16];
    for (int k = 0; k < 16; ++k) lanes[k] = broadcast(&nowhere);
    for (int k = 0; k < rows; ++k) {
      F8 row[8];
      for (std::size_t i = 0; i < kBlock; ++i) {
        const std::size_t child = n * kBlock + i;
        row[i] =
            child < below ? load(tree.level[level - 1] + child * size + k * kLanes) : broadcast(&nowhere);
      }
      transpose(row);
      for (int i = 1; i < kLanes; ++i) row[0] = max(row[0], row[i]);
      store(tree.level[level] + n * size + k * kLanes, row[0]);
      lanes[k] = row[0];
    }
    for (int half = 0; half < stride / 8; ++half) {
      transpose(lanes + 8 * half);
      for (std::size_t i = 0; i < kBlock && n * kBlock + i < below; ++i)
        store(tree.box[level - 1] + (n * kBlock + i) * unsigned(stride) + 8 * half, lanes[8 * half + int(i)]);
    }
  }
}

void traverse(const TraverseArguments& arguments) {
  if (arguments.self)
    arguments.motion ? Traversal<true, true>(arguments).run() : Traversal<false, true>(arguments).run();
  else
    arguments.motion ? Traversal<true, false>(arguments).run() : Traversal<false, false>(arguments).run();
}

}  // namespace ONSET_KERNEL
}  // namespace onset
