#include "src/trajectory/reach.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/parallel.hpp"
#include "scene/motion/extents.hpp"
#include "scene/motion/storing.hpp"

namespace onset {
namespace {

constexpr std::size_t kMostBoxes = 16, kGrain = 4096;

struct Box {
  std::array<double, 3> lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};
  void add(const double* x) {
    for (std::size_t a = 0; a < 3; ++a) lo[a] = std::min(lo[a], x[a]), hi[a] = std::max(hi[a], x[a]);
  }
  // A bit for each side of the box that x is beyond.
  unsigned beyond(const double* x) const {
    unsigned r = 0;
    for (std::size_t a = 0; a < 3; ++a)
      r |= unsigned(x[a] < lo[a]) << (2 * a) | unsigned(x[a] > hi[a]) << (2 * a + 1);
    return r;
  }
};

// One for each body, or for all where there are many. Primitives with vertices of several bodies are in the
// hull of these: all are then in one box.
std::vector<Box> boxes_of(const TurningScene& scene, const Motion& motion) {
  std::map<int, Box> boxes;
  for (const int v : scene.turning_vertices) {
    Box& box = boxes[scene.body[std::size_t(v)]];
    box.add(motion.t0(v)), box.add(motion.t1(v));
  }
  std::vector<Box> r;
  r.reserve(boxes.size());
  for (const auto& [body, box] : boxes) r.push_back(box);
  return r;
}

bool is_mixed(const TurningScene& scene, Primitive kind, int id) {
  const std::array<int, 3> v = primitive_vertices(*scene.pieces, kind, id);
  return std::any_of(v.begin(), v.end(),
                     [&](int w) { return scene.body[std::size_t(w)] != scene.body[std::size_t(v[0])]; });
}

// Returns whether it marked any: the primitives that are not beyond one side of a box with all vertices, at
// both ends.
bool mark(const TurningScene& scene, const Box& box, const std::vector<double>& x0,
          const std::vector<double>& x1, std::vector<unsigned char>& beyond,
          std::array<std::vector<char>, 3>& meets) {
  parallel_ranges(beyond.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      beyond[v] = static_cast<unsigned char>(box.beyond(&x0[3 * v]) & box.beyond(&x1[3 * v]));
  });
  unsigned char all = 0xff;
  for (std::size_t v = 0; v < beyond.size(); ++v)
    if (scene.body[v] == Trajectory::kLinear) all &= beyond[v];
  if (all != 0) return false;  // one side has them all beyond
  for (const Primitive kind : kPrimitives) {
    const std::vector<int>& ids = scene.others[std::size_t(kind)];
    std::vector<char>& of_kind = meets[std::size_t(kind)];
    parallel_ranges(ids.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const std::array<int, 3> v = primitive_vertices(*scene.pieces, kind, ids[i]);
        const int out = beyond[std::size_t(v[0])] & beyond[std::size_t(v[1])] & beyond[std::size_t(v[2])];
        of_kind[i] |= char(out == 0);
      }
    });
  }
  return true;
}

}  // namespace

std::array<std::vector<int>, 3> within_reach(const TurningScene& scene, const Motion& motion,
                                             const std::vector<double>& x0, const std::vector<double>& x1,
                                             double strays, double gap) {
  std::vector<Box> boxes = boxes_of(scene, motion);
  bool mixed = boxes.size() > kMostBoxes;
  Box whole;
  for (const Primitive kind : kPrimitives)
    for (const int id : scene.turning[std::size_t(kind)])
      if (is_mixed(scene, kind, id)) {  // their linear vertices are not in any box
        mixed = true;
        for (const int v : primitive_vertices(*scene.pieces, kind, id))
          if (scene.body[std::size_t(v)] == Trajectory::kLinear)
            whole.add(&x0[3 * std::size_t(v)]), whole.add(&x1[3 * std::size_t(v)]);
      }
  if (mixed) {
    for (const Box& box : boxes) whole.add(box.lo.data()), whole.add(box.hi.data());
    boxes = {whole};
  }
  double largest = 0;
  for (const double x : x0) largest = std::max(largest, std::fabs(x));
  for (const double x : x1) largest = std::max(largest, std::fabs(x));
  const double by = (strays + gap + 2 * kStoring * largest + 0x1p-1060) * (1 + 0x1p-40);
  for (Box& box : boxes)
    for (std::size_t a = 0; a < 3; ++a) {
      box.lo[a] -= by, box.hi[a] += by;
      box.lo[a] -= std::fabs(box.lo[a]) * 0x1p-50, box.hi[a] += std::fabs(box.hi[a]) * 0x1p-50;
    }
  std::array<std::vector<char>, 3> meets;
  for (const Primitive kind : kPrimitives)
    meets[std::size_t(kind)].resize(scene.others[std::size_t(kind)].size());
  std::vector<unsigned char> beyond(x0.size() / 3);
  bool any = false;
  for (const Box& box : boxes) any = mark(scene, box, x0, x1, beyond, meets) || any;
  if (!any) return {};
  std::array<std::vector<int>, 3> near;
  for (const Primitive kind : kPrimitives) {
    const std::vector<int>& ids = scene.others[std::size_t(kind)];
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (meets[std::size_t(kind)][i]) near[std::size_t(kind)].push_back(ids[i]);
  }
  return near;
}

}  // namespace onset
