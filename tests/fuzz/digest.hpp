// What calls return as bytes, all but the statistics, so that answers can be compared to the last bit.
#pragma once

#include <cstring>
#include <onset/onset.hpp>
#include <string>
#include <type_traits>

namespace onset::fuzz {

class Digest {
 public:
  const std::string& bytes() const { return bytes_; }

  template <class T>
  std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>> add(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add(const std::string& text) { bytes_ += text + '\0'; }
  template <class T, std::size_t N>
  void add(const std::array<T, N>& list) {
    for (const T& x : list) add(x);
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(list.size());
    for (const T& x : list) add(x);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  void add(const Pair& p) { add(p.kind), add(p.a), add(p.b), add(p.vertices); }
  void add(const PairCounts& c) { add(c.vertex_face), add(c.edge_edge), add(c.vertex_plane); }
  void add(const Contact& c) {
    add(static_cast<const Pair&>(c));
    add(c.toi), add(c.toi_hi), add(c.step_limit), add(c.tolerance), add(c.outcome), add(c.certainty);
    add(c.degenerate), add(c.weights), add(c.normal), add(c.gap), add(c.speed);
  }
  void add(const ActiveSet& s) { add(s.contacts), add(s.outcome), add(s.vertex), add(s.complete_until); }
  void add(const StepResult& r) {
    add(r.step), add(r.shortest), add(r.toi), add(r.toi_hi), add(r.rounding), add(r.outcome),
        add(r.certainty);
    add(r.limiting), add(r.vertex);
  }
  void add(const LineSearchStep& r) {
    add(static_cast<const StepResult&>(r));
    add(r.gap_share), add(r.gap_share_reduced), add(r.assured), add(r.closest);
  }
  void add(const Candidates& c) {
    add(c.vertex_face), add(c.edge_edge), add(c.vertex_plane), add(c.counts), add(c.outcome), add(c.vertex);
  }
  void add(const ClosePair& p) {
    add(static_cast<const Pair&>(p));
    add(p.weights), add(p.distance), add(p.separation), add(p.gap);
  }
  void add(const ClosePairs& c) { add(c.pairs), add(c.d_hat), add(c.outcome), add(c.vertex); }
  void add(const Intersection& p) { add(p.edge), add(p.face), add(p.kind), add(p.vertices); }
  void add(const Intersections& i) { add(i.pairs), add(i.behind_planes), add(i.outcome), add(i.vertex); }
  void add(const StartFinding& f) { add(f.fault), add(f.count), add(f.text); }
  void add(const StartReport& r) {
    add(r.intersections), add(r.touching), add(r.within_separation), add(r.copied_vertices);
    add(r.faces_without_area), add(r.unused_vertices), add(r.findings), add(r.outcome), add(r.vertex);
  }

 private:
  std::string bytes_;
};

template <class T>
std::string digest(const T& value) {
  Digest d;
  d.add(value);
  return d.bytes();
}

}  // namespace onset::fuzz
