#include "narrowphase/narrow_phase.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/assert.hpp"
#include "narrowphase/kernel/kernels.hpp"
#include "narrowphase/pair_decision.hpp"
#include "scene/motion/storing.hpp"
#include "scene/pair_source.hpp"
#include "scene/pairs/whole_scene.hpp"

namespace onset {
namespace {

// With fewer checks a pair may be reported far from contact, where t_max could hide it.
constexpr std::int64_t kChecksForTMax = 1000;

double power_of_two_near_one_over(double x) {
  return x > 0x1p-1000 ? std::ldexp(1.0, -std::ilogb(x)) : 0x1p1000;
}

}  // namespace

void NarrowPhaseStats::add(const NarrowPhaseStats& o) {
  candidates += o.candidates, after_culls += o.after_culls, inclusion += o.inclusion;
  contacts += o.contacts, gave_up += o.gave_up, checks += o.checks;
  const auto before = [](IdPair p, IdPair q) { return p.a != q.a ? p.a < q.a : p.b < q.b; };
  if (o.most_checks > most_checks || (o.most_checks == most_checks && before(o.worst, worst)))
    most_checks = o.most_checks, worst = o.worst;
  for (std::size_t k = 0; k < histogram.size(); ++k) histogram[k] += o.histogram[k];
  achieved_tolerance = std::max(achieved_tolerance, o.achieved_tolerance);
  const auto order = [](const NarrowPhaseStats& s) {
    return std::tuple(s.least_share, s.closest.a, s.closest.b);
  };
  if (order(o) < order(*this)) least_share = o.least_share, closest = o.closest;
}

void NarrowPhaseStats::note_checks(IdPair pair, std::int64_t n) {
  ONSET_ASSERT(n >= 0);
  const int power = 63 - __builtin_clzll(static_cast<unsigned long long>(n) | 1);
  ++histogram[std::size_t(std::min(power, 15))];
  if (n < most_checks || n == 0) return;
  if (n > most_checks || pair.a < worst.a || (pair.a == worst.a && pair.b < worst.b)) worst = pair;
  most_checks = n;
}

void NarrowPhaseStats::note_outcome(const PairResult& r) {
  gave_up += r.outcome == PairOutcome::max_checks;
  achieved_tolerance = std::max(achieved_tolerance, r.tolerance);
}

NarrowPhase::NarrowPhase(const NarrowPhaseInput& input)
    : in_(input),
      kernels_(&kernels_for(input.options.instruction_set)),
      scale_(power_of_two_near_one_over(input.extent)) {
  if (input.for_many)
    rounded_ = round_positions(input.motion, scale_, input.mesh.whole ? &input.mesh.whole->middle : nullptr);
}

// 2^-45 extent covers 16 E7 <= 201u extent (docs/theory.md, L18), and the inclusion root finder's errors
// (L22).
double reported_within(double tolerance, double extent) {
  return std::max(tolerance, 0x1p-45 * extent + 0x1p-1070) * (1 + 0x1p-40);
}

bool NarrowPhase::uses_t_max() const { return in_.options.max_checks >= kChecksForTMax; }

void NarrowPhase::gather(PairKind kind, const IdPair* pairs, std::size_t count,
                         NarrowPhaseScratch& scratch) const {
  scratch.vertices.resize(4 * count);
  scratch.survivors.resize(count);
  if (kind == PairKind::vertex_face)
    for (std::size_t i = 0; i < count; ++i)
      put_vertices(in_.mesh, PairKind::vertex_face, pairs[i], &scratch.vertices[4 * i]);
  else if (kind == PairKind::edge_edge)
    for (std::size_t i = 0; i < count; ++i)
      put_vertices(in_.mesh, PairKind::edge_edge, pairs[i], &scratch.vertices[4 * i]);
  else
    for (std::size_t i = 0; i < count; ++i) put_vertices(in_.mesh, kind, pairs[i], &scratch.vertices[4 * i]);
  gather_separations(kind, pairs, count, scratch);
}

void NarrowPhase::gather_separations(PairKind kind, const IdPair* pairs, std::size_t count,
                                     NarrowPhaseScratch& scratch) const {
  scratch.separation.assign(count, in_.options.min_separation);
  if (in_.rest != nullptr || (!in_.mesh.body_separations.empty() && !in_.ignores_bodies)) {
    for (std::size_t i = 0; i < count; ++i)
      scratch.separation[i] =
          separation_of_pair(in_.mesh, in_.options, in_.rest, kind, pairs[i], &scratch.vertices[4 * i]);
    return;
  }
  const int first_side = points_of_first_side(kind);
  if (in_.straying != nullptr) {  // five sums: rounded up
    for (std::size_t i = 0; i < count; ++i) {
      double& sum = scratch.separation[i];
      const int *v = &scratch.vertices[4 * i], *middle = v + first_side, *end = v + 4;
      for (const std::vector<double>* of : {&in_.straying->thickness, &in_.straying->bounds})
        sum += largest_of(*of, v, middle) + largest_of(*of, middle, end);
      sum *= 1 + 0x1p-50;
    }
    return;
  }
  if (in_.mesh.thickness.empty()) return;
  for (std::size_t i = 0; i < count; ++i) {
    const int* v = &scratch.vertices[4 * i];
    scratch.separation[i] = with_thickness(in_.options.min_separation, thickest(in_.mesh, v, v + first_side),
                                           thickest(in_.mesh, v + first_side, v + 4));
  }
}

KernelPairs NarrowPhase::prepare(PairKind kind, const IdPair* pairs, std::size_t count, TMax t_max,
                                 NarrowPhaseScratch& scratch) const {
  gather(kind, pairs, count, scratch);
  // The inclusion root finder takes over after one check, which fixes the tolerance and finds pairs that
  // start within d.
  const bool inclusion_only = in_.inclusion_only();
  return {in_.motion.x.data(),
          rounded_.data(),
          reinterpret_cast<const int(*)[4]>(scratch.vertices.data()),
          scratch.separation.data(),
          int(count),
          scale_,
          inclusion_only ? in_.tolerance : kSharpness * in_.tolerance,
          inclusion_only ? 2 : kSharpest,
          reported_within(in_.tolerance, in_.extent),
          in_.gap_share,
          in_.stored ? kStoring : 0,
          in_.stored ? kStoredRoundings * in_.rounding : 0,
          uses_t_max() ? std::min(t_max.culls, 1.0) : 1,
          uses_t_max() ? std::min(t_max.advancement, 1.0) : 1,
          in_.options.norm == Norm::maximum,
          inclusion_only ? 1 : static_cast<long long>(in_.options.max_checks),
          kind == PairKind::vertex_edge};
}

int NarrowPhase::cull(PairKind kind, const KernelPairs& input, NarrowPhaseScratch& scratch) const {
  if (in_.inclusion_only()) {
    for (int i = 0; i < input.count; ++i) scratch.survivors[std::size_t(i)] = i;
    return input.count;
  }
  return kernels_->of_kind[int(kind)].cull(input, scratch.survivors.data());
}

void NarrowPhase::cull(PairKind kind, const IdPair* pairs, std::size_t count, NarrowPhaseScratch& scratch,
                       std::vector<IdPair>& out) const {
  const int survivors = cull(kind, prepare(kind, pairs, count, {}, scratch), scratch);
  for (int i = 0; i < survivors; ++i) out.push_back(pairs[scratch.survivors[std::size_t(i)]]);
}

void NarrowPhase::process(PairKind kind, const IdPair* pairs, std::size_t count, TMax t_max,
                          NarrowPhaseScratch& scratch, std::vector<PairResult>& out) const {
  if (count == 0) return;
  ONSET_ASSERT(count <= kBatchSize);
  const KernelPairs input = prepare(kind, pairs, count, t_max, scratch);
  const int survivors = cull(kind, input, scratch);
  ONSET_ASSERT(survivors >= 0 && survivors <= input.count);
  scratch.results.resize(std::size_t(survivors));
  const KernelsOfKind& kernels = kernels_->of_kind[int(kind)];
  kernels.advance(input, scratch.survivors.data(), survivors, nullptr, scratch.results.data());
  if (in_.stored) {
    advance_exactly(kind, input, survivors, scratch);
  } else if (in_.options.exactness != Exactness::conservative) {
    kernels.certify(input, scratch.survivors.data(), survivors, scratch.results.data());
  }
  scratch.stats.candidates += std::int64_t(count);
  scratch.stats.after_culls += survivors;
  for (int i = 0; i < survivors; ++i) {
    const int row = scratch.survivors[std::size_t(i)];
    KernelResult& r = scratch.results[std::size_t(i)];
    if (in_.inclusion_only()) r.checks = 0;  // its checks are boxes
    const std::int64_t before = scratch.stats.checks;
    scratch.stats.checks += r.checks;
    if (r.verdict != Verdict::free || (in_.stored && scratch.touches[std::size_t(i)])) {
      PairDecision decision({in_, kernels, input, row, kind, pairs[row]}, scratch.stats);
      const std::optional<PairResult> found = in_.stored ? decision.stored_step(r) : decision.contact(r);
      if (found) out.push_back(*found);
    }
    scratch.stats.note_checks(pairs[row], scratch.stats.checks - before);
  }
}

// Asks the exact motion, too, which can differ within the tolerance. A pair that is free after its first
// check is so with a smaller demand from the same look.
void NarrowPhase::advance_exactly(PairKind kind, const KernelPairs& input, int survivors,
                                  NarrowPhaseScratch& scratch) const {
  scratch.touches.assign(std::size_t(survivors), 0);
  scratch.asked.clear();
  scratch.places.clear();
  for (int i = 0; i < survivors; ++i) {
    const KernelResult& r = scratch.results[std::size_t(i)];
    if (r.verdict != Verdict::free || r.checks <= 1) continue;
    scratch.asked.push_back(scratch.survivors[std::size_t(i)]);
    scratch.places.push_back(i);
  }
  if (scratch.asked.empty()) return;
  scratch.exact_results.resize(scratch.asked.size());
  kernels_->of_kind[int(kind)].advance(without_storing(input, input.t_max), scratch.asked.data(),
                                       int(scratch.asked.size()), nullptr, scratch.exact_results.data());
  for (std::size_t k = 0; k < scratch.asked.size(); ++k)
    scratch.touches[std::size_t(scratch.places[k])] = scratch.exact_results[k].verdict != Verdict::free;
}

void NarrowPhase::sharpen(PairKind kind, PairResult& result) const {
  NarrowPhaseScratch scratch;
  const KernelPairs one = prepare(kind, &result.pair, 1, {}, scratch);
  PairDecision({in_, kernels_->of_kind[int(kind)], one, 0, kind, result.pair}, scratch.stats).sharpen(result);
}

}  // namespace onset
