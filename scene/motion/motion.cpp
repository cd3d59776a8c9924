#include "scene/motion/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "base/simd/rows.hpp"
#include "scene/motion/canonical_axes.hpp"
#include "scene/pairs/whole_scene.hpp"
#include "scene/static_cache.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 4096;

void check_shape(const char* name, int num_vertices, const Positions& x, int columns = 3) {
  if (x.cols() == columns && x.rows() == num_vertices) return;
  std::string why = std::string(name) + " has " + std::to_string(x.rows()) + " rows of " +
                    std::to_string(x.cols()) + " coordinates; the mesh has " + std::to_string(num_vertices) +
                    " vertices" + (columns == 2 ? " in the plane" : "") + " and needs one row of " +
                    std::to_string(columns) + " for each";
  if (x.rows() == columns && x.cols() == num_vertices)
    why += std::string(": pass ") + name + ".transpose(), or Positions(" + name + ".data(), #V" +
           (columns == 2 ? ", 2" : "") + ") where it is column-major";
  throw std::invalid_argument(why);
}

// What is known of all positions: their extent, and the first vertex with one that is not usable.
struct Extent {
  std::array<double, 4> lo, hi;
  int bad_vertex = std::numeric_limits<int>::max();
};

// NaN is not usable.
Extent extent(const Motion& m, std::size_t first, std::size_t last) {
  Extent e;
  const D4 most = D4::all(kMaxCoordinate);
  D4 lo = D4::all(INFINITY), hi = D4::all(-INFINITY);
  const double* x = m.x.data() + first * kMotionStride;
  for (std::size_t v = first; v < last; ++v, x += kMotionStride) {
    const D4 t0 = D4::load(x), t1 = D4::load(x + 4);
    if (bits((abs(t0) <= most) & (abs(t1) <= most)) != 0xf) {
      e.bad_vertex = int(v);
      break;
    }
    lo = min(t1, min(t0, lo)), hi = max(t1, max(t0, hi));
  }
  lo.store(e.lo.data()), hi.store(e.hi.data());
  return e;
}

Extent extent(const Motion& m) {
  Extent none;
  none.lo.fill(INFINITY), none.hi.fill(-INFINITY);
  return parallel_reduce(
      std::size_t(m.num_vertices), kGrain, none,
      [&](std::size_t first, std::size_t last) { return extent(m, first, last); },
      [](Extent a, const Extent& b) {
        for (std::size_t k = 0; k < 4; ++k)
          a.lo[k] = std::min(a.lo[k], b.lo[k]), a.hi[k] = std::max(a.hi[k], b.hi[k]);
        a.bad_vertex = std::min(a.bad_vertex, b.bad_vertex);
        return a;
      });
}

std::array<int, 3> canonical_axes(const Motion& m, const Extent& e) {
  std::array<double, 3> width{e.hi[0] - e.lo[0], e.hi[1] - e.lo[1], e.hi[2] - e.lo[2]};
  if (m.in_plane) width[2] = -1;
  return widest_first(width, m.num_vertices,
                      [&](int v, int end, int a) { return (end == 0 ? m.t0(v) : m.t1(v))[a]; });
}

void store_permuted(Motion& m) {
  if (m.axes == std::array<int, 3>{0, 1, 2}) return;
  parallel_ranges(std::size_t(m.num_vertices) * 2, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      double* x = m.x.data() + 4 * i;
      const double old[3] = {x[0], x[1], x[2]};
      for (int a = 0; a < 3; ++a) x[a] = old[m.axes[a]];
    }
  });
}

}  // namespace

Outcome outcome_of_position(const double* x) {
  Outcome result = Outcome::free;
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(x[a])) return Outcome::non_finite;
    if (std::fabs(x[a]) > kMaxCoordinate) result = Outcome::out_of_range;
  }
  return result;
}

namespace {

// Finds the canonical axes from the free vertices and what is known of the others. Returns false where a
// position is not usable.
bool axes_around(const MeshData& mesh, const StaticMotion& still, const Positions& x_t0,
                 const Positions& x_t1, std::array<int, 3>& axes) {
  const PrimitiveFilter& filter = *mesh.filter;
  std::array<double, 3> width{};
  for (int a = 0; a < 3; ++a) {
    double lo = still.lo[a], hi = still.hi[a];
    for (int v : filter.free_ids)
      for (const double x : {x_t0(v, a), x_t1(v, a)}) {
        if (!(std::fabs(x) <= kMaxCoordinate)) return false;
        lo = std::min(lo, x), hi = std::max(hi, x);
      }
    width[a] = hi - lo;
  }
  if (mesh.dimension == 2) width[2] = -1;
  if (mesh.whole) {
    axes = mesh.whole->axes;
    return true;
  }
  axes = widest_first(width, int(x_t0.rows()),
                      [&](int v, int end, int a) { return end == 0 ? x_t0(v, a) : x_t1(v, a); });
  return true;
}

// Makes the motion of a mesh whose static vertices are where they were. It is empty where they are not, or a
// position is not usable: make_motion then says why.
Motion motion_around(const MeshData& mesh, std::shared_ptr<const StaticMotion> still, const Positions& x_t0,
                     const Positions& x_t1) {
  const PrimitiveFilter& filter = *mesh.filter;
  Motion m;
  m.in_plane = mesh.dimension == 2;
  if (!axes_around(mesh, *still, x_t0, x_t1, m.axes)) return {};
  if (!still->stands_at(filter.static_ids, x_t0) || !still->stands_at(filter.static_ids, x_t1)) return {};
  m.x = still->take(m.axes);
  const bool reused = m.x.size() > 0;
  if (!reused) m.x = AlignedArray<double>(std::size_t(mesh.num_vertices) * kMotionStride);
  const auto fill = [&](const std::vector<int>& ids) {
    for (int v : ids) {
      double* x = m.x.data() + std::size_t(v) * kMotionStride;
      for (int a = 0; a < 3; ++a) x[a] = x_t0(v, m.axes[a]), x[4 + a] = x_t1(v, m.axes[a]);
      x[3] = x[7] = 0;
    }
  };
  fill(filter.free_ids);
  if (!reused) fill(filter.static_ids);
  m.num_vertices = mesh.num_vertices;
  m.static_part = std::move(still);
  m.rows_last = true;
  return m;
}

void check_rows(const MeshData& mesh, const char* name, const Positions& x) {
  if (x.cols() == mesh.dimension && x.rows() != mesh.num_vertices && x.rows() == mesh.num_full_vertices)
    throw std::invalid_argument(std::string(name) + " has the " + std::to_string(x.rows()) +
                                " rows of the full mesh; the surface has " +
                                std::to_string(mesh.num_vertices) + ": pass Mesh::surface_positions(" + name +
                                ")");
  check_shape(name, mesh.num_vertices, x, mesh.dimension);
}

Motion make_motion_of(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1);

}  // namespace

Positions in_space(const MeshData& mesh, const char* name, const Positions& x) {
  check_rows(mesh, name, x);
  return mesh.dimension == 2 ? x.in_space() : x;
}

Motion make_motion(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1) {
  check_rows(mesh, "x_t0", x_t0);
  check_rows(mesh, "x_t1", x_t1);
  Motion m = mesh.dimension == 2 ? make_motion_of(mesh, x_t0.in_space(), x_t1.in_space())
                                 : make_motion_of(mesh, x_t0, x_t1);
  if (mesh.whole) m.largest_elsewhere = mesh.whole->largest_coordinate;
  return m;
}

namespace {

// x_t0 and x_t1 are checked and have three columns.
Motion make_motion_of(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1) {
  const bool cached = mesh.filter->has_static();
  auto still = cached ? mesh.static_cache->motion.get() : nullptr;
  if (still)
    if (Motion m = motion_around(mesh, still, x_t0, x_t1); m.static_part) return m;
  Motion m = make_motion(mesh.num_vertices, x_t0, x_t1, mesh.dimension == 2,
                         mesh.whole ? &mesh.whole->axes : nullptr);
  if (m.status != Outcome::free) return m;
  bool same = still != nullptr;
  for (std::size_t k = 0; k < mesh.filter->static_ids.size(); ++k) {
    const int v = mesh.filter->static_ids[k];
    for (int a = 0; a < 3; ++a) {
      if (m.t0(v)[a] != m.t1(v)[a])
        throw std::invalid_argument("vertex " + std::to_string(v) +
                                    " is static, but its positions at the two ends differ");
      same = same && same_bits(&m.t0(v)[a], &still->x[3 * k + std::size_t(m.axes[a])], 1);
    }
  }
  if (!cached) return m;
  if (!same) {
    still = make_static_motion(mesh, m);
    mesh.static_cache->motion.put(still);
  }
  m.static_part = std::move(still);
  return m;
}

}  // namespace

Motion make_motion(int num_vertices, const Positions& x_t0, const Positions& x_t1, bool in_plane,
                   const std::array<int, 3>* axes) {
  check_shape("x_t0", num_vertices, x_t0);
  check_shape("x_t1", num_vertices, x_t1);
  Motion m;
  m.num_vertices = num_vertices;
  m.in_plane = in_plane;
  m.x = AlignedArray<double>(std::size_t(num_vertices) * kMotionStride);
  parallel_ranges(num_vertices, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      double* x = m.x.data() + v * kMotionStride;
      for (int a = 0; a < 3; ++a) x[a] = x_t0(v, a), x[4 + a] = x_t1(v, a);
      x[3] = x[7] = 0;
    }
  });
  finish_motion(m, axes);
  return m;
}

void finish_motion(Motion& m, const std::array<int, 3>* axes) {
  if (m.num_vertices == 0) return;
  const Extent all = extent(m);
  if (all.bad_vertex < m.num_vertices) {
    m.bad_vertex = all.bad_vertex;
    m.status = outcome_of_position(m.t0(m.bad_vertex));
    if (m.status == Outcome::free) m.status = outcome_of_position(m.t1(m.bad_vertex));
    return;
  }
  m.axes = axes != nullptr ? *axes : canonical_axes(m, all);
  store_permuted(m);
}

bool is_seam(const Motion& m, PairKind kind, const std::array<int, 4>& vertices) {
  return any_across(points_of_first_side(kind), 4, [&](int i, int j) {
    const int v = vertices[std::size_t(i)], w = vertices[std::size_t(j)];
    return at_one_place(m.t0(v), m.t0(w)) && at_one_place(m.t1(v), m.t1(w));
  });
}

}  // namespace onset
