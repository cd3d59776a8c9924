#include "broadphase/hash/block_pairs.hpp"

#include <algorithm>

namespace onset {
namespace {

constexpr int kShort = 4 * kBlock;  // so many blocks go to the kernel without a search
constexpr int kLevelBits = 3;       // a block of a level is eight of that below
static_assert(1 << kLevelBits == kBlock, "");

class Lister {
 public:
  Lister(const BlockPairs& pairs, const BlockRunSink& sink)
      : p_(pairs), asking_(pairs.asking.tree->view()), asked_(pairs.asked.tree->view()), sink_(sink) {}

  void run() {
    const CellOrder &asking = p_.asking.cells, &asked = p_.asked.cells;
    const std::size_t end = std::min(p_.last * kBlock, asking.blocks());
    for (std::size_t q = p_.first * kBlock; q < end && going_; ++q) {
      const int level = asking.level(q);
      // what is of one level asks one way only
      asked.each_run(asking.box(q), p_.query_asks ? level : level + 1, [&](int of, int first, int last) {
        if (p_.self && of == level) first = std::max(first, int(q));
        last - first > kShort ? search(int(q), first, last) : add(int(q), first, last);
      });
      if (q % kBlock == kBlock - 1) flush();
    }
    flush();
  }

 private:
  // Adds the blocks in [first, last) that are in nodes that meet q.
  void search(int q, int first, int last) {
    int level = 1;  // the last one is not among TreeView::box
    while (level < asked_.levels - 2 && 1 << kLevelBits * level < last - first) ++level;
    descend(q, first, last, level);
  }
  void descend(int q, int first, int last, int level) {
    const int bits = kLevelBits * level;
    for (int node = first >> bits; node <= (last - 1) >> bits && going_; ++node) {
      if (++looks_ % kLooks == 0) flush();
      if (apart(q, level, node)) continue;
      const int from = std::max(first, node << bits), to = std::min(last, (node + 1) << bits);
      level > 1 ? descend(q, from, to, level - 1) : add(q, from, to);
    }
  }
  // A negative sum of opposite supports means apart, of motion boxes one at each end
  // (broadphase/bvh/kernel.hpp).
  bool apart(int q, int level, int node) const {
    const int stride = kBoxStrideOf[p_.motion], ends = p_.motion ? 6 : 0;
    const float* a = asking_.box[0] + std::ptrdiff_t(q) * stride;
    const float* b = asked_.box[level] + std::ptrdiff_t(node) * stride;
    for (int k = 0; k < 6; ++k) {
      const int opposite = (k + 3) % 6;
      if (a[k] + b[opposite] < 0 && a[ends + k] + b[ends + opposite] < 0) return true;
    }
    return false;
  }

  void add(int q, int first, int last) { p_.query_asks ? add_run(q, first, last) : add_each(q, first, last); }
  void add_run(int q, int first, int last) {
    while (first < last) {
      const int node = first / kBlock, end = std::min(last, (node + 1) * kBlock);
      add({q, node, ((1 << (end - first)) - 1) << first % kBlock});
      first = end;
    }
  }
  void add_each(int q, int first, int last) {
    for (; first < last && going_; ++first) add({first, q / kBlock, 1 << q % kBlock});
  }
  void add(const BlockRun& run) {
    if (count_ == kRuns) flush();
    runs_[count_++] = run;
  }
  void flush() {
    going_ = going_ && sink_.take(sink_.context, runs_, count_);
    count_ = 0;
  }

  // A full list, or so many nodes looked at, are as good as a question whether to go on.
  static constexpr std::size_t kRuns = 128, kLooks = 1024;
  const BlockPairs& p_;
  const TreeView &asking_, &asked_;
  const BlockRunSink& sink_;
  bool going_ = true;
  std::size_t count_ = 0, looks_ = 0;
  BlockRun runs_[kRuns];
};

}  // namespace

void BlockPairs::list(const void* context, const BlockRunSink& sink) {
  Lister(*static_cast<const BlockPairs*>(context), sink).run();
}

}  // namespace onset
