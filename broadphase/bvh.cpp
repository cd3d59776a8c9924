#include "broadphase/bvh.hpp"

#include <optional>

#include "base/dispatch.hpp"
#include "base/parallel.hpp"
#include "broadphase/box_tree.hpp"

namespace onset {

namespace {

constexpr std::array<Primitive, 3> kKinds{Primitive::vertex, Primitive::edge, Primitive::face};

class Bvh final : public BroadPhase {
 public:
  explicit Bvh(const BroadPhaseInput& input) {
    const FloatMap map(input.motion);
    order_ = make_vertex_order(input.motion, map);
    parallel_ranges(kKinds.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) trees_[k].emplace(input.mesh, kKinds[k], order_);
    });
    fit(input, map);
  }

  const char* name() const override { return "bvh"; }

  void refit(const BroadPhaseInput& input) override { fit(input, FloatMap(input.motion)); }

  std::size_t blocks(PairKind kind) const override {
    const bool finite = input_->motion.status == Outcome::free;
    return finite && tree(second_primitive(kind)).units() > 0 ? tree(first_primitive(kind)).units() : 0;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const BoxTree &query = tree(first_primitive(kind)), &other = tree(second_primitive(kind));
    const Touch touch{*input_, kind};
    TraverseArguments arguments{};
    arguments.query = query.view(), arguments.tree = other.view();
    arguments.motion = input_->test == BoxTest::motion;
    arguments.self = kind == PairKind::edge_edge;
    arguments.rounded_axes = query.rounded_axes() | other.rounded_axes();
    arguments.first = first, arguments.last = last;
    arguments.touches = Touch::decide, arguments.touches_context = &touch;
    arguments.consume = sink.consume, arguments.consume_context = sink.context;
    bvh_kernel(input_->kernel).traverse(arguments);
  }

 private:
  struct Touch {
    const BroadPhaseInput& input;
    PairKind kind;
    static bool decide(const void* context, int a, int b) {
      const Touch& t = *static_cast<const Touch*>(context);
      return boxes_pass(t.input.test, motion_box(t.input, first_primitive(t.kind), a),
                        motion_box(t.input, second_primitive(t.kind), b));
    }
  };

  void fit(const BroadPhaseInput& input, const FloatMap& map) {
    input_.emplace(input);
    input_->kernel = resolve_kernel(input.kernel);
    const Supports vertices =
        make_supports(*input_, map, Primitive::vertex, order_.vertex.data(), order_.vertex.size());
    parallel_ranges(kKinds.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) trees_[k]->fit(*input_, map, vertices);
    });
  }

  const BoxTree& tree(Primitive kind) const { return *trees_[std::size_t(kind)]; }

  VertexOrder order_;
  std::optional<BroadPhaseInput> input_;
  std::array<std::optional<BoxTree>, 3> trees_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_bvh(const BroadPhaseInput& input) { return std::make_unique<Bvh>(input); }

}  // namespace onset
