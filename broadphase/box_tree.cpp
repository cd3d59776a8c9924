#include "broadphase/box_tree.hpp"

#include "base/dispatch.hpp"
#include "base/parallel.hpp"
#include "broadphase/space_curve.hpp"

namespace onset {

namespace {

constexpr std::size_t kGrain = 512;

int vertices_each(Primitive kind) { return kind == Primitive::vertex ? 1 : kind == Primitive::edge ? 2 : 3; }

// Primitives have records of their own where thickness makes their inflations differ; vertices always do.
bool own_supports(const BroadPhaseInput& input, Primitive kind) {
  return kind != Primitive::vertex && !input.mesh.thickness.empty();
}

// Twice the centre of a record's boxes, or the sum of both where there are two ends.
void centre(const float* record, bool motion, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = record[3 + i] - record[i];
  if (motion)
    for (int i = 0; i < 3; ++i) out[i] += record[kBlock + 3 + i] - record[kBlock + i];
}

}  // namespace

BoxTree::BoxTree(const BroadPhaseInput& input, const FloatMap& map, const Supports& vertices, Primitive kind)
    : kind_(kind), count_(primitive_count(input.mesh, kind)) {
  if (count_ == 0) return;
  sort(input.mesh, vertices, input.test == BoxTest::motion);
  link(input.mesh);
  refit(input, map, vertices);
}

void BoxTree::sort(const MeshData& mesh, const Supports& vertices, bool motion) {
  const int each = vertices_each(kind_);
  std::vector<float> centres(3 * count_);
  parallel_ranges(count_, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto ids = primitive_vertices(mesh, kind_, int(i));
      float* sum = &centres[3 * i];
      for (int k = 0; k < each; ++k) {
        float c[3];
        centre(vertices.record(std::size_t(ids[std::size_t(k)])), motion, c);
        for (int a = 0; a < 3; ++a) sum[a] += c[a];
      }
    }
  });
  ids_.assign(blocks() * kBlock, 0);
  order_along_curve(centres.data(), count_, ids_.data());
}

// Unused lanes refer to the record after the last.
void BoxTree::link(const MeshData& mesh) {
  const std::size_t each = std::size_t(vertices_each(kind_));
  for (std::size_t slot = count_; slot < ids_.size(); ++slot) ids_[slot] = int(count_);
  vertices_.assign(ids_.size() * each, mesh.num_vertices);
  parallel_ranges(count_, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t slot = first; slot < last; ++slot) {
      const auto ids = primitive_vertices(mesh, kind_, ids_[slot]);
      for (std::size_t k = 0; k < each; ++k)
        vertices_[(slot / kBlock * each + k) * kBlock + slot % kBlock] = ids[k];
    }
  });
}

void BoxTree::lay_out(bool motion) {
  std::size_t total = 0, level = blocks();
  view_.levels = 0;
  do {
    view_.blocks[view_.levels++] = int(level);
    total += level;
    level = (level + kBlock - 1) / kBlock;
  } while (view_.levels < 2 || view_.blocks[view_.levels - 1] > 1);
  const std::size_t size = std::size_t(rows_of(motion) * kBlock);
  if (boxes_.size() < total * size) boxes_ = AlignedArray<float>(total * size);
  float* place = boxes_.data();
  for (int l = 0; l < view_.levels; ++l) {
    view_.level[l] = place;
    place += std::size_t(view_.blocks[l]) * size;
  }
  view_.ids = ids_.data();
  view_.vertices = vertices_.data();
  view_.vertices_each = vertices_each(kind_);
}

void BoxTree::refit(const BroadPhaseInput& input, const FloatMap& map, const Supports& vertices) {
  if (count_ == 0) return;
  const bool motion = input.test == BoxTest::motion, own = own_supports(input, kind_);
  const BvhKernel& kernel = bvh_kernel(input.kernel);
  const Supports mine = own ? primitive_supports(input, map, kind_) : Supports{};
  const Supports& supports = own ? mine : vertices;
  rounded_axes_ = supports.rounded_axes;
  lay_out(motion);
  const FitArguments fit{view_, motion, supports.records.data(), own ? ids_.data() : vertices_.data(),
                         own ? 1 : vertices_each(kind_)};
  parallel_ranges(blocks(), kGrain,
                  [&](std::size_t first, std::size_t last) { kernel.fit_leaves(fit, first, last); });
  for (int l = 1; l < view_.levels; ++l)
    parallel_ranges(std::size_t(view_.blocks[l]), kGrain, [&](std::size_t first, std::size_t last) {
      kernel.fit_level(view_, l, motion, first, last);
    });
}

const BvhKernel& bvh_kernel(Kernel kernel) {
  static constexpr BvhKernel scalar{bvh_scalar::fit_leaves, bvh_scalar::fit_level, bvh_scalar::traverse};
#ifdef ONSET_HAVE_AVX2
  static constexpr BvhKernel avx2{bvh_avx2::fit_leaves, bvh_avx2::fit_level, bvh_avx2::traverse};
  if (resolve_kernel(kernel) == Kernel::avx2) return avx2;
#endif
  (void)kernel;
  return scalar;
}

}  // namespace onset
