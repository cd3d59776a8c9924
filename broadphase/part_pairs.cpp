#include "broadphase/part_pairs.hpp"

#include <algorithm>
#include <utility>

#include "scene/pairs/whole_scene.hpp"

namespace onset {
namespace {

class PartPairs final : public BroadPhase {
 public:
  PartPairs(std::unique_ptr<BroadPhase> all, const BroadPhaseInput& input)
      : all_(std::move(all)), whole_(input.mesh.whole) {
    ready_ = all_->ready();
  }

  const char* name() const override { return all_->name(); }
  void refit(const BroadPhaseInput& input, const Stop& stop) override {
    all_->refit(input, stop);
    ready_ = all_->ready();
  }
  bool suits(const Motion& motion) const override { return all_->suits(motion); }
  bool made_static_boxes() const override { return all_->made_static_boxes(); }
  std::size_t blocks(PairKind kind) const override { return all_->blocks(kind); }

  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    Filter filter{*whole_, kind, sink};
    all_->traverse(kind, first, last, {&filter, &Filter::consume, sink.stop});
  }

 private:
  struct Filter {
    const WholeScene& whole;
    PairKind kind;
    const PairSink& sink;
    static void consume(void* context, const IdPair* pairs, std::size_t count) {
      const Filter& filter = *static_cast<const Filter*>(context);
      IdPair decided[kBatchSize];
      const IdPair* const end = std::copy_if(pairs, pairs + count, decided, [&](const IdPair& p) {
        return is_decided_here(filter.whole, filter.kind, p.a, p.b);
      });
      if (end != decided) filter.sink(decided, std::size_t(end - decided));
    }
  };

  const std::unique_ptr<BroadPhase> all_;
  const std::shared_ptr<const WholeScene> whole_;
};

}  // namespace

std::unique_ptr<BroadPhase> pairs_of_part(std::unique_ptr<BroadPhase> all, const BroadPhaseInput& input) {
  return std::make_unique<PartPairs>(std::move(all), input);
}

}  // namespace onset
