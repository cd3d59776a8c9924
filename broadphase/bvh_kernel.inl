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

// Lanes of `mask` whose boxes only touch the query's, in float, on an axis where that may be due to rounding.
template <bool kMotion>
inline int touching(int mask, int rounded_axes, const float* box, const float* block) {
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

class Output {
 public:
  explicit Output(const TraverseArguments& arguments) : arguments_(arguments) {}

  inline void add(int query, I8 ids, int mask) {
    const I8 others = compress(ids, mask), same = broadcast(query);
    int* place = &pairs_[count_].a;
    if (arguments_.self)
      store_interleaved(place, min(same, others), max(same, others));
    else
      store_interleaved(place, same, others);
    count_ += std::size_t(count_lanes(mask));
    if (count_ > kBatchSize - kLanes) flush();
  }
  void flush() {
    if (count_ > 0) arguments_.consume(arguments_.consume_context, pairs_, count_);
    count_ = 0;
  }

 private:
  const TraverseArguments& arguments_;
  std::size_t count_ = 0;
  IdPair pairs_[kBatchSize];
};

template <bool kMotion>
class Traversal {
 public:
  explicit Traversal(const TraverseArguments& arguments) : a_(arguments), output_(arguments) {}

  void run() {
    for (std::size_t q = a_.first; q < a_.last; ++q) {
      find_leaves(int(q));
      for (int i = 0; i < found_; ++i) leaf_against_leaf(int(q), leaves_[i]);
      found_ = 0;
    }
    output_.flush();
  }

 private:
  static constexpr int kRows = rows_of(kMotion);
  static constexpr int kFound = 512;

  static const float* box_of_block(const TreeView& tree, int n) {
    return tree.level[1] + std::size_t(n / kBlock) * (kRows * kLanes) + n % kBlock;
  }

  // Fills leaves_ with the leaf blocks whose box meets that of query block q.
  void find_leaves(int q) {
    float box[kRows];
    for (int k = 0; k < kRows; ++k) box[k] = box_of_block(a_.query, q)[k * kLanes];
    struct Node {
      int level, block;
    } stack[kMaxLevels * kLanes + kLanes];
    int depth = 0;
    stack[depth++] = {a_.tree.levels - 1, 0};
    while (depth > 0) {
      const Node node = stack[--depth];
      const float* block = a_.tree.level[node.level] + std::size_t(node.block) * (kRows * kLanes);
      int mask = mask_not_negative(overlap<kMotion>(box, 1, block));
      const int child = node.block * kBlock;
      if (a_.self) {  // only blocks from q on
        const int skip = (q >> 3 * (node.level - 1)) - child;
        if (skip > 0) mask &= 0xff << skip;
      }
      if (node.level > 1) {
        for (; mask != 0; mask &= mask - 1) stack[depth++] = {node.level - 1, child + lowest_lane(mask)};
      } else {
        for (; mask != 0; mask &= mask - 1) leaves_[found_++] = child + lowest_lane(mask);
        if (found_ > kFound - kLanes) {
          for (int i = 0; i < found_; ++i) leaf_against_leaf(q, leaves_[i]);
          found_ = 0;
        }
      }
    }
  }

  void leaf_against_leaf(int q, int n) {
    const float* queries = a_.query.level[0] + std::size_t(q) * (kRows * kLanes);
    const float* block = a_.tree.level[0] + std::size_t(n) * (kRows * kLanes);
    const int same = a_.self && q == n;
    int lanes = same ? 0xff : mask_not_negative(overlap<kMotion>(box_of_block(a_.tree, n), kLanes, queries));
    for (; lanes != 0; lanes &= lanes - 1) {
      const int i = lowest_lane(lanes);
      int mask = mask_not_negative(overlap<kMotion>(queries + i, kLanes, block));
      if (same) mask &= 0xfe << i;
      if (mask != 0) mask &= ~sharing(q, i, n);
      if (mask != 0 && a_.rounded_axes != 0) mask = settle(mask, q, i, n);
      if (mask != 0) output_.add(a_.query.ids[q * kBlock + i], load(a_.tree.ids + n * kBlock), mask);
    }
  }

  // Lanes of block n that share a vertex with primitive i of query block q.
  int sharing(int q, int i, int n) const {
    const int *own = a_.query.vertices + std::size_t(q) * unsigned(a_.query.vertices_each * kBlock) + i,
              *others = a_.tree.vertices + std::size_t(n) * unsigned(a_.tree.vertices_each * kBlock);
    int mask = 0;
    for (int j = 0; j < a_.query.vertices_each; ++j)
      for (int k = 0; k < a_.tree.vertices_each; ++k)
        mask |= mask_equal(broadcast(own[j * kBlock]), load(others + k * kBlock));
    return mask;
  }

  // Takes out the lanes that touch in float but not in double.
  int settle(int mask, int q, int i, int n) const {
    const float* query = a_.query.level[0] + std::size_t(q) * (kRows * kLanes) + i;
    const float* block = a_.tree.level[0] + std::size_t(n) * (kRows * kLanes);
    int open = touching<kMotion>(mask, a_.rounded_axes, query, block);
    for (; open != 0; open &= open - 1) {
      const int lane = lowest_lane(open);
      if (!a_.touches(a_.touches_context, a_.query.ids[q * kBlock + i], a_.tree.ids[n * kBlock + lane]))
        mask &= ~(1 << lane);
    }
    return mask;
  }

  const TraverseArguments& a_;
  Output output_;
  int leaves_[kFound];
  int found_ = 0;
};

template <bool kMotion>
void fit_leaf(const FitArguments& a, std::size_t n) {
  const int* members = a.members + n * unsigned(a.members_each * kBlock);
  float* out = a.tree.level[0] + n * unsigned(rows_of(kMotion) * kLanes);
  for (int end = 0; end < (kMotion ? 2 : 1); ++end) {
    F8 row[8];
    for (int lane = 0; lane < kLanes; ++lane) {
      row[lane] = load(a.supports + std::size_t(members[lane]) * kSupportStride + end * kLanes);
      for (int k = 1; k < a.members_each; ++k)
        row[lane] =
            max(row[lane],
                load(a.supports + std::size_t(members[k * kBlock + lane]) * kSupportStride + end * kLanes));
    }
    transpose(row);
    for (int k = 0; k < 6; ++k) store(out + (end * 6 + k) * kLanes, row[k]);
  }
}

}  // namespace

void fit_leaves(const FitArguments& a, std::size_t first, std::size_t last) {
  for (std::size_t n = first; n < last; ++n) a.motion ? fit_leaf<true>(a, n) : fit_leaf<false>(a, n);
}

void fit_level(const TreeView& tree, int level, bool motion, std::size_t first, std::size_t last) {
  const int rows = rows_of(motion);
  const std::size_t size = std::size_t(rows * kLanes), below = std::size_t(tree.blocks[level - 1]);
  const float nowhere = kNowhere;
  for (std::size_t n = first; n < last; ++n)
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
    }
}

void traverse(const TraverseArguments& arguments) {
  if (arguments.motion)
    Traversal<true>(arguments).run();
  else
    Traversal<false>(arguments).run();
}

}  // namespace ONSET_KERNEL
}  // namespace onset
