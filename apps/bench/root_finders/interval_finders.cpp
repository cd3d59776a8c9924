// Compiled with -frounding-math, for the intervals turn the rounding mode.
#include <boost/numeric/interval.hpp>
#include <queue>
#include <vector>

#include "bench/root_finders/finder.hpp"
#include "bench/root_finders/finder_motion.hpp"

namespace app {
namespace {

namespace bn = boost::numeric;
using Safe = bn::interval<double>;
// The rounding mode is set once for a query, as Boost's manual advises, and not at each operation.
using Interval = bn::interval_lib::unprotect<Safe>::type;
using RoundUp = Safe::traits_type::rounding;

bool holds_zero(const Interval& x) { return x.lower() <= 0 && 0 <= x.upper(); }

struct Box {
  std::array<double, 3> least{0, 0, 0}, most{1, 1, 1};  // t, u, v

  int widest() const {
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if (most[std::size_t(i)] - least[std::size_t(i)] > most[std::size_t(k)] - least[std::size_t(k)]) k = i;
    return k;
  }
  Interval side(std::size_t i) const { return {least[i], most[i]}; }
};

struct Later {
  bool operator()(const Box& x, const Box& y) const { return x.least[0] > y.least[0]; }
};

// Whether F may vanish in the box: q - u a - v b.
bool may_vanish(onset::PairKind kind, const TruthQuery& query, const Box& box) {
  const Interval t = box.side(0), u = box.side(1), v = box.side(2);
  const Relative<Interval> r = relative(kind, positions(query, t));
  for (std::size_t k = 0; k < 3; ++k)
    if (!holds_zero(r.q[k] - u * r.a[k] - v * r.b[k])) return false;
  return true;
}

bool outside(onset::PairKind kind, const Box& box) {
  return kind == onset::PairKind::vertex_face && box.least[1] + box.least[2] > 1;
}

// Whether the primitives may touch at a time in t: U and V times n.n, n = a x b.
bool may_touch(onset::PairKind kind, const Relative<Interval>& r) {
  const Vector<Interval> n = cross(r.a, r.b);
  const Interval u = dot(cross(r.q, r.b), n), v = dot(cross(r.a, r.q), n), whole = dot(n, n);
  if (u.upper() < 0 || v.upper() < 0) return false;
  if (kind == onset::PairKind::vertex_face) return (whole - u - v).upper() >= 0;
  return (whole - u).upper() >= 0 && (whole - v).upper() >= 0;
}

}  // namespace

FinderAnswer interval_multivariate(onset::PairKind kind, const TruthQuery& query,
                                   const FinderLimits& limits) {
  const RoundUp mode;
  std::priority_queue<Box, std::vector<Box>, Later> boxes;
  boxes.push({});
  for (int count = 0; !boxes.empty(); ++count) {
    const Box box = boxes.top();
    if (count == limits.boxes) return {true, box.least[0], true};
    boxes.pop();
    if (outside(kind, box) || !may_vanish(kind, query, box)) continue;
    const auto k = std::size_t(box.widest());
    if (box.most[k] - box.least[k] < limits.width) return {true, box.least[0], false};
    Box low = box, high = box;
    low.most[k] = high.least[k] = 0.5 * (box.least[k] + box.most[k]);
    boxes.push(low), boxes.push(high);
  }
  return {};
}

FinderAnswer interval_univariate(onset::PairKind kind, const TruthQuery& query, const FinderLimits& limits) {
  const RoundUp mode;
  std::vector<Interval> times{{0, 1}};  // the earliest last
  for (int count = 0; !times.empty(); ++count) {
    const Interval t = times.back();
    if (count == limits.boxes) return {true, t.lower(), true};
    times.pop_back();
    const Relative<Interval> r = relative(kind, positions(query, t));
    if (!holds_zero(dot(cross(r.a, r.b), r.q))) continue;
    if (t.upper() - t.lower() < limits.width) {
      if (may_touch(kind, r)) return {true, t.lower(), false};
      continue;
    }
    const double middle = 0.5 * (t.lower() + t.upper());
    times.emplace_back(middle, t.upper());
    times.emplace_back(t.lower(), middle);
  }
  return {};
}

}  // namespace app
