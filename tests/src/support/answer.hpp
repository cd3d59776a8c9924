// An answer of any call, down to one number that differs where a byte of it does: nothing is allocated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <onset/onset.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace onset::tests {

// The bytes of all that is added, hashed as FNV-1a hashes bytes, eight at a time. Statistics and seconds are
// left out.
class Answer {
 public:
  std::uint64_t hash() const { return hash_; }
  bool operator==(const Answer& other) const { return hash_ == other.hash_; }
  bool operator!=(const Answer& other) const { return hash_ != other.hash_; }

  // Of the last result that has them: how its call ended, and the step.
  std::optional<Outcome> outcome;
  std::optional<double> step;

  template <class... T>
  Answer& add(const T&... values) {
    (add_one(values), ...);
    return *this;
  }

 private:
  template <class T>
  std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>> add_one(T value) {
    static_assert(sizeof value <= sizeof(std::uint64_t));
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof value);
    hash_ = (hash_ ^ bits) * 0x100000001b3u;
    hash_ ^= hash_ >> 29;
  }
  template <class T, std::size_t N>
  void add_one(const std::array<T, N>& values) {
    for (const T& value : values) add_one(value);
  }
  template <class T>
  void add_one(const std::vector<T>& values) {
    add_one(values.size());
    for (const T& value : values) add_one(value);
  }
  void add_one(const std::vector<bool>& values) {
    add_one(values.size());
    for (const bool value : values) add_one(value);
  }
  template <class T>
  void add_one(const std::optional<T>& value) {
    add_one(value.has_value());
    if (value) add_one(*value);
  }
  template <class Derived>
  void add_one(const Eigen::DenseBase<Derived>& m) {
    add_one(m.rows()), add_one(m.cols());
    for (Eigen::Index c = 0; c < m.cols(); ++c)
      for (Eigen::Index r = 0; r < m.rows(); ++r) add_one(m.derived()(r, c));
  }
  void add_one(const std::string& text) {
    add_one(text.size());
    for (const char c : text) add_one(c);
  }
  void add_one(const char* text) {
    while (*text != '\0') add_one(*text++);
  }

  void add_one(const Pair& p) { add(p.kind, p.a, p.b, p.vertices); }
  void add_one(const PairCounts& c) { add(c.vertex_face, c.edge_edge, c.vertex_edge, c.vertex_plane); }
  void add_one(const Plane& p) { add(p.normal, p.offset, p.group, p.mask); }
  void add_one(const Contact& c) {
    add_one(static_cast<const Pair&>(c));
    add(c.toi, c.toi_hi, c.step_limit, c.tolerance, c.outcome, c.certainty, c.degenerate, c.weights, c.normal,
        c.gap, c.speed);
  }
  void add_one(const QueryResult& r) {
    add_one(static_cast<const Contact&>(r));
    add(r.checks);
  }
  void add_one(const ClosePair& p) {
    add_one(static_cast<const Pair&>(p));
    add(p.weights, p.distance, p.separation, p.gap);
  }
  void add_one(const Intersection& p) { add(p.edge, p.face, p.kind, p.vertices); }
  void add_one(const StartFinding& f) { add(f.fault, f.count, f.text); }
  void add_one(const PairFilterCounts& c) {
    add(c.pairs, c.masked, c.both_static, c.same_body, c.adjacent, c.excluded);
  }
  void add_one(const PrimitiveFilterCounts& c) { add(c.moving, c.statics, c.dropped); }
  void add_one(const FilterCounts& c) {
    add(c.vertex_face, c.edge_edge, c.vertex_edge, c.vertices, c.edges, c.faces);
  }
  void add_one(const CollisionRules& r) {
    add(r.points, r.thickness, r.bodies, r.rigid_bodies, r.bodies_without_self_collision, r.excluded_bodies,
        r.static_vertices, r.groups, r.masks, r.weld, r.excluded_vertices, r.excluded_pairs,
        r.excluded_intersections, r.planes);
  }

  void add_one(const StepResult& r) {
    ended(r);
    step = r.step;
    add(r.step, r.shortest, r.toi, r.toi_hi, r.rounding, r.certainty, r.limiting);
  }
  void add_one(const LineSearchStep& r) {
    add_one(static_cast<const StepResult&>(r));
    add(r.gap_share, r.gap_share_reduced, r.assured, r.closest);
  }
  void add_one(const ActiveSet& r) {
    ended(r);
    add(r.contacts, r.complete_until, r.dimension, r.planes);
  }
  void add_one(const Candidates& r) {
    ended(r);
    add(r.vertex_face, r.edge_edge, r.vertex_edge, r.vertex_plane, r.counts);
  }
  void add_one(const ClosePairs& r) {
    ended(r);
    add(r.pairs, r.d_hat);
  }
  void add_one(const Intersections& r) {
    ended(r);
    add(r.pairs, r.behind_planes);
  }
  void add_one(const StartReport& r) {
    ended(r);
    add(r.intersections, r.touching, r.within_separation, r.copied_vertices, r.faces_without_area,
        r.unused_vertices, r.findings);
  }
  void add_one(const TruncatedStep& r) {
    ended(r);
    add(r.positions, r.displacements, r.share, r.kept, r.pairs, r.limited_by, r.limiting);
  }
  void add_one(const Matches& m) { add(m.to_of_from, m.from_of_to, m.count); }
  void add_one(const TetrahedraSurface& s) { add(s.faces, s.edges, s.full_vertices, s.surface_vertices); }
  void add_one(const Constraints& c) { add(c.row, c.dof, c.value, c.bound); }

  template <class Result>
  void ended(const Result& r) {
    outcome = r.outcome;
    add(r.outcome, r.vertex);
  }

  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace onset::tests
