#include "broadphase/bvh/bvh.hpp"

#include <optional>
#include <vector>

#include "base/free_list.hpp"
#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "broadphase/bvh/box_tree.hpp"
#include "broadphase/bvh/static_trees.hpp"
#include "broadphase/couples.hpp"

namespace onset {

namespace {

class Bvh final : public BroadPhase {
 public:
  Bvh(const BroadPhaseInput& input, const Stop& stop) {
    const MeshData& mesh = input.mesh;
    const PrimitiveFilter& filter = *mesh.filter;
    const bool all = filter.all;
    const bool alone = !filter.has_static();
    finite_ = input.motion.status == Outcome::free;
    if (!alone && finite_) static_ = static_trees(input, made_static_);
    const FloatMap map = static_ ? static_->map : FloatMap(input.motion);
    const auto listed = [&](const std::vector<int>& ids) { return IdList{ids.data(), ids.size()}; };
    order_ = make_vertex_order(
        input.motion, map,
        all ? IdList{nullptr, std::size_t(mesh.num_vertices)} : listed(filter.moving_vertices), stop);
    if (stop.requested()) return;
    parallel_ranges(kPrimitives.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last && !stop.requested(); ++k)
        trees_[k].emplace(mesh, kPrimitives[k],
                          !is_wanted(input, kPrimitives[k]) ? IdList{nullptr, 0}
                          : all ? IdList{nullptr, primitive_count(mesh, kPrimitives[k])}
                                : listed(filter.moving[k]),
                          order_, alone, stop);
    });
    if (stop.requested()) return;
    roughness_ = roughness(order_, input.motion);
    fit(input, map, stop);
  }

  const char* name() const override { return "bvh"; }
  bool made_static_boxes() const override { return made_static_; }

  bool suits(const Motion& motion) const override {
    return roughness(order_, motion) <= kMostRoughened * roughness_;
  }

  void refit(const BroadPhaseInput& input, const Stop& stop) override {
    finite_ = input.motion.status == Outcome::free;
    if (finite_ && input.mesh.filter->has_static()) {
      bool made = false;
      static_ = static_trees(input, made);
      made_static_ = made;
    }
    fit(input, static_ ? static_->map : FloatMap(input.motion), stop);
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
  // Two trees that are traversed together. Its blocks go from the `end` of the couple before to its own.
  struct Couple {
    const BoxTree *query, *other;
    std::size_t end;
  };

  void traverse(PairKind kind, const Couple& couple, std::size_t first, std::size_t last,
                const PairSink& sink, TraversalMemory& memory) const {
    const TreePairDecision decide(*input_, kind, *couple.query, *couple.other);
    TraverseArguments arguments = traverse_arguments(*couple.query, *couple.other, decide, sink);
    arguments.first = first, arguments.last = last;
    arguments.memory = &memory;
    bvh_kernel(input_->instruction_set).traverse(arguments);
  }

  void fit(const BroadPhaseInput& input, const FloatMap& map, const Stop& stop) {
    ready_ = false;
    input_.emplace(input);
    input_->instruction_set = resolve_instruction_set(input.instruction_set);
    const double inflation = part_inflation(input, false);
    const Supports vertices = make_supports(*input_, inflation, map, Primitive::vertex, order_.vertex.data(),
                                            order_.vertex.size(), stop);
    const std::size_t count = order_.vertex.size();
    if (input.diagonals.used)
      diagonals_.write(*input_, input.t_max, map.linear_part(), order_.vertex.data(), count, count, false,
                       stop);
    if (stop.requested()) return;
    const DiagonalRecords* diagonals = input.diagonals.used ? &diagonals_ : nullptr;
    parallel_ranges(kPrimitives.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        trees_[k]->fit(*input_, inflation, map, vertices, diagonals, stop);
    });
    if (stop.requested()) return;
    for (const PairKind kind : wanted_kinds(input)) couple(kind);
    ready_ = true;
  }

  // Lists the trees to be traversed together: never static ones with static ones.
  void couple(PairKind kind) {
    auto& couples = couples_[std::size_t(kind)];
    couples.clear();
    if (!finite_) return;
    const std::size_t a = std::size_t(first_primitive(kind)), b = std::size_t(second_primitive(kind));
    add(couples, *trees_[a], *trees_[b]);
    if (!static_) return;
    const bool motion = input_->test != BoxTest::swept;
    if (!trees_[a]->apart(*static_->trees[b], motion)) add(couples, *trees_[a], *static_->trees[b]);
    if (a != b && !static_->trees[a]->apart(*trees_[b], motion)) add(couples, *static_->trees[a], *trees_[b]);
  }
  static void add(std::vector<Couple>& couples, const BoxTree& query, const BoxTree& other) {
    if (query.units() == 0 || other.units() == 0) return;
    couples.push_back({&query, &other, blocks_of(couples) + query.units()});
  }

  static constexpr double kMostRoughened = 1.25;

  VertexOrder order_;
  double roughness_ = 0;  // of the order, when it was made
  bool finite_ = false, made_static_ = false;
  std::optional<BroadPhaseInput> input_;
  DiagonalRecords diagonals_;
  std::array<std::optional<BoxTree>, 3> trees_;
  std::shared_ptr<const StaticTrees> static_;
  std::array<std::vector<Couple>, kPairKinds> couples_;
  mutable FreeList<TraversalMemory> memory_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_bvh(const BroadPhaseInput& input, const Stop& stop) {
  return std::make_unique<Bvh>(input, stop);
}

}  // namespace onset
