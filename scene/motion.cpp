#include "scene/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "scene/static_cache.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 4096;

void check_shape(const char* name, int num_vertices, const Positions& x) {
  if (x.cols() == 3 && x.rows() == num_vertices) return;
  std::string why = std::string(name) + " has " + std::to_string(x.rows()) + " rows of " + std::to_string(x.cols()) +
                    " coordinates; the mesh has " + std::to_string(num_vertices) +
                    " vertices and needs one row of 3 for each";
  if (x.rows() == 3 && x.cols() == num_vertices)
    why += std::string(": pass ") + name + ".transpose(), or Positions(" + name + ".data(), #V) where it is column-major";
  throw std::invalid_argument(why);
}

// x - y without rounding: the rounded difference and what it leaves (Knuth's two-sum; no overflow within
// kMaxCoordinate).
struct Difference {
  double rounded, rest;
};
Difference exact_difference(double x, double y) {
  const double d = x - y, back = d - x;
  return {d, (x - (d - back)) - (y + back)};
}

// -1, 0, 1 as column i of the caller's positions comes before, with or after column j. The order depends only
// on exact differences of positions along an axis and not on their sign, so it commutes with exchanging axes,
// flipping them, exact translation and power-of-two scaling. Columns that tie are equal up to sign and an
// offset and may be exchanged freely; differences that are equal only when rounded are no tie.
// x(v, end, column): a coordinate of one of `vertices`.
template <class Coordinate>
int compare_columns(int vertices, const Coordinate& x, int i, int j) {
  double sign[2] = {0, 0};
  const int column[2] = {i, j};
  for (int pass = 0; pass < 2; ++pass) {  // magnitudes first, then signs relative to the first non-zero one
    for (int v = 0; v < vertices; ++v)
      for (int end = 0; end < 2; ++end) {
        Difference d[2];
        for (int k = 0; k < 2; ++k) {
          d[k] = exact_difference(x(v, end, column[k]), x(0, 0, column[k]));
          const double here = d[k].rounded > 0 ? 1 : -1;  // where it is 0, so is the rest
          if (sign[k] == 0 && d[k].rounded != 0) sign[k] = here;
          const double factor = pass == 0 ? here : sign[k];
          d[k] = {d[k].rounded * factor, d[k].rest * factor};
        }
        if (d[0].rounded != d[1].rounded) return d[0].rounded > d[1].rounded ? -1 : 1;
        if (d[0].rest != d[1].rest) return d[0].rest > d[1].rest ? -1 : 1;
      }
  }
  return 0;
}

template <class Coordinate>
std::array<int, 3> widest_first(const std::array<double, 3>& width, int vertices, const Coordinate& x) {
  std::array<int, 3> axes{0, 1, 2};
  const auto before = [&](int i, int j) {
    return width[i] != width[j] ? width[i] > width[j] : compare_columns(vertices, x, i, j) < 0;
  };
  std::stable_sort(axes.begin(), axes.end(), before);
  return axes;
}

// The widest axis first.
std::array<int, 3> canonical_axes(const Motion& m) {
  std::array<double, 3> width{};
  for (int a = 0; a < 3; ++a) {
    double lo = INFINITY, hi = -INFINITY;
    for (int v = 0; v < m.num_vertices; ++v)
      for (const double* x : {m.t0(v), m.t1(v)}) lo = std::min(lo, x[a]), hi = std::max(hi, x[a]);
    width[a] = hi - lo;
  }
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

Outcome classify(const double* x) {
  Outcome result = Outcome::free;
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(x[a])) return Outcome::non_finite;
    if (std::fabs(x[a]) > kMaxCoordinate) result = Outcome::out_of_range;
  }
  return result;
}

void find_bad_vertex(Motion& m) {
  for (int v = 0; v < m.num_vertices && m.status == Outcome::free; ++v)
    for (const double* x : {m.t0(v), m.t1(v)})
      if (const Outcome o = classify(x); o != Outcome::free && m.status == Outcome::free)
        m.status = o, m.bad_vertex = v;
}

}  // namespace

namespace {

// By their bits: zeros of different sign are told apart, so that a reused row is what was passed in.
bool same_bits(const double* a, const double* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(double)) == 0;
}

}  // namespace

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

namespace {

// Largest swept extent, per axis, over elements of N vertices: those listed, or all; rounded up.
template <std::size_t N>
std::array<double, 3> largest_swept(const std::vector<std::array<int, N>>& elements,
                                    const std::vector<int>* listed, const Motion& m) {
  std::array<double, 3> widest{};
  const std::size_t count = listed ? listed->size() : elements.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& e = elements[listed ? std::size_t((*listed)[i]) : i];
    for (int a = 0; a < 3; ++a) {
      double lo = m.t0(e[0])[a], hi = lo;
      for (int v : e) {
        lo = std::min({lo, m.t0(v)[a], m.t1(v)[a]});
        hi = std::max({hi, m.t0(v)[a], m.t1(v)[a]});
      }
      widest[a] = std::max(widest[a], hi - lo);
    }
  }
  for (double& w : widest) w *= 1 + 0x1p-52;  // hi - lo rounds to nearest: one ulp more is an upper bound
  return widest;
}

// The static part of a motion just made.
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

// The canonical axes of the scene, from the free vertices and what is known of the others; false where a
// position is not usable.
bool axes_around(const PrimitiveFilter& filter, const StaticMotion& still, const Positions& x_t0,
                 const Positions& x_t1, std::array<int, 3>& axes) {
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
  axes = widest_first(width, int(x_t0.rows()),
                      [&](int v, int end, int a) { return end == 0 ? x_t0(v, a) : x_t1(v, a); });
  return true;
}

// The motion of a mesh whose static vertices are where they were; empty where they are not, or anything else
// wants a closer look.
Motion motion_around(const MeshData& mesh, std::shared_ptr<const StaticMotion> still, const Positions& x_t0,
                     const Positions& x_t1) {
  const PrimitiveFilter& filter = *mesh.filter;
  Motion m;
  if (!axes_around(filter, *still, x_t0, x_t1, m.axes)) return {};
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
  if (x.cols() == 3 && x.rows() != mesh.num_vertices && x.rows() == mesh.num_full_vertices)
    throw std::invalid_argument(std::string(name) + " has the " + std::to_string(x.rows()) +
                                " rows of the full mesh; the surface has " +
                                std::to_string(mesh.num_vertices) + ": pass Mesh::surface_positions(" + name +
                                ")");
  check_shape(name, mesh.num_vertices, x);
}

}  // namespace

Motion make_motion(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1) {
  check_rows(mesh, "x_t0", x_t0);
  check_rows(mesh, "x_t1", x_t1);
  const bool cached = mesh.filter->has_static();
  auto still = cached ? mesh.static_cache->motion.get() : nullptr;
  if (still)
    if (Motion m = motion_around(mesh, still, x_t0, x_t1); m.static_part) return m;
  Motion m = make_motion(mesh.num_vertices, x_t0, x_t1);
  if (m.status != Outcome::free) return m;
  bool same = still != nullptr;
  for (std::size_t k = 0; k < mesh.filter->static_ids.size(); ++k) {
    const int v = mesh.filter->static_ids[k];
    for (int a = 0; a < 3; ++a) {
      if (m.t0(v)[a] != m.t1(v)[a])
        throw std::invalid_argument("vertex " + std::to_string(v) + " is static, but x_t0 and x_t1 differ");
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

Motion make_motion(int num_vertices, const Positions& x_t0, const Positions& x_t1) {
  check_shape("x_t0", num_vertices, x_t0);
  check_shape("x_t1", num_vertices, x_t1);
  Motion m;
  m.num_vertices = num_vertices;
  m.x = AlignedArray<double>(std::size_t(num_vertices) * kMotionStride);
  parallel_ranges(num_vertices, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      double* x = m.x.data() + v * kMotionStride;
      for (int a = 0; a < 3; ++a) x[a] = x_t0(v, a), x[4 + a] = x_t1(v, a);
      x[3] = x[7] = 0;
    }
  });
  finish_motion(m);
  return m;
}

void finish_motion(Motion& m) {
  find_bad_vertex(m);
  if (m.status != Outcome::free || m.num_vertices == 0) return;
  m.axes = canonical_axes(m);
  store_permuted(m);
}

bool is_seam(const Motion& m, PairKind kind, const std::array<int, 4>& vertices) {
  return any_across(points_of_first_side(kind), 4, [&](int i, int j) {
    const int v = vertices[std::size_t(i)], w = vertices[std::size_t(j)];
    return at_one_place(m.t0(v), m.t0(w)) && at_one_place(m.t1(v), m.t1(w));
  });
}

double rounding_of_distances(const Motion& m) {
  double largest = 0;
  for (int v = 0; v < m.num_vertices; ++v)
    for (const double* x : {m.t0(v), m.t1(v)})
      for (int a = 0; a < 3; ++a) largest = std::max(largest, std::fabs(x[a]));
  return (kStoring * largest + 0x1p-1070) * (1 + 0x1p-50);
}

double Extents::largest() const {
  double r = 0;
  for (int a = 0; a < 3; ++a) r = std::max({r, vertex_face[a], edge_edge[a]});
  return r;
}

Extents corner_extents(const MeshData& mesh, const Motion& m, double gap) {
  Extents r;
  const PrimitiveFilter& filter = *mesh.filter;
  const auto listed = [&](Primitive kind) { return filter.all ? nullptr : &filter.moving[std::size_t(kind)]; };
  auto edge = largest_swept(mesh.edges, listed(Primitive::edge), m);
  auto face = largest_swept(mesh.faces, listed(Primitive::face), m);
  if (filter.has_static()) {
    const auto still = m.static_part ? m.static_part : make_static_motion(mesh, m);
    for (int a = 0; a < 3; ++a) {
      edge[a] = std::max(edge[a], still->widest_edge[m.axes[a]]);
      face[a] = std::max(face[a], still->widest_face[m.axes[a]]);
    }
  }
  std::array<double, 3> moved{};
  const std::size_t vertices = filter.all ? std::size_t(m.num_vertices) : filter.moving_vertices.size();
  for (std::size_t i = 0; i < vertices; ++i) {
    const int v = filter.all ? int(i) : filter.moving_vertices[i];
    for (int a = 0; a < 3; ++a) moved[a] = std::max(moved[a], std::fabs(m.t1(v)[a] - m.t0(v)[a]));
  }
  for (int a = 0; a < 3; ++a) {  // each sum rounds twice: factor (1 + 4u)
    if (!mesh.faces.empty()) r.vertex_face[a] = (moved[a] * (1 + 0x1p-52) + face[a] + gap) * (1 + 0x1p-51);
    if (!mesh.edges.empty()) r.edge_edge[a] = (2 * edge[a] + gap) * (1 + 0x1p-51);
  }
  return r;
}

}  // namespace onset
