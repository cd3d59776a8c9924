#include "scene/motion/static_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "scene/motion/extents.hpp"
#include "scene/motion/motion.hpp"

namespace onset {

bool same_bits(const double* a, const double* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(double)) == 0;
}

bool StaticMotion::stands_at(const std::vector<int>& ids, const Positions& p) const {
  const std::size_t count = ids.size();
  const double* first = p.data() + ids.front() * p.row_stride();
  if (contiguous && p.row_stride() == 3 && p.col_stride() == 1) return same_bits(first, x.data(), 3 * count);
  if (contiguous && p.row_stride() == 1) {
    for (std::size_t a = 0; a < 3; ++a)
      if (!same_bits(first + std::ptrdiff_t(a) * p.col_stride(), column[a].data(), count)) return false;
    return true;
  }
  bool all = true;
  for (std::size_t k = 0; k < count; ++k)
    for (int a = 0; a < 3; ++a) {
      const double here = p(ids[k], a);
      all &= same_bits(&here, &x[3 * k + std::size_t(a)], 1);
    }
  return all;
}

AlignedArray<double> StaticMotion::take(const std::array<int, 3>& axes) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Rows& rows : kept_)
    if (rows.x.size() > 0 && rows.axes == axes) return std::exchange(rows.x, AlignedArray<double>());
  return {};
}

void StaticMotion::give_back(const std::array<int, 3>& axes, AlignedArray<double> x) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Rows& rows : kept_)
    if (rows.x.size() == 0) {
      rows = {axes, std::move(x)};
      return;
    }
  kept_[0] = {axes, std::move(x)};
}

std::shared_ptr<const StaticMotion> make_static_motion(const MeshData& mesh, const Motion& m) {
  const PrimitiveFilter& filter = *mesh.filter;
  auto still = std::make_shared<StaticMotion>();
  still->lo.fill(INFINITY), still->hi.fill(-INFINITY);
  for (int v : filter.static_ids) {
    double x[3];
    for (int a = 0; a < 3; ++a) x[m.axes[a]] = m.t0(v)[a];
    for (int a = 0; a < 3; ++a) {
      still->x.push_back(x[a]), still->column[a].push_back(x[a]);
      still->lo[a] = std::min(still->lo[a], x[a]), still->hi[a] = std::max(still->hi[a], x[a]);
    }
  }
  const std::vector<int>& ids = filter.static_ids;
  still->contiguous = ids.back() - ids.front() + 1 == int(ids.size());
  const auto edge = largest_swept(mesh.edges, &filter.statics[std::size_t(Primitive::edge)], m);
  const auto face = largest_swept(mesh.faces, &filter.statics[std::size_t(Primitive::face)], m);
  for (int a = 0; a < 3; ++a)
    still->widest_edge[m.axes[a]] = edge[a], still->widest_face[m.axes[a]] = face[a];
  return still;
}

}  // namespace onset
