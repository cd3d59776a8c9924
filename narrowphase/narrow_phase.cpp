#include "narrowphase/narrow_phase.hpp"

#include <algorithm>
#include <cmath>

#include "base/dispatch.hpp"
#include "narrowphase/inclusion.hpp"

namespace onset {
namespace {

const KernelTable& kernels_for(Kernel requested) {
#ifdef ONSET_HAVE_AVX2
  if (resolve_kernel(requested) == Kernel::avx2) return avx2_kernels();
#endif
  (void)requested;
  return scalar_kernels();
}

double thickness_of(const MeshData& mesh, const int* first, const int* last) {
  double r = 0;
  for (; first != last; ++first) r = std::max(r, mesh.thickness[std::size_t(*first)]);
  return r;
}

}  // namespace

std::array<int, 4> pair_vertices(const MeshData& mesh, PairKind kind, IdPair p) {
  if (kind == PairKind::vertex_face) {
    const auto& f = mesh.faces[std::size_t(p.b)];
    return {p.a, f[0], f[1], f[2]};
  }
  const auto &e = mesh.edges[std::size_t(p.a)], &g = mesh.edges[std::size_t(p.b)];
  return {e[0], e[1], g[0], g[1]};
}

void NarrowPhaseStats::add(const NarrowPhaseStats& o) {
  candidates += o.candidates, after_culls += o.after_culls, inclusion += o.inclusion;
  contacts += o.contacts, budget += o.budget, checks += o.checks;
  most_checks = std::max(most_checks, o.most_checks);
  achieved_tolerance = std::max(achieved_tolerance, o.achieved_tolerance);
}

NarrowPhase::NarrowPhase(const NarrowPhaseInput& input) : in_(input), kernels_(&kernels_for(input.options.kernel)) {}

void NarrowPhase::look_up(PairKind kind, const IdPair* pairs, std::size_t count, NarrowPhaseScratch& scratch) const {
  scratch.vertices.resize(4 * count);
  scratch.separation.resize(count);
  scratch.survivors.resize(count);
  const int first_side = kind == PairKind::vertex_face ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<int, 4> v = pair_vertices(in_.mesh, kind, pairs[i]);
    std::copy(v.begin(), v.end(), scratch.vertices.begin() + std::ptrdiff_t(4 * i));
    double d = in_.options.min_separation;
    if (!in_.mesh.thickness.empty())  // two sums: rounded up
      d = (d + thickness_of(in_.mesh, v.data(), v.data() + first_side) +
           thickness_of(in_.mesh, v.data() + first_side, v.data() + 4)) *
          (1 + 0x1p-51);
    scratch.separation[i] = d;
  }
}

void NarrowPhase::process(PairKind kind, const IdPair* pairs, std::size_t count, double horizon,
                          NarrowPhaseScratch& scratch, std::vector<PairResult>& out) const {
  if (count == 0) return;
  look_up(kind, pairs, count, scratch);
  const auto* vertices = reinterpret_cast<const int(*)[4]>(scratch.vertices.data());
  const bool inclusion_only = in_.options.narrow_phase == NarrowPhaseMethod::inclusion;
  // The inclusion root finder takes over after one check, which finds the pairs that start within d and the tolerance to use.
  const KernelPairs input{in_.motion.x.data(), vertices, scratch.separation.data(), int(count), in_.tolerance, horizon,
                          in_.options.norm == Norm::maximum,
                          inclusion_only ? 1 : static_cast<long long>(in_.options.max_checks)};
  const bool vf = kind == PairKind::vertex_face;
  int survivors = int(count);
  if (inclusion_only) {
    for (int i = 0; i < survivors; ++i) scratch.survivors[std::size_t(i)] = i;
  } else {
    survivors = (vf ? kernels_->cull_vertex_face : kernels_->cull_edge_edge)(input, scratch.survivors.data());
  }
  scratch.results.resize(std::size_t(survivors));
  (vf ? kernels_->advance_vertex_face : kernels_->advance_edge_edge)(input, scratch.survivors.data(), survivors,
                                                                      scratch.results.data());
  scratch.stats.candidates += std::int64_t(count);
  scratch.stats.after_culls += survivors;
  for (int i = 0; i < survivors; ++i) {
    const int row = scratch.survivors[std::size_t(i)];
    const KernelResult& r = scratch.results[std::size_t(i)];
    scratch.stats.checks += r.checks;
    scratch.stats.most_checks = std::max<std::int64_t>(scratch.stats.most_checks, r.checks);
    if (r.verdict != Verdict::free)
      finish(kind, pairs[row], vertices[row], scratch.separation[std::size_t(row)], r, scratch.stats, out);
  }
}

void NarrowPhase::finish(PairKind kind, IdPair pair, const int (&vertices)[4], double separation,
                         const KernelResult& found, NarrowPhaseStats& stats, std::vector<PairResult>& out) const {
  PairResult r{pair, found.t, found.t, 0, Outcome::contact};
  const double d = separation / found.unit;
  double distance = found.distance;
  const bool inclusion_only = in_.options.narrow_phase == NarrowPhaseMethod::inclusion;
  const std::int64_t left = in_.options.max_checks - found.checks;
  if (found.verdict == Verdict::initial) {
    r.toi = r.step_limit = 0;
    r.outcome = Outcome::initial_contact;
  } else if (found.verdict == Verdict::stalled || (found.verdict == Verdict::budget && inclusion_only && left > 0)) {
    const Corners corners = make_corners(kind, in_.motion, vertices);
    const InclusionResult searched =
        find_first_inclusion({corners, found.t, d, found.delta, in_.options.norm == Norm::maximum, left});
    ++stats.inclusion;
    stats.checks += searched.checks;
    stats.most_checks = std::max<std::int64_t>(stats.most_checks, found.checks + searched.checks);
    if (searched.end == InclusionResult::End::free) return;
    r.toi = r.step_limit = searched.t;
    distance = searched.distance;
    if (searched.end == InclusionResult::End::budget) r.outcome = Outcome::budget;
  } else if (found.verdict == Verdict::budget) {
    r.outcome = Outcome::budget;
  }
  r.tolerance = std::max(0.0, (distance - d) * found.unit);
  stats.achieved_tolerance = std::max(stats.achieved_tolerance, r.tolerance);
  ++stats.contacts;
  stats.budget += r.outcome == Outcome::budget;
  out.push_back(r);
}

}  // namespace onset
