#include "onset/candidates.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/dispatch.hpp"
#include "base/parallel.hpp"
#include "src/checked_options.hpp"
#include "src/pass.hpp"

namespace onset {
namespace {

// The caller's pairs, checked and ordered, in batches.
class ListedPairs final : public PairSource {
 public:
  ListedPairs(const MeshData& mesh, const Candidates& candidates)
      : vertex_face_(checked(mesh, PairKind::vertex_face, candidates.vertex_face)),
        edge_edge_(checked(mesh, PairKind::edge_edge, candidates.edge_edge)) {}
  std::size_t blocks(PairKind kind) const override { return (of(kind).size() + kBatchSize - 1) / kBatchSize; }
  void traverse(PairKind kind, std::size_t first, std::size_t last, const PairSink& sink) const override {
    for (std::size_t block = first; block < last; ++block) {
      const std::size_t begin = block * kBatchSize, end = std::min(begin + kBatchSize, of(kind).size());
      sink(of(kind).data() + begin, end - begin);
    }
  }

 private:
  const std::vector<IdPair>& of(PairKind kind) const {
    return kind == PairKind::vertex_face ? vertex_face_ : edge_edge_;
  }
  static std::vector<IdPair> checked(const MeshData& mesh, PairKind kind,
                                     const std::vector<std::array<int, 2>>& list) {
    const bool vf = kind == PairKind::vertex_face;
    const int firsts = vf ? mesh.num_vertices : int(mesh.edges.size());
    const int seconds = int(vf ? mesh.faces.size() : mesh.edges.size());
    std::vector<IdPair> pairs;
    pairs.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      IdPair p{list[i][0], list[i][1]};
      const std::string row = (vf ? "vertex_face row " : "edge_edge row ") + std::to_string(i);
      if (p.a < 0 || p.a >= firsts || p.b < 0 || p.b >= seconds)
        throw std::invalid_argument(row + ": the mesh has no pair " + std::to_string(p.a) + ", " +
                                    std::to_string(p.b));
      if (!vf && p.a > p.b) std::swap(p.a, p.b);
      const std::array<int, 4> v = pair_vertices(mesh, kind, p);
      for (int k = vf ? 1 : 2; k < 4; ++k)
        if (v[0] == v[std::size_t(k)] || (!vf && v[1] == v[std::size_t(k)]))
          throw std::invalid_argument(row + ": the two share vertex " + std::to_string(v[std::size_t(k)]));
      pairs.push_back(p);
    }
    return pairs;
  }
  std::vector<IdPair> vertex_face_, edge_edge_;
};

StepResult step_of(const Mesh& mesh, const ListedPairs& pairs, const Positions& x_t0, const Positions& x_t1,
                   const Options& options, double keep) {
  StepResult r;
  const Clock clock;
  Budget budget(options);
  const MeshData& data = mesh.data();
  const Motion motion = make_motion(data.num_vertices, x_t0, x_t1);
  r.outcome = motion.status;
  r.vertex = motion.bad_vertex;
  r.stats.threads = current_threads();
  r.stats.kernel = kernel_name(resolve_kernel(options.kernel));
  r.stats.broad_phase = "listed";
  if (r.outcome != Outcome::free) return r;
  describe_accuracy(motion, corner_extents(data, motion, largest_separation(data, options)), options,
                    r.stats);
  const double rounding = keep > 0 ? rounding_of_distances(motion) : 0;
  const NarrowPhase narrow({data, motion, r.stats.tolerance, r.stats.extent, options, keep, rounding});
  const PassResult pass = run_pass(pairs, narrow, Keep::limiting, 1, budget);
  copy_counts(pass, r.stats);
  limit_step(mesh, pass, budget, r);
  r.stats.seconds_narrow = r.stats.seconds_total = clock.seconds();
  return r;
}

}  // namespace

StepResult compute_collision_free_stepsize(const Mesh& mesh, const Candidates& candidates,
                                           const Positions& x_t0, const Positions& x_t1,
                                           const Options& options, double keep) {
  check(options);
  if (!(keep >= 0 && keep < 1))
    throw std::invalid_argument("keep is " + std::to_string(keep) + "; it must be in [0, 1)");
  const ListedPairs pairs(mesh.data(), candidates);
  StepResult r;
  in_arena(options.threads, [&] { r = step_of(mesh, pairs, x_t0, x_t1, options, keep); });
  return r;
}

}  // namespace onset
