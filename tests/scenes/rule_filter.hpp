// Which pairs the rules of a mesh leave out, written from the documentation of CollisionRules. (Welds are for
// whoever knows the positions.)
#pragma once

#include <algorithm>
#include <onset/collision_rules.hpp>
#include <vector>

namespace onset::scenes {

inline bool named(const std::vector<std::array<int, 2>>& pairs, int a, int b) {
  for (const auto& p : pairs)
    if ((p[0] == a && p[1] == b) || (p[0] == b && p[1] == a)) return true;
  return false;
}

enum class LeftOut { no, masked, both_static, same_body, adjacent, by_name, within_rings };

// How many edges lead from each vertex to each other one; points are no edges.
class EdgeDistances {
 public:
  EdgeDistances(int vertices, const std::vector<std::array<int, 2>>& edges)
      : count_(std::size_t(vertices)), all_(count_ * count_, kNever) {
    for (std::size_t v = 0; v < count_; ++v) at(v, v) = 0;
    for (const auto& e : edges)
      if (e[0] != e[1])
        at(std::size_t(e[0]), std::size_t(e[1])) = at(std::size_t(e[1]), std::size_t(e[0])) = 1;
    for (std::size_t k = 0; k < count_; ++k)
      for (std::size_t v = 0; v < count_; ++v)
        for (std::size_t w = 0; at(v, k) < kNever && w < count_; ++w)
          at(v, w) = std::min(at(v, w), at(v, k) + at(k, w));
  }
  // Whether vertices of the two primitives are at most so many edges apart.
  bool within(int rings, const std::vector<int>& A, const std::vector<int>& B) const {
    for (int v : A)
      for (int w : B)
        if (all_[std::size_t(v) * count_ + std::size_t(w)] <= rings) return true;
    return false;
  }

 private:
  static constexpr int kNever = 1 << 28;
  int& at(std::size_t v, std::size_t w) { return all_[v * count_ + w]; }
  std::size_t count_;
  std::vector<int> all_;
};

// By the vertices of both primitives; not by excluded_rings, which EdgeDistances is for.
inline LeftOut left_out(const CollisionRules& r, const std::vector<int>& A, const std::vector<int>& B) {
  std::uint32_t groups[2] = {0, 0}, masks[2] = {0, 0};
  bool all_static = true, shared = false, apart = false;
  const std::vector<int>* sides[2] = {&A, &B};
  for (int side = 0; side < 2; ++side)
    for (int v : *sides[side]) {
      groups[side] |= r.groups.empty() ? 1 : r.groups[std::size_t(v)];
      masks[side] |= r.masks.empty() ? 1 : r.masks[std::size_t(v)];
      all_static = all_static && !r.static_vertices.empty() && r.static_vertices[std::size_t(v)];
    }
  for (int v : A)
    for (int w : B) {
      shared = shared || v == w;
      apart = apart || named(r.excluded_vertices, v, w);
    }
  const int a = r.bodies.empty() ? 0 : r.bodies[std::size_t(A[0])],
            b = r.bodies.empty() ? 0 : r.bodies[std::size_t(B[0])];
  if ((groups[0] & masks[1]) == 0 || (groups[1] & masks[0]) == 0) return LeftOut::masked;
  if (all_static) return LeftOut::both_static;
  if (a == b &&
      ((!r.rigid_bodies.empty() && r.rigid_bodies[std::size_t(a)]) ||
       (!r.bodies_without_self_collision.empty() && r.bodies_without_self_collision[std::size_t(a)])))
    return LeftOut::same_body;
  if (shared) return LeftOut::adjacent;
  return apart || named(r.excluded_bodies, a, b) ? LeftOut::by_name : LeftOut::no;
}

inline bool excludes_pair(const CollisionRules& r, PairKind kind, int a, int b) {
  for (const Pair& p : r.excluded_pairs)
    if (p.kind == kind && ((p.a == a && p.b == b) || (kind == PairKind::edge_edge && p.a == b && p.b == a)))
      return true;
  return false;
}
inline bool excludes_intersection(const CollisionRules& r, int edge, int face) {
  for (const Intersection& p : r.excluded_intersections)
    if (p.edge == edge && p.face == face) return true;
  return false;
}

}  // namespace onset::scenes
