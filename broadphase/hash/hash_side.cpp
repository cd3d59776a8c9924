#include "broadphase/hash/hash_side.hpp"

#include "base/parallel.hpp"

namespace onset {
namespace {

constexpr std::size_t kGrain = 4096;

FloatBox swept_box(const Supports& supports, std::size_t stride, const int* records, std::size_t count) {
  float reach[8];
  for (std::size_t k = 0; k < count; ++k) {
    const float* r = supports.records.data() + std::size_t(records[k]) * stride;
    for (std::size_t i = 0; i < 8; ++i) {
      const float x = stride == 8 ? r[i] : std::max(r[i], r[8 + i]);
      reach[i] = k == 0 ? x : std::max(reach[i], x);
    }
  }
  return {{0 - reach[0], 0 - reach[1], 0 - reach[2]}, {reach[4], reach[5], reach[6]}};
}

void number(std::vector<int>& list, std::size_t count, const Stop& stop) {
  list.resize(count);
  each_unless(stop, 0, count, [&](std::size_t i) { list[i] = int(i); });
}

}  // namespace

HashVertices::HashVertices(const BroadPhaseInput& input, const FloatMap& map, bool is_static,
                           const Stop& stop)
    : inflation(part_inflation(input, is_static)) {
  const PrimitiveFilter& filter = *input.mesh.filter;
  if (!filter.all) {
    order.vertex = is_static ? filter.static_vertices : filter.moving_vertices;
  } else if (!is_static) {
    number(order.vertex, std::size_t(input.mesh.num_vertices), stop);
  }
  order.rank.resize(std::size_t(input.mesh.num_vertices));
  if (!each_unless(stop, 0, order.vertex.size(),
                   [&](std::size_t r) { order.rank[std::size_t(order.vertex[r])] = int(r); }))
    return;
  supports =
      make_supports(input, inflation, map, Primitive::vertex, order.vertex.data(), order.vertex.size(), stop);
  const std::size_t count = order.vertex.size();
  if (input.diagonals.used)
    diagonals.write(input, input.t_max, map.linear_part(), order.vertex.data(), count, count, false, stop);
}

void HashSide::list(const BroadPhaseInput& input, const FloatMap& map, Primitive kind, bool is_static,
                    const HashVertices& vertices, const Stop& stop) {
  const PrimitiveFilter& filter = *input.mesh.filter;
  if (!is_wanted(input, kind)) {
  } else if (!filter.all) {
    ids = is_static ? filter.statics[std::size_t(kind)] : filter.moving[std::size_t(kind)];
  } else if (!is_static) {
    number(ids, primitive_count(input.mesh, kind), stop);
  }
  if (stop.requested()) return;
  const bool own = kind != Primitive::vertex && !input.mesh.thickness.empty();
  const Supports mine =
      own ? make_supports(input, vertices.inflation, map, kind, ids.data(), ids.size(), stop) : Supports{};
  const std::size_t stride = std::size_t(kBoxStrideOf[input.test != BoxTest::swept]);
  boxes.resize(ids.size());
  parallel_ranges(ids.size(), kGrain, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last, [&](std::size_t i) {
      if (own) {
        const int record = int(i);
        boxes[i] = swept_box(mine, stride, &record, 1);
        return;
      }
      std::array<int, 3> records = primitive_vertices(input.mesh, kind, ids[i]);
      for (int& v : records) v = vertices.order.rank[std::size_t(v)];
      const std::size_t each = kind == Primitive::vertex ? 1 : kind == Primitive::edge ? 2 : 3;
      boxes[i] = swept_box(vertices.supports, stride, records.data(), each);
    });
  });
}

void HashSide::lay_out(const BroadPhaseInput& input, const FloatMap& map, Primitive kind,
                       const HashVertices& vertices, const Stop& stop) {
  AlignedArray<int> in_order;
  {
    const std::vector<int> slots = cells.take_slots();
    in_order = AlignedArray<int>(slots.size());
    if (!each_unless(stop, 0, slots.size(),
                     [&](std::size_t s) { in_order[s] = slots[s] < 0 ? -1 : ids[std::size_t(slots[s])]; }))
      return;
  }
  ids = {}, boxes = {};
  tree.emplace(input.mesh, kind, std::move(in_order), vertices.order, !input.mesh.filter->has_static(), stop);
  if (!stop.requested())
    tree->fit(input, vertices.inflation, map, vertices.supports,
              input.diagonals.used ? &vertices.diagonals : nullptr, stop);
}

}  // namespace onset
