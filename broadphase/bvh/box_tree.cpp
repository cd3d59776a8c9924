#include "broadphase/bvh/box_tree.hpp"

#include <algorithm>
#include <utility>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"

namespace onset {

namespace {

constexpr std::size_t kGrain = 512;

int vertices_each(Primitive kind) { return kind == Primitive::vertex ? 1 : kind == Primitive::edge ? 2 : 3; }

// Says whether edges or faces need records of their own, as thickness makes their inflations differ.
bool own_supports(const BroadPhaseInput& input, Primitive kind) {
  return kind != Primitive::vertex && !input.mesh.thickness.empty();
}

}  // namespace

BoxTree::BoxTree(const MeshData& mesh, Primitive kind, const IdList& list, const VertexOrder& order,
                 bool alone, const Stop& stop)
    : kind_(kind), ids_((list.count + kBlock - 1) / kBlock * kBlock) {
  if (!order_primitives(mesh, kind, list, order, ids_.data(), stop)) return;
  std::fill(ids_.data() + list.count, ids_.data() + ids_.size(), -1);
  list_vertices(mesh, order, alone, stop);
}

BoxTree::BoxTree(const MeshData& mesh, Primitive kind, AlignedArray<int> slots, const VertexOrder& order,
                 bool alone, const Stop& stop)
    : kind_(kind), ids_(std::move(slots)) {
  list_vertices(mesh, order, alone, stop);
}

// Unused lanes refer to the record after the last, which is kNowhere.
void BoxTree::list_vertices(const MeshData& mesh, const VertexOrder& order, bool alone, const Stop& stop) {
  const std::size_t each = std::size_t(vertices_each(kind_)), slots = ids_.size();
  vertices_ = AlignedArray<int>(slots * each);
  if (!alone) names_.resize(slots * each, -1);
  parallel_ranges(slots, kGrain, [&](std::size_t first, std::size_t last) {
    each_unless(stop, first, last, [&](std::size_t slot) {
      int* out = vertices_.data() + slot / kBlock * each * kBlock + slot % kBlock;
      const bool used = ids_[slot] >= 0;
      const auto vertices = used ? primitive_vertices(mesh, kind_, ids_[slot]) : std::array<int, 3>{};
      for (std::size_t k = 0; k < each; ++k)
        out[k * kBlock] = used ? order.rank[std::size_t(vertices[k])] : int(order.vertex.size());
      if (!alone && used)
        for (std::size_t k = 0; k < each; ++k)
          names_[std::size_t(out - vertices_.data()) + k * kBlock] = vertices[k];
    });
  });
  if (mesh.filter->compares_keys && !stop.requested()) make_keys(mesh, stop);
}

// bodies_ has all levels one after the other (see TreeView). Unused lanes meet no group, and are of the body
// of the lane before, so that they keep no block from being of one body.
void BoxTree::make_keys(const MeshData& mesh, const Stop& stop) {
  const std::vector<PrimitiveKey>& all = mesh.filter->keys[std::size_t(kind_)];
  keys_.assign(3 * ids_.size(), 0), bodies_.assign(ids_.size(), 0);
  const auto put = [&](std::size_t slot) {
    if (ids_[slot] < 0) {
      if (slot % kBlock > 0) bodies_[slot] = bodies_[slot - 1];
      return;
    }
    const PrimitiveKey& key = all[std::size_t(ids_[slot])];
    int* row = keys_.data() + slot / kBlock * (3 * kBlock) + slot % kBlock;
    row[0] = key.flags, row[kBlock] = int(key.group), row[2 * kBlock] = int(key.mask);
    bodies_[slot] = key.body;
  };
  if (!each_unless(stop, 0, ids_.size(), put)) return;
  std::size_t below = 0, used = ids_.size(), levels = 1;
  do {
    const std::size_t above = bodies_.size(), blocks = (used + kBlock - 1) / kBlock;
    bodies_.resize(above + (blocks + kBlock - 1) / kBlock * kBlock, 0);
    for (std::size_t b = 0; b < blocks; ++b) {
      const int* lane = bodies_.data() + below + b * kBlock;
      const std::size_t lanes = std::min(used - b * kBlock, std::size_t(kBlock));
      bodies_[above + b] =
          std::all_of(lane, lane + lanes, [&](int body) { return body == *lane; }) ? *lane : 0;
    }
    below = above, used = blocks, ++levels;
  } while (levels < 3 || used > kBlock);
}

void BoxTree::lay_out(bool motion) {
  std::size_t total = 0, level = blocks();
  view_.levels = 0;
  do {
    view_.blocks[view_.levels++] = int(level);
    total += level;
    level = (level + kBlock - 1) / kBlock;
  } while (view_.levels < 3 || view_.blocks[view_.levels - 1] > 1);
  const std::size_t size = std::size_t(kRowsOf[motion] * kBlock), box = std::size_t(kBoxStrideOf[motion]);
  if (boxes_.size() < total * (size + box)) boxes_ = AlignedArray<float>(total * (size + box));
  float* place = boxes_.data();
  for (int l = 0; l < view_.levels; ++l) {
    view_.level[l] = place;
    place += std::size_t(view_.blocks[l]) * size;
  }
  for (int l = 0; l < view_.levels; ++l) {
    view_.box[l] = place;
    place += std::size_t(view_.blocks[l]) * box;
  }
  view_.ids = ids_.data();
  view_.vertices = names_.empty() ? vertices_.data() : names_.data();
  view_.diagonals = {diagonals_ != nullptr ? diagonals_->records.data() : nullptr, vertices_.data()};
  view_.keys = keys_.empty() ? nullptr : keys_.data();
  std::size_t first = 0;
  for (int l = 0; l < view_.levels; ++l) {
    view_.bodies[l] = bodies_.empty() ? nullptr : bodies_.data() + first;
    first += std::size_t(view_.blocks[l]) * kBlock;
  }
}

void BoxTree::fit(const BroadPhaseInput& input, double inflation, const FloatMap& map,
                  const Supports& vertices, const DiagonalRecords* diagonals, const Stop& stop) {
  inflation_ = inflation, diagonals_ = diagonals;
  if (ids_.size() == 0 || stop.requested()) return;
  const bool motion = input.test != BoxTest::swept, own = own_supports(input, kind_);
  const BvhKernel& kernel = bvh_kernel(input.instruction_set);
  std::vector<int> used, places;
  if (own) list_used(used, places, stop);
  const Supports mine =
      own ? make_supports(input, inflation, map, kind_, used.data(), used.size(), stop) : Supports{};
  if (stop.requested()) return;
  const Supports& supports = own ? mine : vertices;
  rounded_axes_ = supports.rounded_axes;
  lay_out(motion);
  const FitArguments fit{view_, motion, supports.records.data(), own ? places.data() : vertices_.data(),
                         own ? 1 : vertices_each(kind_)};
  parallel_ranges(blocks(), kGrain, [&](std::size_t first, std::size_t last) {
    for (; first < last && !stop.requested(); first += kGrain)
      kernel.fit_leaves(fit, first, std::min(first + kGrain, last));
  });
  for (int l = 1; l < view_.levels && !stop.requested(); ++l)
    parallel_ranges(std::size_t(view_.blocks[l]), kGrain, [&](std::size_t first, std::size_t last) {
      kernel.fit_level(view_, l, motion, first, last);
    });
  linear_ = motion && map.is_linear();
  for (int row = 0; linear_ && row < kRowsOf[1]; ++row) linear_ = reach(row) < FloatMap::kLargest;
}

void BoxTree::list_used(std::vector<int>& ids, std::vector<int>& places, const Stop& stop) const {
  each_unless(stop, 0, ids_.size(), [&](std::size_t slot) {
    if (ids_[slot] >= 0) ids.push_back(ids_[slot]);
  });
  int place = 0;
  each_unless(stop, 0, ids_.size(),
              [&](std::size_t slot) { places.push_back(ids_[slot] >= 0 ? place++ : int(ids.size())); });
}

float BoxTree::reach(int row) const {
  const float* lanes = view_.level[view_.levels - 1] + row * kBlock;
  return *std::max_element(lanes, lanes + kBlock);
}

// A negative sum of opposite supports means apart: see broadphase/bvh/kernel.hpp.
bool BoxTree::apart(const BoxTree& other, bool motion) const {
  if (ids_.size() == 0 || other.ids_.size() == 0) return true;
  for (int k = 0; k < 6; ++k) {
    const int opposite = (k + 3) % 6;
    if (reach(k) + other.reach(opposite) < 0 && (!motion || reach(6 + k) + other.reach(6 + opposite) < 0))
      return true;
  }
  return false;
}

Sides sides_of(PairKind kind) {
  switch (kind) {
    case PairKind::vertex_face:
      return Sides::vertices_faces;
    case PairKind::edge_edge:
      return Sides::edges_edges;
    case PairKind::vertex_edge:
      return Sides::vertices_edges;
    default:
      return Sides::edges_faces;
  }
}

TreePairDecision::TreePairDecision(const BroadPhaseInput& of, PairKind k, const BoxTree& query,
                                   const BoxTree& other)
    : OverlapDecision{of, k} {
  if (of.diagonals.used)
    limits =
        diagonal_limits(of, query.inflation() + other.inflation(), *query.diagonals(), *other.diagonals());
}

TraverseArguments traverse_arguments(const BoxTree& query, const BoxTree& other,
                                     const TreePairDecision& decide, const PairSink& sink) {
  TraverseArguments arguments{};
  arguments.query = query.view(), arguments.tree = other.view();
  arguments.test = decide.input.test;
  arguments.sides = sides_of(decide.kind);
  arguments.self = &query == &other;
  arguments.keyed = arguments.query.keys != nullptr;
  arguments.rounded_axes = query.rounded_axes() | other.rounded_axes();
  arguments.linear = query.linear() && other.linear();
  if (decide.input.diagonals.used) arguments.diagonals = &decide.limits;
  arguments.meets = TreePairDecision::meet, arguments.excluded = TreePairDecision::excluded;
  arguments.diagonals_apart = TreePairDecision::diagonals_apart;
  arguments.context = &decide;
  arguments.consume = sink.consume, arguments.consume_context = sink.context;
  arguments.stop = sink.stop.asked, arguments.stop_context = sink.stop.context;
  return arguments;
}

const BvhKernel& bvh_kernel(InstructionSet kernel) {
  static constexpr BvhKernel scalar{bvh_scalar::fit_leaves, bvh_scalar::fit_level, bvh_scalar::write_vertices,
                                    bvh_scalar::traverse};
#ifdef ONSET_HAVE_AVX2
  static constexpr BvhKernel avx2{bvh_avx2::fit_leaves, bvh_avx2::fit_level, bvh_avx2::write_vertices,
                                  bvh_avx2::traverse};
  if (runs_avx2(resolve_instruction_set(kernel))) return avx2;
#endif
  (void)kernel;
  return scalar;
}

}  // namespace onset
