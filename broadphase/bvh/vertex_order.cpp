#include "broadphase/bvh/vertex_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "broadphase/bvh/space_curve.hpp"

namespace onset {

namespace {

constexpr std::size_t kGrain = 4096;

constexpr std::ptrdiff_t kLongRun = 16;  // so many primitives of one lowest rank are sorted, as around a hub

struct RankRange {
  int lowest, highest;
};

RankRange rank_range(const MeshData& mesh, Primitive kind, const int* rank, int id) {
  if (kind == Primitive::vertex) return {rank[id], rank[id]};
  if (kind == Primitive::edge) {
    const int a = rank[mesh.edges[std::size_t(id)][0]], b = rank[mesh.edges[std::size_t(id)][1]];
    return {std::min(a, b), std::max(a, b)};
  }
  const auto& f = mesh.faces[std::size_t(id)];
  const int a = rank[f[0]], b = rank[f[1]], c = rank[f[2]];
  return {std::min(a, std::min(b, c)), std::max(a, std::max(b, c))};
}

// Sorts by highest rank, then by id.
void sort_run(const MeshData& mesh, Primitive kind, const int* rank, int* first, int* last) {
  std::vector<std::pair<int, int>> keys;
  for (const int* id = first; id != last; ++id)
    keys.emplace_back(rank_range(mesh, kind, rank, *id).highest, *id);
  std::sort(keys.begin(), keys.end());
  for (const auto& key : keys) *first++ = key.second;
}

}  // namespace

double roughness(const VertexOrder& order, const Motion& motion) {
  constexpr std::size_t kSamples = 512;
  const std::size_t count = order.vertex.size(), step = std::max<std::size_t>(1, count / kSamples);
  const auto distance = [&](std::size_t r, std::size_t q) {
    const double *x = motion.t0(order.vertex[r]), *y = motion.t0(order.vertex[q]);
    return std::fabs(x[0] - y[0]) + std::fabs(x[1] - y[1]) + std::fabs(x[2] - y[2]);
  };
  double near = 0, far = 0;
  for (std::size_t r = 0; r + 1 < count; r += step)
    near += distance(r, r + 1), far += distance(r, (r + count / 2) % count);
  return far > 0 ? near / far : 0;
}

VertexOrder make_vertex_order(const Motion& motion, const FloatMap& map, const IdList& vertices,
                              const Stop& stop) {
  const std::size_t count = vertices.count;
  std::vector<float> points(3 * count);  // twice the middle of the motion
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last, [&](std::size_t k) {
      const int v = vertices[k];
      for (std::size_t i = 0; i < 3; ++i)
        points[3 * k + i] = map(motion.t0(v)[i], i) + map(motion.t1(v)[i], i);
    });
  });
  VertexOrder result;
  result.vertex.resize(count), result.rank.resize(std::size_t(motion.num_vertices));
  if (!order_along_curve(points.data(), count, result.vertex.data(), stop)) return {};
  each_unless(stop, 0, count, [&](std::size_t r) {
    int& v = result.vertex[r];
    v = vertices[std::size_t(v)];
    result.rank[std::size_t(v)] = int(r);
  });
  return result;
}

bool order_primitives(const MeshData& mesh, Primitive kind, const IdList& list, const VertexOrder& order,
                      int* ids, const Stop& stop) {
  const std::size_t count = list.count;
  if (count == 0) return true;  // an empty list may have a null data(), which means all
  if (kind == Primitive::vertex && !list.ids) {
    std::copy(order.vertex.begin(), order.vertex.end(), ids);
    return true;
  }
  const int* rank = order.rank.data();
  AlignedArray<int> lowest(count);
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last,
                [&](std::size_t i) { lowest[i] = rank_range(mesh, kind, rank, list[i]).lowest; });
  });
  if (stop.requested()) return false;
  std::vector<int> start(order.vertex.size(), 0);
  if (!each_unless(stop, 0, count, [&](std::size_t i) { ++start[std::size_t(lowest[i])]; })) return false;
  int sum = 0;
  if (!each_unless(stop, 0, start.size(), [&](std::size_t r) { sum += std::exchange(start[r], sum); }))
    return false;
  if (!each_unless(stop, 0, count, [&](std::size_t i) { ids[start[std::size_t(lowest[i])]++] = list[i]; }))
    return false;
  return each_unless(stop, 0, start.size(), [&](std::size_t r) {
    const int first = r > 0 ? start[r - 1] : 0;  // start[r] is now where run r ends
    if (start[r] - first > kLongRun) sort_run(mesh, kind, rank, ids + first, ids + start[r]);
  });
}

}  // namespace onset
