#include "broadphase/hash/spatial_hash.hpp"

#include <algorithm>

#include "base/free_list.hpp"
#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "broadphase/couples.hpp"
#include "broadphase/hash/block_pairs.hpp"
#include "broadphase/hash/cell_width.hpp"
#include "broadphase/hash/hash_side.hpp"

namespace onset {
namespace {

constexpr std::size_t kSidesEach = 2;  // of a kind of primitives: those that move, those that are static
constexpr std::size_t kSides = kSidesEach * kPrimitives.size();
// Blocks have so many lanes a primitive at most, so their boxes take up to three times as much memory as
// those of a tree; else cells are made wider. The power of two doubles each time: seven sorts more reach the
// widest.
constexpr std::size_t kMostLanesEach = 3, kLanesFree = 1024;
constexpr int kWider = 2;

class SpatialHash final : public BroadPhase {
 public:
  SpatialHash(const BroadPhaseInput& input, const Stop& stop) { refit(input, stop); }

  const char* name() const override { return "hash"; }
  bool suits(const Motion&) const override { return true; }  // each refit sorts anew

  void refit(const BroadPhaseInput& input, const Stop& stop) override {
    ready_ = false;
    for (auto& couples : couples_) couples.clear();
    input_.emplace(input);
    input_->instruction_set = resolve_instruction_set(input.instruction_set);
    if (input.motion.status == Outcome::free && !make_sides(stop)) return;
    for (const PairKind kind : wanted_kinds(input))
      if (input.motion.status == Outcome::free) couple(kind);
    ready_ = !stop.requested();
  }

  std::size_t blocks(PairKind kind) const override {
    return ready_ ? blocks_of(couples_[std::size_t(kind)]) : 0;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const FreeList<TraversalMemory>::Loan memory(memory_);
    each_couple(couples_[std::size_t(kind)], first, last,
                [&](const Couple& couple, std::size_t from, std::size_t to) {
                  traverse(kind, couple, from, to, sink, *memory);
                });
  }

 private:
  // Two sides, of which one asks the other for what is of its own level or above, or above.
  struct Couple {
    const HashSide *query, *other;
    bool query_asks;
    std::size_t end;
  };

  HashSide& side(Primitive kind, bool is_static) {
    return sides_[kSidesEach * std::size_t(kind) + is_static];
  }

  bool make_sides(const Stop& stop) {
    const BroadPhaseInput& input = *input_;
    sides_ = {}, vertices_ = {};  // before there are new ones
    const FloatMap map(input.motion);
    const std::size_t parts = input.mesh.filter->has_static() ? 2 : 1;
    for (std::size_t part = 0; part < parts && !stop.requested(); ++part)
      vertices_[part] = HashVertices(input, map, part == 1, stop);
    if (stop.requested()) return false;
    const auto each = [&](auto&& f) {
      parallel_ranges(kSides, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !stop.requested(); ++i)
          if (i % kSidesEach < parts) f(sides_[i], kPrimitives[i / kSidesEach], i % kSidesEach);
      });
    };
    each([&](HashSide& s, Primitive kind, std::size_t part) {
      s.list(input, map, kind, part == 1, vertices_[part], stop);
    });
    std::vector<const std::vector<FloatBox>*> boxes;
    for (const HashSide& s : sides_) boxes.push_back(&s.boxes);
    int exponent = cell_exponent(boxes, stop);
    for (int wider = kWider;; wider *= 2) {
      if (stop.requested()) return false;
      const CellUnits units(exponent);
      each([&](HashSide& s, Primitive, std::size_t) { s.cells = CellOrder(s.boxes, units, stop); });
      if (!wasteful() || exponent >= CellUnits::kMostExponent) break;
      exponent = std::min(exponent + wider, CellUnits::kMostExponent);
    }
    each([&](HashSide& s, Primitive kind, std::size_t part) {
      s.lay_out(input, map, kind, vertices_[part], stop);
    });
    for (HashVertices& v : vertices_) v.order = {}, v.supports = {};  // what only the trees were made from
    return !stop.requested();
  }

  bool wasteful() const {
    std::size_t lanes = 0, used = 0;
    for (const HashSide& s : sides_) lanes += s.cells.slots().size(), used += s.boxes.size();
    return lanes > kMostLanesEach * used + kLanesFree;
  }

  // Lists the sides to be asked: never static ones with static ones.
  void couple(PairKind kind) {
    const Primitive a = first_primitive(kind), b = second_primitive(kind);
    auto& couples = couples_[std::size_t(kind)];
    add(couples, side(a, false), side(b, false));
    if (!input_->mesh.filter->has_static()) return;
    add(couples, side(a, false), side(b, true));
    if (a != b) add(couples, side(a, true), side(b, false));
  }
  void add(std::vector<Couple>& couples, const HashSide& query, const HashSide& other) {
    if (query.cells.blocks() == 0 || other.cells.blocks() == 0) return;
    if (&query != &other && query.tree->apart(*other.tree, input_->test != BoxTest::swept)) return;
    couples.push_back({&query, &other, true, blocks_of(couples) + query.tree->units()});
    if (&query != &other)
      couples.push_back({&query, &other, false, blocks_of(couples) + other.tree->units()});
  }

  void traverse(PairKind kind, const Couple& couple, std::size_t first, std::size_t last,
                const PairSink& sink, TraversalMemory& memory) const {
    const bool self = couple.query == couple.other;
    const HashSide &asking = couple.query_asks ? *couple.query : *couple.other,
                   &asked = couple.query_asks ? *couple.other : *couple.query;
    const BlockPairs ask{asking, asked, couple.query_asks, self, input_->test != BoxTest::swept, first, last};
    const TreePairDecision decide(*input_, kind, *couple.query->tree, *couple.other->tree);
    TraverseArguments arguments = traverse_arguments(*couple.query->tree, *couple.other->tree, decide, sink);
    arguments.list = BlockPairs::list, arguments.list_context = &ask;
    arguments.memory = &memory;
    bvh_kernel(input_->instruction_set).traverse(arguments);
  }

  std::optional<BroadPhaseInput> input_;
  std::array<HashVertices, kSidesEach> vertices_;
  std::array<HashSide, kSides> sides_;
  std::array<std::vector<Couple>, kPairKinds> couples_;
  mutable FreeList<TraversalMemory> memory_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_spatial_hash(const BroadPhaseInput& input, const Stop& stop) {
  return std::make_unique<SpatialHash>(input, stop);
}

}  // namespace onset
