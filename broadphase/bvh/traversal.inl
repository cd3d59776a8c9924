// Kernel text that traverses two trees.
#pragma once

#include "base/simd/pairs.hpp"
#include "broadphase/bvh/box_overlap.inl"
#include "broadphase/diagonals/test.inl"

namespace onset {
namespace ONSET_ISA {
namespace {

// Descends two trees side by side. Every step is a loop over a list that writes the next list without
// branches, eight entries at a time. A full list is emptied downward first, so memory is constant.
template <BoxTest kTest, Sides kSides, bool kSelf, bool kKeyed>
class Traversal {
 public:
  static void run(const TraverseArguments& arguments) {
    static_assert(sizeof(Traversal) <= sizeof(TraversalMemory), "");
    (new (arguments.memory) Traversal(arguments))->run();
  }

 private:
  explicit Traversal(const TraverseArguments& arguments) : t_(arguments) {}
  static void* operator new(std::size_t, TraversalMemory* memory) { return memory; }

  void run() {
    t_.list != nullptr ? t_.list(t_.list_context, {this, &Traversal::take}) : from_the_root();
    if (stopped_) return;
    settle_doubtful();
    flush();
  }

  void from_the_root() {
    const int top = t_.tree.levels - 1;
    for (std::size_t q = t_.first; q < t_.last; ++q) {
      Pairs& start = blocks_[top];
      start.a[start.count] = int(q), start.b[start.count++] = 0;
      if (start.full()) empty_blocks(top);
    }
    for (int level = top; level >= 0; --level) empty_blocks(level);
  }

  static bool take(void* context, const BlockRun* runs, std::size_t count) {
    Traversal& t = *static_cast<Traversal*>(context);
    for (std::size_t i = 0; i < count; ++i) t.take(runs[i]);
    t.empty_blocks(0);
    return !t.stopped_;
  }

  void take(const BlockRun& run) {
    Pairs& to = blocks_[0];
    const int q = run.query, n = run.node;
    int mask = meeting(box_of(t_.query, 0, unsigned(q)), 1, block_of(t_.tree, 1, unsigned(n))) & run.lanes;
    if (kKeyed) mask &= ~within(body_of(t_.query, 0, unsigned(q)), t_.tree, 1, unsigned(n));
    to.add(I8::all(q), compress(I8::lane_numbers() + I8::all(n * kBlock), mask), mask);
    if (to.full()) empty_blocks(0);
  }

  static constexpr bool kBothEnds = kTest != BoxTest::swept, kMoving = kTest == BoxTest::moving;
  static constexpr int kRows = kRowsOf[kBothEnds];
  static constexpr int kBoxStride = kBoxStrideOf[kBothEnds];
  static constexpr bool kEdges = kSides == Sides::edges_edges;
  static constexpr int kOwn = kSides == Sides::vertices_faces || kSides == Sides::vertices_edges ? 1 : 2,
                       kOther = kEdges || kSides == Sides::vertices_edges ? 2 : 3;  // vertices of a primitive

  static const float* block_of(const TreeView& tree, int level, unsigned n) {
    return tree.level[level] + std::size_t(n) * (kRows * kLanes);
  }
  static const float* box_of(const TreeView& tree, int level, unsigned n) {
    return tree.box[level] + std::size_t(n) * kBoxStride;
  }

  struct Leaves {
    const float* boxes;
    const int *vertices, *ids;
    explicit Leaves(const TreeView& tree) : boxes(tree.level[0]), vertices(tree.vertices), ids(tree.ids) {}
    const float* block(unsigned n) const { return boxes + std::size_t(n) * (kRows * kLanes); }
    const float* box(unsigned slot) const { return block(slot / kBlock) + slot % kBlock; }
  };

  // Returns the lanes of a block that lie wholly within this body, which does not meet itself.
  static int within(int body, const TreeView& tree, int level, unsigned block) {
    const I8 bodies = I8::load(tree.bodies[level] + std::size_t(block) * kBlock);
    return sign_bits((I8::all(body) == bodies) & bodies);
  }
  // A block is a lane of the level above.
  static int body_of(const TreeView& tree, int level, unsigned block) {
    return tree.bodies[level + 1][block];
  }

  // at_start and at_end are set only for moving boxes.
  __attribute__((always_inline)) static Reach reach_of(const float* box, int stride, const float* block) {
    if constexpr (kMoving) return reach(box, stride, block);
    return {overlap<kBothEnds>(box, stride, block), F8{}, F8{}};
  }

  __attribute__((always_inline)) int meeting(const float* box, int stride, const float* block) const {
    const Reach r = reach_of(box, stride, block);
    const int mask = ~sign_bits(r.at_both) & 0xff;
    if (!kMoving || !t_.linear || (mask & sign_bits(r.at_start & r.at_end)) == 0) return mask;
    const auto direction = [&](int k) {
      const int across = opposite(k);
      return Direction{F8::all(box[across * stride]), F8::all(box[(6 + across) * stride]),
                       F8::load(block + k * kLanes), F8::load(block + (6 + k) * kLanes)};
    };
    return mask & ~moving_boxes_apart(direction).apart;
  }

  // blocks_[level] pairs blocks of `query` at level min(level, 1) with blocks of `tree` at `level`.
  void empty_blocks(int level) {
    stopped_ = stopped_ || (t_.stop != nullptr && t_.stop(t_.stop_context));
    if (!stopped_) level > 1 ? descend(level) : split(level);
    blocks_[level].count = 0;
  }

  // Tests a whole block of the query against the children of a node.
  void descend(int level) {
    const Pairs& from = blocks_[level];
    Pairs& to = blocks_[level - 1];
    for (int e = 0; e < from.count; ++e) {
      const int q = from.a[e], n = from.b[e];
      int mask = meeting(box_of(t_.query, 1, q), 1, block_of(t_.tree, level, n));
      if (kKeyed) mask &= ~within(body_of(t_.query, 1, unsigned(q)), t_.tree, level, unsigned(n));
      if (kSelf) {  // nothing before q itself: that pair was found from there
        const int skip = (q >> 3 * (level - 2)) - n * kBlock;
        mask &= 0xff << (skip > 0 ? skip : 0);
      }
      to.add(I8::all(q), compress(I8::lane_numbers() + I8::all(n * kBlock), mask), mask);
      if (to.full()) empty_blocks(level - 1);
    }
  }

  // Finds the children of block a that meet the box of block b.
  void split(int level) {
    const Pairs& from = blocks_[level];
    for (int e = 0; e < from.count; ++e) {
      const int a = from.a[e], b = from.b[e];
      int mask = meeting(box_of(t_.tree, level, b), 1, block_of(t_.query, level, a));
      if (kKeyed) mask &= ~within(body_of(t_.tree, level, unsigned(b)), t_.query, level, unsigned(a));
      children_[level].add(compress(I8::lane_numbers() + I8::all(a * kBlock), mask), I8::all(b), mask);
      if (children_[level].full()) empty_children(level);
    }
    empty_children(level);
  }

  void empty_children(int level) {
    if (!stopped_) level > 0 ? pair_children(level) : tests_diagonals() ? pass_boxes() : emit();
    children_[level].count = 0;
  }

  bool tests_diagonals() const { return kBothEnds && t_.diagonals != nullptr; }
  // Returns the lanes of block b that may pair with child c of the query, so that each unordered pair is
  // found once. (A primitive shares its vertices with itself.)
  static int unpaired(unsigned c, unsigned b) { return kSelf && c / kBlock == b ? 0xff << c % kBlock : 0xff; }

  void pair_children(int level) {
    const Pairs& from = children_[level];
    Pairs& to = blocks_[level - 1];
    for (int e = 0; e < from.count; ++e) {
      const unsigned c = unsigned(from.a[e]), b = unsigned(from.b[e]);
      const float* box = block_of(t_.query, level, c / kBlock) + c % kBlock;
      int mask = meeting(box, kLanes, block_of(t_.tree, level, b)) & unpaired(c, b);
      if (kKeyed) mask &= ~within(t_.query.bodies[level][c], t_.tree, level, b);
      to.add(I8::all(int(c)), compress(I8::lane_numbers() + I8::all(int(b * kBlock)), mask), mask);
      if (to.full()) empty_blocks(level - 1);
    }
  }

  // Returns the lanes of b that meet c by the signs of floats.
  __attribute__((always_inline)) int passing(const Leaves& query, const Leaves& tree, unsigned c, unsigned b,
                                             Reach& r) const {
    r = reach_of(query.box(c), kLanes, tree.block(b));
    I8 shared = sharing<kOwn, kOther>(query.vertices + std::size_t(c / kBlock) * (kOwn * kBlock) + c % kBlock,
                                      tree.vertices + std::size_t(b) * (kOther * kBlock));
    if (kKeyed) shared = shared | apart(c, b);
    const int mask = ~sign_bits(bits_of(r.at_both) | shared) & 0xff & unpaired(c, b);
    return kKeyed ? without_excluded(mask, c, b) : mask;
  }

  void emit() {
    const Leaves query(t_.query), tree(t_.tree);  // copies, which no write can change
    const bool rounded = t_.rounded_axes != 0;
    const Pairs& from = children_[0];
    const int items = from.count;
    IdPair* out = out_ + count_;
    for (int e = 0; e < items; ++e) {
      const unsigned c = unsigned(from.a[e]), b = unsigned(from.b[e]);
      Reach r;
      int mask = passing(query, tree, c, b, r);
      if (const int doubt = in_doubt(mask, r, rounded); doubt != 0) {
        count_ = std::size_t(out - out_);
        mask &= ~defer(c, b, doubt);
        out = out_ + count_;
      }
      const I8 others = compress(I8::load(tree.ids + b * kBlock), mask), same = I8::all(query.ids[c]);
      if (kEdges)
        store_interleaved(&out->a, min(same, others), max(same, others));
      else
        store_interleaved(&out->a, same, others);
      out += count_lanes(mask);
      if (out > out_ + (kBatchSize - kLanes)) out = flushed(out);
    }
    count_ = std::size_t(out - out_);
  }

  // Does what emit() does, but for what diagonals decide: the list is left with the items that have a lane
  // that passes, and these lanes.
  void pass_boxes() {
    const Leaves query(t_.query), tree(t_.tree);
    const bool rounded = t_.rounded_axes != 0;
    Pairs& list = children_[0];
    const int items = list.count;
    int passed = 0;
    for (int e = 0; e < items; ++e) {
      const unsigned c = unsigned(list.a[e]), b = unsigned(list.b[e]);
      Reach r;
      int mask = passing(query, tree, c, b, r);
      if (const int doubt = in_doubt(mask, r, rounded); doubt != 0) mask &= ~defer(c, b, doubt);
      list.a[passed] = int(c), list.b[passed] = int(b), passed_[passed] = mask;
      passed += mask != 0;
    }
    emit_passed(passed);
  }

  // Writes the pairs of these items that no diagonal separates.
  void emit_passed(int items) {
    const LeafDiagonals<kOwn, kOther> diagonals(t_.query.diagonals, t_.tree.diagonals, *t_.diagonals);
    const int *first_ids = t_.query.ids, *second_ids = t_.tree.ids;
    const Pairs& from = children_[0];
    IdPair* out = out_ + count_;
    for (int e = 0; e < items; ++e) {
      const unsigned c = unsigned(from.a[e]), b = unsigned(from.b[e]);
      const DiagonalSpan own = diagonals.own(c);
      const int x = first_ids[c];
      for (int lanes = passed_[e]; lanes != 0; lanes &= lanes - 1) {
        const unsigned lane = unsigned(lowest_lane(lanes));
        const F8 reach = diagonals.reach(own, b, lane);
        const DiagonalVerdict verdict = diagonals.test(reach);
        const int y = second_ids[b * kBlock + lane];
        if (verdict.in_doubt()) {
          const unsigned open = diagonals.open(c, b, lane, reach);
          if (open != 0 && t_.diagonals_apart(t_.context, x, y, open)) continue;
        }
        out->a = kEdges && y < x ? y : x, out->b = kEdges && y < x ? x : y;
        out += !verdict.apart();
      }
      if (out > out_ + (kBatchSize - kLanes)) out = flushed(out);
    }
    count_ = std::size_t(out - out_);
  }

  // Drops what diagonals separate from what is in doubt, and notes what they leave open.
  void drop_doubtful() {
    const LeafDiagonals<kOwn, kOther> diagonals(t_.query.diagonals, t_.tree.diagonals, *t_.diagonals);
    int left = 0;
    for (int i = 0; i < doubtful_.count; ++i) {
      const unsigned c = unsigned(doubtful_.a[i]), slot = unsigned(doubtful_.b[i]);
      const F8 reach = diagonals.reach(diagonals.own(c), slot / kBlock, slot % kBlock);
      const DiagonalVerdict verdict = diagonals.test(reach);
      doubtful_.a[left] = int(c), doubtful_.b[left] = int(slot);
      open_[left] = verdict.in_doubt() ? diagonals.open(c, slot / kBlock, slot % kBlock, reach) : 0;
      left += !verdict.apart();
    }
    doubtful_.count = left;
  }

  const int* key_of(unsigned slot) const {
    return t_.query.keys + std::size_t(slot / kBlock) * (3 * kBlock) + slot % kBlock;
  }

  // Sets the sign of each lane whose key cannot meet that of c: keys_meet in scene/primitive_filter.hpp,
  // without static against static, which is never traversed.
  I8 apart(unsigned c, unsigned b) const {
    const int *own = key_of(c), *keys = t_.tree.keys + std::size_t(b) * (3 * kBlock);
    const I8 bodies = I8::load(t_.tree.bodies[0] + std::size_t(b) * kBlock), none = I8::all(0);
    const I8 same_body = (I8::all(t_.query.bodies[0][c]) == bodies) & bodies;
    const I8 masked = ((I8::all(own[kBlock]) & I8::load(keys + 2 * kBlock)) == none) |
                      ((I8::all(own[2 * kBlock]) & I8::load(keys + kBlock)) == none);
    return same_body | masked;
  }

  int without_excluded(int mask, unsigned c, unsigned b) const {
    if ((key_of(c)[0] & 1) == 0) return mask;
    const int* flags = t_.tree.keys + std::size_t(b) * (3 * kBlock);
    for (int open = mask; open != 0; open &= open - 1) {
      const int lane = lowest_lane(open);
      if ((flags[lane] & 1) != 0 && t_.excluded(t_.context, t_.query.ids[c], t_.tree.ids[b * kBlock + lane]))
        mask &= ~(1 << lane);
    }
    return mask;
  }

  // Returns the lanes that signs in float may not decide: moving boxes that overlap at neither end or only
  // touch there, other boxes that touch where an axis is rounded.
  static int in_doubt(int mask, const Reach& r, bool rounded) {
    if (kMoving) return mask == 0 ? 0 : mask & bits(r.at_start <= F8::all(0)) & bits(r.at_end <= F8::all(0));
    return rounded ? mask & bits(r.at_both == F8::all(0)) : 0;
  }

  // Puts off lanes in doubt and returns them. Not inlined: the loop that calls it has no register to spare.
  __attribute__((noinline)) int defer(unsigned c, unsigned b, int doubt) {
    if (!kMoving)
      doubt &=
          touching<kBothEnds>(Leaves(t_.query).box(c), kLanes, Leaves(t_.tree).block(b), t_.rounded_axes);
    doubtful_.add(I8::all(int(c)), compress(I8::lane_numbers() + I8::all(int(b * kBlock)), doubt), doubt);
    if (doubtful_.full()) settle_doubtful();
    return doubt;
  }

  // Decides what is in doubt, eight pairs at a time in float, the rest in double.
  void settle_doubtful() {
    const Leaves query(t_.query), tree(t_.tree);
    if (tests_diagonals()) drop_doubtful();
    for (int first = 0; first < doubtful_.count; first += kLanes) {
      const int *a = doubtful_.a + first, *b = doubtful_.b + first, left = doubtful_.count - first;
      const int lanes = left < kLanes ? (1 << left) - 1 : 0xff;
      MovingBoxes p{0, 0xff};
      if (kMoving && t_.linear) p = compare(a, b, left);
      for (int open = lanes & ~p.apart; open != 0; open &= open - 1) {
        const int lane = lowest_lane(open), x = query.ids[a[lane]], y = tree.ids[b[lane]];
        if (tests_diagonals() && open_[first + lane] != 0 &&
            t_.diagonals_apart(t_.context, x, y, open_[first + lane]))
          continue;
        if ((p.unsure >> lane & 1) != 0 && !t_.meets(t_.context, x, y)) continue;
        out_[count_++] = kEdges && y < x ? IdPair{y, x} : IdPair{x, y};
        if (count_ > kBatchSize - kLanes) flush();
      }
    }
    doubtful_.count = 0;
  }

  MovingBoxes compare(const int* a, const int* b, int count) const {
    const Leaves query(t_.query), tree(t_.tree);
    const float *boxes_a[kLanes], *boxes_b[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const int from = l < count ? l : 0;
      boxes_a[l] = query.box(unsigned(a[from])), boxes_b[l] = tree.box(unsigned(b[from]));
    }
    return moving_boxes_apart(boxes_a, boxes_b);
  }

  IdPair* flushed(IdPair* out) {
    count_ = std::size_t(out - out_);
    return flush(), out_;
  }
  void flush() {
    if (count_ > 0) t_.consume(t_.consume_context, out_, count_);
    count_ = 0;
  }

  const TraverseArguments& t_;
  Pairs blocks_[kMaxLevels], children_[2], doubtful_;
  bool stopped_ = false;
  std::size_t count_ = 0;
  IdPair out_[kBatchSize];
  int passed_[kCapacity + kLanes];     // lanes of items of children_[0] that pass the boxes
  unsigned open_[kCapacity + kLanes];  // the diagonals that float leaves open, of those in doubt
};

template <BoxTest kTest, Sides kSides, bool kSelf = false>
void traverse_sides(const TraverseArguments& a) {
  a.keyed ? Traversal<kTest, kSides, kSelf, true>::run(a) : Traversal<kTest, kSides, kSelf, false>::run(a);
}

template <BoxTest kTest>
void traverse_boxes(const TraverseArguments& a) {
  if (a.sides == Sides::vertices_faces)
    traverse_sides<kTest, Sides::vertices_faces>(a);
  else if (a.sides == Sides::vertices_edges)
    traverse_sides<kTest, Sides::vertices_edges>(a);
  else if (a.self)
    traverse_sides<kTest, Sides::edges_edges, true>(a);
  else
    traverse_sides<kTest, Sides::edges_edges>(a);
}

}  // namespace

void traverse(const TraverseArguments& arguments) {
  if (arguments.sides == Sides::edges_faces)
    return traverse_sides<BoxTest::swept, Sides::edges_faces>(arguments);
  switch (arguments.test) {
    case BoxTest::swept:
      return traverse_boxes<BoxTest::swept>(arguments);
    case BoxTest::both_ends:
      return traverse_boxes<BoxTest::both_ends>(arguments);
    case BoxTest::moving:
      return traverse_boxes<BoxTest::moving>(arguments);
  }
}

}  // namespace ONSET_ISA
}  // namespace onset
