#include "scene/motion/extents.hpp"

#include <cmath>

#include "base/parallel.hpp"
#include "base/simd/rows.hpp"
#include "scene/pairs/whole_scene.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 4096;

// A row of a motion: x, y, z and padding.
D4 swept_by(const Motion& m, const int* first, const int* last) {
  D4 lo = D4::load(m.t0(*first)), hi = lo;
  const auto widen = [&](const double* x) { lo = min(D4::load(x), lo), hi = max(D4::load(x), hi); };
  widen(m.t1(*first));
  for (++first; first != last; ++first) widen(m.t0(*first)), widen(m.t1(*first));
  return hi - lo;
}

using Row = std::array<double, 4>;

// The largest of of(i), i < count, >= 0.
template <class F>
Row largest_row(std::size_t count, const F& of) {
  const auto of_range = [&](std::size_t first, std::size_t last) {
    D4 widest = D4::all(0);
    for (std::size_t i = first; i < last; ++i) widest = max(of(i), widest);
    Row r;
    widest.store(r.data());
    return r;
  };
  return parallel_reduce(count, kGrain, Row{}, of_range, [](Row r, const Row& s) {
    for (std::size_t a = 0; a < 4; ++a) r[a] = std::max(r[a], s[a]);
    return r;
  });
}

template <std::size_t N>
std::array<double, 3> largest_swept_of(const std::vector<std::array<int, N>>& elements,
                                       const std::vector<int>* listed, const Motion& m) {
  const auto of = [&](const std::array<int, N>& e) { return swept_by(m, e.data(), e.data() + N); };
  const Row r = listed ? largest_row(listed->size(),
                                     [&](std::size_t i) { return of(elements[std::size_t((*listed)[i])]); })
                       : largest_row(elements.size(), [&](std::size_t i) { return of(elements[i]); });
  constexpr double kUp = 1 + 0x1p-52;  // hi - lo was rounded to nearest
  return {r[0] * kUp, r[1] * kUp, r[2] * kUp};
}

D4 moved(const Motion& m, int v) { return abs(D4::load(m.t1(v)) - D4::load(m.t0(v))); }

}  // namespace

std::array<double, 3> largest_swept(const std::vector<std::array<int, 2>>& edges,
                                    const std::vector<int>* listed, const Motion& m) {
  return largest_swept_of(edges, listed, m);
}
std::array<double, 3> largest_swept(const std::vector<std::array<int, 3>>& faces,
                                    const std::vector<int>* listed, const Motion& m) {
  return largest_swept_of(faces, listed, m);
}

double Extents::largest() const {
  double r = 0;
  for (int a = 0; a < 3; ++a) r = std::max(r, largest(a));
  return r;
}
double Extents::largest(int a) const { return std::max({vertex_face[a], edge_edge[a], vertex_edge[a]}); }

Extents corner_extents(const MeshData& mesh, const Motion& m, double gap) {
  Extents r;
  const PrimitiveFilter& filter = *mesh.filter;
  const auto listed = [&](Primitive kind) {
    return filter.all ? nullptr : &filter.moving[std::size_t(kind)];
  };
  auto edge = largest_swept(mesh.edges, listed(Primitive::edge), m);
  auto face = largest_swept(mesh.faces, listed(Primitive::face), m);
  if (filter.has_static()) {
    const auto still = m.static_part ? m.static_part : make_static_motion(mesh, m);
    for (int a = 0; a < 3; ++a) {
      edge[a] = std::max(edge[a], still->widest_edge[m.axes[a]]);
      face[a] = std::max(face[a], still->widest_face[m.axes[a]]);
    }
  }
  const std::vector<int>& some = filter.moving_vertices;
  Row far = filter.all
                ? largest_row(std::size_t(m.num_vertices), [&](std::size_t v) { return moved(m, int(v)); })
                : largest_row(some.size(), [&](std::size_t i) { return moved(m, some[i]); });
  bool has_faces = !mesh.faces.empty(), has_edges = !mesh.edges.empty();
  if (const WholeScene* whole = mesh.whole.get()) {
    has_faces = whole->has_faces, has_edges = whole->has_edges;
    // A part cannot tell which of its primitives have no partner anywhere: what it measures may be more.
    edge = whole->widest_edge, face = whole->widest_face;
    for (std::size_t a = 0; a < 3; ++a) far[a] = whole->moved[a];
  }
  for (std::size_t a = 0; a < 3; ++a) {  // each sum rounds twice: factor 1 + 4u
    if (has_faces) r.vertex_face[a] = (far[a] * (1 + 0x1p-52) + face[a] + gap) * (1 + 0x1p-51);
    if (mesh.dimension == 2)
      r.vertex_edge[a] = (far[a] * (1 + 0x1p-52) + edge[a] + gap) * (1 + 0x1p-51);
    else if (has_edges)
      r.edge_edge[a] = (2 * edge[a] + gap) * (1 + 0x1p-51);
  }
  return r;
}

}  // namespace onset
