#include <array>

#include "narrowphase/at_rest/within_cube.hpp"
#include "narrowphase/exact/exact.hpp"
#include "scene/pair_source.hpp"
#include "src/shared/close_set.hpp"
#include "src/start/rest_pairs.hpp"

namespace onset {
namespace {

class Near {
 public:
  Near(const Mesh& mesh, const Motion& motion, const Options& options, const RestLimits* rest)
      : mesh_(mesh),
        motion_(motion),
        options_(options),
        rest_(rest),
        x_(4 * std::size_t(motion.num_vertices)) {
    for (int v = 0; v < motion.num_vertices; ++v)
      for (int a = 0; a < 3; ++a) x_[std::size_t(4 * v + a)] = motion.t0(v)[a];
  }

  // add_if_close leaves none out that is within its separation, Euclidean: in the maximum norm sqrt(3) times
  // as much; but for what is welded.
  void add_near(PairKind kind, const IdPair* pairs, std::size_t count, std::vector<NearPair>& found) const {
    std::vector<ClosePair> close;
    const CloseInput input{mesh_, x_.data(), 0, 0, options_, motion_.axes, rest_};
    for (std::size_t i = 0; i < count; ++i) add_if_close(input, kind, pairs[i], close);
    for (const ClosePair& p : close) {
      const double* x[4];
      for (std::size_t i = 0; i < 4; ++i) x[i] = motion_.t0(p.vertices[i]);
      const bool touches = exactly_touches({kind, {x[0], x[1], x[2], x[3]}, {x[0], x[1], x[2], x[3]}});
      if (touches || (p.separation > 0 && within(p, x))) found.push_back({p, touches});
    }
  }

 private:
  bool within(const ClosePair& p, const double* const (&x)[4]) const {
    if (options_.norm != Norm::maximum) return true;
    const double separation =
        separation_of_pair(mesh_.data(), options_, rest_, p.kind, {p.a, p.b}, p.vertices.data());
    return within_cube(p.kind, x, separation * (1 + 0x1p-50));
  }

  const Mesh& mesh_;
  const Motion& motion_;
  const Options& options_;
  const RestLimits* rest_;
  std::vector<double> x_;
};

}  // namespace

Gathered<NearPair> find_near(const Mesh& mesh, const Rest& rest, const Options& options,
                             const RestLimits* limits, std::size_t most, Budget& budget) {
  const Near near(mesh, rest.motion, options, limits);
  return gather<NearPair>(
      *rest.broad, {kStepKinds.begin(), kStepKinds.end()}, most, budget,
      [&](PairKind kind, const IdPair* pairs, std::size_t count, std::vector<NearPair>& found) {
        near.add_near(kind, pairs, count, found);
      },
      [](const NearPair& p) {
        return IdPair{p.pair.a, p.pair.b};
      });
}

}  // namespace onset
