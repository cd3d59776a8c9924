#include "broadphase/vertex_order.hpp"

#include <algorithm>
#include <numeric>

#include "base/parallel.hpp"
#include "broadphase/space_curve.hpp"

namespace onset {

namespace {

constexpr std::size_t kGrain = 4096;

// Stable, by one member of each entry, whose values lie in [0, values).
void counting_sort(const std::vector<Ranked>& from, std::vector<Ranked>& to, int Ranked::*key,
                   std::size_t values) {
  std::vector<int> start(values + 1, 0);
  for (const Ranked& r : from) ++start[std::size_t(r.*key) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (const Ranked& r : from) to[std::size_t(start[std::size_t(r.*key)]++)] = r;
}

// Of the ranks of a primitive's vertices; unused places repeat the first (primitive_vertices).
Ranked ranked(int a, int b, int c, int id) {
  const int lowest = std::min(a, std::min(b, c)), highest = std::max(a, std::max(b, c));
  return {lowest, highest, std::max(std::min(a, b), std::min(std::max(a, b), c)), id};
}

}  // namespace

VertexOrder make_vertex_order(const Motion& motion, const FloatMap& map) {
  const std::size_t count = std::size_t(motion.num_vertices);
  std::vector<float> points(3 * count);  // twice the middle of the motion
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      for (std::size_t i = 0; i < 3; ++i)
        points[3 * v + i] = map(motion.t0(int(v))[i], i) + map(motion.t1(int(v))[i], i);
  });
  VertexOrder result;
  result.vertex.resize(count), result.rank.resize(count);
  order_along_curve(points.data(), count, result.vertex.data());
  for (std::size_t r = 0; r < count; ++r) result.rank[std::size_t(result.vertex[r])] = int(r);
  return result;
}

std::vector<Ranked> order_of_primitives(const MeshData& mesh, Primitive kind, const VertexOrder& order) {
  const std::size_t count = primitive_count(mesh, kind);
  std::vector<Ranked> keys(count);
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (kind == Primitive::vertex) {
        keys[i] = {int(i), int(i), int(i), order.vertex[i]};
        continue;
      }
      const auto v = primitive_vertices(mesh, kind, int(i));
      keys[i] = ranked(order.rank[std::size_t(v[0])], order.rank[std::size_t(v[1])],
                       order.rank[std::size_t(v[2])], int(i));
    }
  });
  if (kind == Primitive::vertex) return keys;
  std::vector<Ranked> sorted(count);
  counting_sort(keys, sorted, &Ranked::highest, order.rank.size());
  counting_sort(sorted, keys, &Ranked::lowest, order.rank.size());
  return keys;
}

}  // namespace onset
