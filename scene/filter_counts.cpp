#include "scene/filter_counts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "scene/pairs/vertex_rings.hpp"

namespace onset {
namespace {

using Count = std::int64_t;
constexpr std::size_t kMostClasses = 1024;

// Counts the vertices, edges and faces that rules treat alike.
struct EqualPrimitives {
  int kind;  // 2 class (see Classes) + static
  std::array<Count, 3> count{};
};
// The primitives of a scene, of a body or at a vertex: each kind once.
using Group = std::vector<EqualPrimitives>;

struct Sums {
  Count masked = 0, both_static = 0, rest = 0;
};

// Numbers the combinations of group and mask that occur, and knows which of them may meet. Beyond
// kMostClasses all are one class, and masked pairs are not counted as such.
class Classes {
 public:
  explicit Classes(const std::array<std::vector<PrimitiveKey>, 3>& keys) {
    for (const auto& of_kind : keys)
      for (const PrimitiveKey& k : of_kind)
        if (all_.empty() || all_.back() != Bits{k.group, k.mask}) all_.push_back({k.group, k.mask});
    std::sort(all_.begin(), all_.end());
    all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
    if (all_.empty() || all_.size() > kMostClasses) all_ = {{~0u, ~0u}}, blind_ = true;
  }
  int of(const PrimitiveKey& k) const {
    return blind_ ? 0 : int(std::lower_bound(all_.begin(), all_.end(), Bits{k.group, k.mask}) - all_.begin());
  }
  bool meet(int i, int j) const {
    const Bits &a = all_[std::size_t(i)], &b = all_[std::size_t(j)];
    return (a.first & b.second) != 0 && (b.first & a.second) != 0;
  }

 private:
  using Bits = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Bits> all_;
  bool blind_ = false;
};

class FilterCounter {
 public:
  FilterCounter(const MeshData& mesh, PrimitiveFilter& filter)
      : mesh_(mesh), filter_(filter), classes_(filter.keys) {}

  void run(std::array<std::vector<bool>, 3>& idle) {
    count_all();
    const Count V = mesh_.num_vertices, E = Count(mesh_.edges.size()), F = Count(mesh_.faces.size());
    for (const PairKind kind : kStepKinds) {
      if (!has_kind(mesh_, kind)) continue;
      PairFilterCounts& counts = counts_of(kind);
      counts.pairs = kind == PairKind::vertex_face   ? V * F
                     : kind == PairKind::vertex_edge ? V * E
                                                     : E * (E - 1) / 2;
      const Sums t = count(kind, scene_, scene_, true);
      counts.masked = t.masked, counts.both_static = t.both_static;
      for (const auto& [body, group] : bodies_)
        if (no_self(body)) counts.same_body += count(kind, group, group, true).rest;
      counts.adjacent = kind == PairKind::edge_edge     ? adjacent_edge_edge()
                        : kind == PairKind::vertex_edge ? adjacent_vertices_of(Primitive::edge)
                                                        : adjacent_vertices_of(Primitive::face);
    }
    count_excluded();
    for (const PairKind kind : kStepKinds)
      if (has_kind(mesh_, kind)) counts_of(kind).within_rings = count_rings(kind);
    if (!has_keys()) return;
    for (const Primitive p : kPrimitives) mark_idle(p, idle[std::size_t(p)]);
  }

 private:
  PairFilterCounts& counts_of(PairKind kind) const {
    FilterCounts& c = filter_.counts;
    return kind == PairKind::vertex_face ? c.vertex_face
           : kind == PairKind::edge_edge ? c.edge_edge
                                         : c.vertex_edge;
  }
  bool no_self(int body) const {
    return (!mesh_.rigid.empty() && mesh_.rigid[std::size_t(body)]) ||
           (!mesh_.no_self.empty() && mesh_.no_self[std::size_t(body)]);
  }
  int body_of(Primitive kind, int id) const {
    return mesh_.body.empty() ? 0 : mesh_.body[std::size_t(primitive_vertices(mesh_, kind, id)[0])];
  }
  bool has_keys() const { return filter_.keeps_apart(); }
  int kind_of(Primitive p, int id) const {
    if (!has_keys()) return 0;
    const PrimitiveKey& key = filter_.keys[std::size_t(p)][std::size_t(id)];
    return 2 * classes_.of(key) + (key.flags < 0);
  }

  static void add(Group& group, int kind, Primitive p, Count n = 1) {
    auto place = std::lower_bound(group.begin(), group.end(), kind,
                                  [](const EqualPrimitives& a, int k) { return a.kind < k; });
    if (place == group.end() || place->kind != kind) place = group.insert(place, EqualPrimitives{kind, {}});
    place->count[std::size_t(p)] += n;
  }

  void count_all() {
    for (const Primitive p : kPrimitives) {
      const std::size_t count = primitive_count(mesh_, p);
      if (!has_keys()) {
        add(scene_, 0, p, Count(count));
        continue;
      }
      for (std::size_t id = 0; id < count; ++id) {
        const int kind = kind_of(p, int(id)), body = body_of(p, int(id));
        add(scene_, kind, p);
        if (no_self(body) || !mesh_.excluded_bodies.empty()) add(bodies_[body], kind, p);
      }
    }
  }

  // Counts pairs between two groups, or within one where `same`, each pair of edges once.
  Sums count(PairKind kind, const Group& a, const Group& b, bool same) const {
    const std::size_t first = std::size_t(first_primitive(kind)),
                      second = std::size_t(second_primitive(kind));
    Sums t;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) {
        Count n = a[i].count[first] * b[j].count[second];
        if (same && kind == PairKind::edge_edge) {
          if (j < i) continue;
          if (i == j) n = a[i].count[first] * (a[i].count[first] - 1) / 2;
        }
        if (n == 0) continue;
        if (!classes_.meet(a[i].kind / 2, b[j].kind / 2))
          t.masked += n;
        else
          (a[i].kind & b[j].kind & 1 ? t.both_static : t.rest) += n;
      }
    if (!same && kind != PairKind::edge_edge) {  // the vertices of b against the faces or edges of a
      const Sums back = count(kind, b, a, true);
      t.masked += back.masked, t.both_static += back.both_static, t.rest += back.rest;
    }
    return t;
  }

  bool meet(int a, int b) const { return classes_.meet(a / 2, b / 2) && (a & b & 1) == 0; }

  // Counts pairs of a face, or an edge, and one of its vertices.
  Count adjacent_vertices_of(Primitive p) const {
    const std::size_t elements = primitive_count(mesh_, p);
    if (!has_keys())
      return p == Primitive::face ? 3 * Count(elements) : 2 * Count(elements) - mesh_.num_points;
    Count n = 0;
    for (std::size_t f = 0; f < elements; ++f) {
      if (no_self(body_of(p, int(f)))) continue;
      const int kind = kind_of(p, int(f));
      const std::array<int, 3> vertices = primitive_vertices(mesh_, p, int(f));
      const std::size_t corners = p == Primitive::face ? 3 : vertices[0] == vertices[1] ? 1 : 2;
      for (std::size_t k = 0; k < corners; ++k) n += meet(kind_of(Primitive::vertex, vertices[k]), kind);
    }
    return n;
  }

  // Points come last and share their vertex with no edge.
  std::size_t proper_edges() const { return mesh_.edges.size() - std::size_t(mesh_.num_points); }

  // Counts pairs of edges at each vertex, less one for each pair that shares both vertices.
  Count adjacent_edge_edge() const {
    Count n = 0;
    if (!has_keys()) {
      std::vector<Count> degree(std::size_t(mesh_.num_vertices), 0);
      for (std::size_t e = 0; e < proper_edges(); ++e)
        for (int v : mesh_.edges[e]) ++degree[std::size_t(v)];
      for (const Count d : degree) n += d * (d - 1) / 2;
    } else {
      std::vector<Group> at(std::size_t(mesh_.num_vertices));
      for (std::size_t e = 0; e < proper_edges(); ++e) {
        if (no_self(body_of(Primitive::edge, int(e)))) continue;
        for (int v : mesh_.edges[e])
          add(at[std::size_t(v)], kind_of(Primitive::edge, int(e)), Primitive::edge);
      }
      for (const Group& group : at) n += count(PairKind::edge_edge, group, group, true).rest;
    }
    return n - repeated_edges();
  }

  // Counts pairs of edges with the same two vertices that no rule leaves out.
  Count repeated_edges() const {
    const auto order = [&](std::size_t e) {
      const auto& [a, b] = mesh_.edges[e];
      return std::uint64_t(std::max(a, b)) << 32 | std::uint64_t(std::min(a, b));
    };
    bool strictly = true;  // as edges made from faces are
    for (std::size_t e = 1; e < proper_edges(); ++e) strictly = strictly && order(e - 1) < order(e);
    if (strictly) return 0;
    std::vector<std::pair<std::uint64_t, int>> sorted;
    for (std::size_t e = 0; e < proper_edges(); ++e) sorted.emplace_back(order(e), int(e));
    std::sort(sorted.begin(), sorted.end());
    Count n = 0;
    for (std::size_t first = 0, last; first < sorted.size(); first = last) {
      Group copies;
      for (last = first; last < sorted.size() && sorted[last].first == sorted[first].first; ++last)
        add(copies, kind_of(Primitive::edge, sorted[last].second), Primitive::edge);
      if (!has_keys() || !no_self(body_of(Primitive::edge, sorted[first].second)))
        n += count(PairKind::edge_edge, copies, copies, true).rest;
    }
    return n;
  }

  void count_excluded() const {
    for (const auto& [b, c] : mesh_.excluded_bodies) {
      const auto x = bodies_.find(b), y = bodies_.find(c);
      if (x == bodies_.end() || y == bodies_.end()) continue;
      for (const PairKind kind : kStepKinds)
        if (has_kind(mesh_, kind)) counts_of(kind).excluded += count(kind, x->second, y->second, false).rest;
    }
    std::map<int, std::array<std::vector<int>, 2>> around;  // edges and faces at the vertices named
    for (const auto& pair : mesh_.excluded_vertices) around[pair[0]], around[pair[1]];
    for (const Primitive p : {Primitive::edge, Primitive::face})
      for (std::size_t id = 0; !around.empty() && id < primitive_count(mesh_, p); ++id)
        for (std::size_t k = 0; k < (p == Primitive::edge ? 2u : 3u); ++k)
          if (const auto at = around.find(primitive_vertices(mesh_, p, int(id))[k]); at != around.end())
            at->second[p == Primitive::face].push_back(int(id));
    auto found = mesh_.excluded_pairs;
    for (const auto& [v, w] : mesh_.excluded_vertices) {
      for (const auto& [from, to] : {std::pair(v, w), {w, v}}) {
        for (int f : around[to][1]) found[0].push_back({from, f});
        for (int e : around[to][0]) found[std::size_t(PairKind::vertex_edge)].push_back({from, e});
      }
      for (int e : around[v][0])
        for (int f : around[w][0]) found[1].push_back({std::min(e, f), std::max(e, f)});
    }
    for (const PairKind kind : kStepKinds) {
      if (!has_kind(mesh_, kind)) continue;
      auto& pairs = found[std::size_t(kind)];
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      for (const auto& [a, b] : pairs) counts_of(kind).excluded += only_by_name(kind, a, b);
    }
  }

  Count count_rings(PairKind kind) const {
    if (!mesh_.rings) return 0;
    return count_within_rings(mesh_, kind, [&](int a, int b) {
      return only_by_name(kind, a, b) && !excluded_by_name(mesh_, kind, a, b);
    });
  }

  // Says whether only the names of the pair itself or of two of its vertices, or rings, leave it out.
  bool only_by_name(PairKind kind, int a, int b) const {
    const Primitive p = first_primitive(kind), q = second_primitive(kind);
    if (p == q && a == b) return false;
    const int x = body_of(p, a), y = body_of(q, b);
    const std::array<int, 2> bodies{std::min(x, y), std::max(x, y)};
    return meet(kind_of(p, a), kind_of(q, b)) && !(x == y && no_self(x)) &&
           !share_vertex(mesh_, kind, a, b) &&
           !std::binary_search(mesh_.excluded_bodies.begin(), mesh_.excluded_bodies.end(), bodies);
  }

  Count partners(int kind, Primitive of, const Group& group) const {
    Count n = 0;
    for (const EqualPrimitives& other : group)
      if (meet(kind, other.kind)) n += other.count[std::size_t(of)];
    return n;
  }

  // Edges meet faces too, or edges in the plane, in the checks of positions at rest.
  std::vector<Primitive> others(Primitive p) const {
    if (mesh_.dimension == 2 && p == Primitive::vertex) return {Primitive::edge};
    if (mesh_.dimension == 2) return {Primitive::vertex, Primitive::edge};
    if (p == Primitive::vertex) return {Primitive::face};
    return {Primitive::edge, p == Primitive::edge ? Primitive::face : Primitive::vertex};
  }

  void mark_idle(Primitive p, std::vector<bool>& idle) const {
    idle.assign(primitive_count(mesh_, p), true);
    for (const Primitive other : others(p)) {
      std::map<int, Count> in_scene;
      for (const EqualPrimitives& a : scene_) in_scene[a.kind] = partners(a.kind, other, scene_);
      for (std::size_t id = 0; id < idle.size(); ++id) {
        const int kind = kind_of(p, int(id)), body = body_of(p, int(id));
        const bool alone = no_self(body);
        const Count own = alone ? partners(kind, other, bodies_.at(body)) : p == other && meet(kind, kind);
        if (in_scene.at(kind) != own) idle[id] = false;
      }
    }
  }

  const MeshData& mesh_;
  PrimitiveFilter& filter_;
  Classes classes_;
  Group scene_;
  std::map<int, Group> bodies_;  // those that do not meet themselves; all, where pairs of bodies are excluded
};

}  // namespace

void count_filtered(const MeshData& mesh, PrimitiveFilter& filter, std::array<std::vector<bool>, 3>& idle) {
  FilterCounter(mesh, filter).run(idle);
}

}  // namespace onset
