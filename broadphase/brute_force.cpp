#include "broadphase/brute_force.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "broadphase/diagonals.hpp"
#include "broadphase/motion_box.hpp"
#include "scene/pair_source.hpp"

namespace onset {

namespace {

constexpr std::size_t kRows = 16;          // primitives of the first side that make a block
constexpr std::size_t kTestsALook = 4096;  // pairs between two looks at whether to stop

class BruteForce final : public BroadPhase {
 public:
  BruteForce(const BroadPhaseInput& input, const Stop& stop) : mesh_(input.mesh) { refit(input, stop); }

  const char* name() const override { return "brute"; }

  void refit(const BroadPhaseInput& input, const Stop& stop) override {
    input_.emplace(input);
    kinds_ = wanted_kinds(input);
    finite_ = input.motion.status == Outcome::free;
    ready_ = false;
    for (Primitive kind : kPrimitives)
      boxes_[std::size_t(kind)] = is_wanted(input, kind) ? motion_boxes(input, kind, stop) : MotionBoxes{};
    ready_ = !stop.requested();
  }

  std::size_t blocks(PairKind kind) const override {
    const bool wanted = std::find(kinds_.begin(), kinds_.end(), kind) != kinds_.end();
    if (!wanted || !ready_ || !finite_ || boxes(second_primitive(kind)).ids.empty()) return 0;
    return (boxes(first_primitive(kind)).ids.size() + kRows - 1) / kRows;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const MotionBoxes &A = boxes(first_primitive(kind)), &B = boxes(second_primitive(kind));
    const std::size_t rows = std::min(last * kRows, A.ids.size());
    PairBatch batch(sink);
    for (std::size_t i = first * kRows; i < rows; ++i)
      for (std::size_t j = kind == PairKind::edge_edge ? i + 1 : 0; j < B.ids.size();) {
        if (sink.stop.requested()) return;
        for (const std::size_t end = std::min(j + kTestsALook, B.ids.size()); j < end; ++j)
          if (boxes_overlap(input_->test, A.boxes[i], B.boxes[j]) &&
              may_meet(mesh_, kind, A.ids[i], B.ids[j]) &&
              !(input_->diagonals.used && diagonals_apart(*input_, kind, {A.ids[i], B.ids[j]})))
            batch.add(A.ids[i], B.ids[j]);
      }
    batch.flush();
  }

 private:
  const MotionBoxes& boxes(Primitive kind) const { return boxes_[std::size_t(kind)]; }

  const MeshData& mesh_;
  std::optional<BroadPhaseInput> input_;
  bool finite_ = true;
  std::vector<PairKind> kinds_;
  std::array<MotionBoxes, 3> boxes_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_brute_force(const BroadPhaseInput& input, const Stop& stop) {
  return std::make_unique<BruteForce>(input, stop);
}

}  // namespace onset
