#include "src/truncate/cut_motion.hpp"

#include <algorithm>
#include <numeric>

namespace onset {

LimitsOfGroups::LimitsOfGroups(const VertexGroups& groups, const std::vector<MotionLimit>& limits,
                               const Stop& stop)
    : start_(groups.size() + 1) {
  each_unless(stop, 0, limits.size(), [&](std::size_t i) {
    for (const int v : limits[i].pair.vertices)
      if (v >= 0) ++start_[std::size_t(groups.of(v)) + 1];
  });
  if (stop.requested()) return;
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  entries_.resize(start_.back());
  std::vector<std::size_t> place(start_.begin(), start_.end());
  each_unless(stop, 0, limits.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < 4 && limits[i].pair.vertices[k] >= 0; ++k)
      entries_[place[std::size_t(groups.of(limits[i].pair.vertices[k]))]++] = {std::uint32_t(i),
                                                                               std::uint8_t(k)};
  });
}

StoredVertex moved(const Motion& motion, int vertex, double s) {
  const double *x0 = motion.t0(vertex), *x1 = motion.t1(vertex);
  StoredVertex r;
  for (int a = 0; a < 3; ++a) {
    const double whole = x1[a] - x0[a];
    r.displacement[a] = s == 1 ? whole : s * whole;
    r.position[a] = s == 1 ? x1[a] : x0[a] + r.displacement[a];
  }
  return r;
}

namespace {

using Entry = LimitsOfGroups::Entry;

class Cutting {
 public:
  Cutting(const Motion& motion, const std::vector<MotionLimit>& limits, const PlaneLimits& planes,
          const Entry* first, const Entry* last)
      : motion_(motion), limits_(limits), planes_(planes), first_(first), last_(last) {}

  // The first entry whose vertex would not certainly be on its side; null: none.
  const Entry* offended(double s) const {
    for (const Entry* e = first_; e != last_; ++e) {
      const int v = vertex(*e);
      const StoredVertex at = moved(motion_, v, s);
      if (!keeps_side(*e, at.position)) return e;
      if (s != 1) continue;
      double sum[3];
      for (int a = 0; a < 3; ++a) sum[a] = motion_.t0(v)[a] + at.displacement[a];
      if (!std::equal(sum, sum + 3, at.position) && !keeps_side(*e, sum)) return e;
    }
    return nullptr;
  }

  // Until when the exact motion stays on all sides, by `roundings` times what storing can change: nearly,
  // since what is found is checked.
  Cut bound(double roundings) const {
    Cut cut;
    for (const Entry* e = first_; e != last_; ++e) {
      const PlaneLimits::Heights heights = heights_of(*e);
      const double kept = roundings * heights.rounding;
      const double from = heights.start - kept, to = heights.end - kept;
      if (!(to < 0)) continue;
      const double s = from > 0 ? from / (from - to) * (1 - 0x1p-50) : 0;
      if (s < cut.share) cut = {s, int(e->limit)};
    }
    return cut;
  }

 private:
  int vertex(const Entry& e) const { return limits_[e.limit].pair.vertices[e.place]; }
  bool is_first(const Entry& e) const { return e.place < points_of_first_side(limits_[e.limit].pair.kind); }
  bool is_of_mesh(const Entry& e) const { return limits_[e.limit].pair.kind == PairKind::vertex_plane; }
  bool keeps_side(const Entry& e, const double* x) const {
    if (is_of_mesh(e)) return planes_.keeps(limits_[e.limit], x);
    return on_side(limits_[e.limit].plane, is_first(e), x);
  }
  PlaneLimits::Heights heights_of(const Entry& e) const {
    if (is_of_mesh(e)) return planes_.heights(limits_[e.limit]);
    const DividingPlane& plane = limits_[e.limit].plane;
    const double *x0 = motion_.t0(vertex(e)), *x1 = motion_.t1(vertex(e));
    return {above(plane, is_first(e), x0), above(plane, is_first(e), x1), rounding_of_height(plane, x0, x1)};
  }
  static double above(const DividingPlane& plane, bool first, const double* x) {
    const Height h = precise_height(plane, x);
    return first ? h.lower - plane.first : plane.second - h.upper;
  }

  const Motion& motion_;
  const std::vector<MotionLimit>& limits_;
  const PlaneLimits& planes_;
  const Entry *first_, *last_;
};

}  // namespace

// Where rounding puts a vertex across its plane, one that stops short of it by that is tried next, and then
// shares that are halved: of a vertex that slides along its plane every one may do.
Cut cut_group(const Motion& motion, const std::vector<MotionLimit>& limits, const PlaneLimits& planes,
              const Entry* first, const Entry* last) {
  constexpr int kHalvings = 12;
  for (const Entry* e = first; e != last; ++e)
    if (!limits[e->limit].has_plane) return {0, int(e->limit)};
  const Cutting cutting(motion, limits, planes, first, last);
  const Entry* offended = cutting.offended(1);
  if (offended == nullptr) return {};
  Cut best = cutting.bound(0);
  for (int i = 0; i <= kHalvings; ++i) {
    if (best.limit < 0) best.limit = int(offended->limit);
    if (best.share < 1 && (offended = cutting.offended(best.share)) == nullptr) return best;
    if (i == 0) {
      if (const Cut next = cutting.bound(1); next.share > 0 && next.limit >= 0) {
        best = next;
        continue;
      }
    }
    best = {0.5 * best.share, int(offended->limit)};
  }
  return {0, best.limit};
}

}  // namespace onset
