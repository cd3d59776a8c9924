#include "mpi/exchange/box_groups.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace onset::mpi {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A conversion errs by half a step to a neighbour, and the sum before it, in double, by far less: one step
// outward covers both.
float below(double x) { return std::nextafter(static_cast<float>(x), -kInfinity); }
float above(double x) { return std::nextafter(static_cast<float>(x), kInfinity); }

// Every third bit.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffu, x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu, x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

// The place of the middle of a box, at the start, on a Morton curve.
std::uint64_t place(const Box& box, const Box& all) {
  std::uint64_t code = 0;
  for (int a = 0; a < 3; ++a) {
    const double lo = all.lo[0][a], width = double(all.hi[0][a]) - lo;
    const double at = width > 0 ? (0.5 * (double(box.lo[0][a]) + box.hi[0][a]) - lo) / width : 0;
    code |= spread(at > 0 && at < 1 ? std::uint64_t(at * 0x1p21) : 0) << a;
  }
  return code;
}

}  // namespace

Box Box::none() {
  Box box;
  for (int end = 0; end < 2; ++end)
    for (int a = 0; a < 3; ++a) box.lo[end][a] = kInfinity, box.hi[end][a] = -kInfinity;
  return box;
}

void Box::add(const Box& other) {
  for (int end = 0; end < 2; ++end)
    for (int a = 0; a < 3; ++a) {
      lo[end][a] = std::min(lo[end][a], other.lo[end][a]);
      hi[end][a] = std::max(hi[end][a], other.hi[end][a]);
    }
}

BoxTree::BoxTree(std::vector<Box> leaves) {
  levels_[0] = std::move(leaves);
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() + kChildren - 1) / kChildren, Box::none());
    for (std::size_t i = 0; i < below.size(); ++i) above[i / kChildren].add(below[i]);
    levels_.push_back(std::move(above));
  }
}

const std::vector<Box>& BoxTree::cut(std::size_t least) const {
  std::size_t level = levels_.size() - 1;
  while (level > 0 && levels_[level].size() < least) --level;
  return levels_[level];
}

bool BoxTree::meets(const Box& box) const { return !levels_[0].empty() && meets(box, levels_.size() - 1, 0); }

bool BoxTree::meets(const Box& box, std::size_t level, std::size_t node) const {
  if (!box.meets(levels_[level][node])) return false;
  if (level == 0) return true;
  const std::size_t first = node * kChildren, last = std::min(first + kChildren, levels_[level - 1].size());
  for (std::size_t child = first; child < last; ++child)
    if (meets(box, level - 1, child)) return true;
  return false;
}

void BoxTree::each_meeting(const BoxTree& other, const std::function<void(std::size_t)>& f) const {
  if (!levels_[0].empty() && !other.leaves().empty()) descend(other, levels_.size() - 1, 0, f);
}

void BoxTree::descend(const BoxTree& other, std::size_t level, std::size_t node,
                      const std::function<void(std::size_t)>& f) const {
  if (!other.meets(levels_[level][node])) return;
  if (level == 0) return f(node);
  const std::size_t first = node * kChildren, last = std::min(first + kChildren, levels_[level - 1].size());
  for (std::size_t child = first; child < last; ++child) descend(other, level - 1, child, f);
}

template <std::size_t N>
Box OwnBoxes::box_of(const std::array<int, N>& slots) const {
  double thickest = 0;
  for (const int s : slots)
    if (!mesh_.thickness.empty()) thickest = std::max(thickest, mesh_.thickness[std::size_t(s)]);
  const double r = (inflation_ + thickest) * (1 + 0x1p-40);
  Box box = Box::none();
  for (const int s : slots)
    for (int end = 0; end < 2; ++end) {
      const double* x = end == 0 ? motion_.t0(s) : motion_.t1(s);
      for (int a = 0; a < 3; ++a) {
        box.lo[end][a] = std::min(box.lo[end][a], below(x[a] - r));
        box.hi[end][a] = std::max(box.hi[end][a], above(x[a] + r));
      }
    }
  return box;
}

Box OwnBoxes::box_of(int row) const {
  if (kind_ == Primitive::vertex) return box_of(std::array<int, 1>{row});
  return kind_ == Primitive::edge ? box_of(mesh_.own_edges[std::size_t(row)].vertices)
                                  : box_of(mesh_.own_faces[std::size_t(row)].vertices);
}

OwnBoxes::OwnBoxes(const Mesh::Impl& mesh, const Motion& motion, Primitive kind, double inflation)
    : mesh_(mesh), motion_(motion), kind_(kind), inflation_(inflation) {
  const std::vector<TakesPart>& takes_part = mesh.takes_part[std::size_t(kind)];
  Box all = Box::none();
  for (std::size_t row = 0; row < takes_part.size(); ++row)
    if (takes_part[row] != TakesPart::no) all.add(box_of(int(row)));
  std::vector<std::pair<std::uint64_t, int>> placed;
  for (std::size_t row = 0; row < takes_part.size(); ++row)
    if (takes_part[row] != TakesPart::no) placed.push_back({place(box_of(int(row)), all), int(row)});
  std::sort(placed.begin(), placed.end());
  std::vector<Box> groups((placed.size() + kGroup - 1) / kGroup, Box::none());
  rows_.reserve(placed.size());
  for (const auto& [code, row] : placed) {
    groups[rows_.size() / kGroup].add(box_of(row));
    rows_.push_back(row);
  }
  tree_ = BoxTree(std::move(groups));
}

std::optional<Primitive> partner_of(Primitive kind, int dimension, Meetings meetings) {
  if (meetings == Meetings::intersections) {
    if (kind == Primitive::vertex) return std::nullopt;
    if (dimension == 2) return kind == Primitive::edge ? std::optional(Primitive::edge) : std::nullopt;
    return kind == Primitive::edge ? Primitive::face : Primitive::edge;
  }
  if (dimension == 2) {
    if (kind == Primitive::face) return std::nullopt;
    return kind == Primitive::vertex ? Primitive::edge : Primitive::vertex;
  }
  if (kind == Primitive::edge) return Primitive::edge;
  return kind == Primitive::vertex ? Primitive::face : Primitive::vertex;
}

}  // namespace onset::mpi
