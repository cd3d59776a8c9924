#include "broadphase/brute_force.hpp"

#include <algorithm>
#include <vector>

#include "broadphase/motion_box.hpp"
#include "broadphase/pair_batch.hpp"

namespace onset {

namespace {

constexpr std::size_t kRows = 16;  // first primitives a block

class BruteForce final : public BroadPhase {
 public:
  explicit BruteForce(const BroadPhaseInput& input) : mesh_(input.mesh) { refit(input); }

  const char* name() const override { return "brute"; }

  void refit(const BroadPhaseInput& input) override {
    test_ = input.test;
    finite_ = input.motion.status == Outcome::free;
    for (Primitive kind : {Primitive::vertex, Primitive::edge, Primitive::face})
      boxes_[std::size_t(kind)] = motion_boxes(input, kind);
  }

  std::size_t blocks(PairKind kind) const override {
    return !finite_ || boxes(second_primitive(kind)).empty()
               ? 0
               : (boxes(first_primitive(kind)).size() + kRows - 1) / kRows;
  }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    const auto &A = boxes(first_primitive(kind)), &B = boxes(second_primitive(kind));
    PairBatch batch(sink);
    for (std::size_t a = first * kRows; a < std::min(last * kRows, A.size()); ++a)
      for (std::size_t b = kind == PairKind::edge_edge ? a + 1 : 0; b < B.size(); ++b)
        if (boxes_pass(test_, A[a], B[b]) && !share_vertex(mesh_, kind, int(a), int(b)))
          batch.add(int(a), int(b));
    batch.flush();
  }

 private:
  const std::vector<MotionBox>& boxes(Primitive kind) const { return boxes_[std::size_t(kind)]; }

  const MeshData& mesh_;
  BoxTest test_ = BoxTest::motion;
  bool finite_ = true;
  std::array<std::vector<MotionBox>, 3> boxes_;
};

}  // namespace

std::unique_ptr<BroadPhase> make_brute_force(const BroadPhaseInput& input) {
  return std::make_unique<BruteForce>(input);
}

}  // namespace onset
