#include "mpi/exchange/part.hpp"

#include <algorithm>
#include <utility>

#include "mpi/exchange/ghosts.hpp"
#include "mpi/scene/part_rules.hpp"
#include "scene/pairs/vertex_rings.hpp"
#include "scene/primitive_filter.hpp"
#include "scene/rules.hpp"

namespace onset::mpi {
namespace {

// Where a vertex of the part comes from: a slot (rank -1), or a row of a rank's message.
struct Source {
  int id, rank, row;
};

class Assembly {
 public:
  Assembly(const Mesh::Impl& m, const OwnMotion& own, const Ghosts& ghosts)
      : m_(m), own_(own), ghosts_(ghosts) {}

  Part run() {
    auto data = std::make_shared<MeshData>();
    auto whole = std::make_shared<WholeScene>(own_.whole);
    data->dimension = m_.dimension;
    list_vertices(*whole);
    data->num_vertices = data->num_full_vertices = int(sources_.size());
    add_edges(*data, *whole);
    add_faces(*data, *whole);
    CollisionRules rules = rules_of_vertices();
    rules.points = std::move(points_);
    name_pairs(*whole, rules);
    apply_rules(rules, *data);
    put_tables(m_, *data);
    if (m_.near.rings > 0) data->rings = near_vertices();
    data->thickness = std::move(rules.thickness);
    data->thickest_elsewhere = m_.thickest;
    data->rules = std::make_shared<const CollisionRules>();
    Part part;
    put_positions(part);
    part.whole = whole, data->whole = std::move(whole);
    finish_mesh(*data);
    part.mesh = onset::Mesh(std::shared_ptr<const MeshData>(std::move(data)));
    return part;
  }

 private:
  const GhostVertex& ghost(const Source& s) const {
    return ghosts_.vertices[std::size_t(s.rank)][std::size_t(s.row)];
  }

  // Orders all vertices by id, each once; those of slots before those of messages.
  void list_vertices(WholeScene& whole) {
    std::vector<Source> arrived;
    for (std::size_t r = 0; r < ghosts_.vertices.size(); ++r)
      for (std::size_t i = 0; i < ghosts_.vertices[r].size(); ++i)
        arrived.push_back({ghosts_.vertices[r][i].id, int(r), int(i)});
    std::sort(arrived.begin(), arrived.end(), [](const Source& x, const Source& y) { return x.id < y.id; });
    PartPrimitives& vertices = whole.primitives[0];
    const std::size_t most = m_.slots() + arrived.size();
    sources_.reserve(most), ids_.reserve(most), vertices.reserve(most);
    whole.own_vertices.reserve(std::size_t(m_.owned));
    const auto add = [&](const Source& s, int owner) {
      if (!ids_.empty() && ids_.back() == s.id) return;
      sources_.push_back(s), ids_.push_back(s.id);
      if (owner != whole.here) return vertices.add(s.id, owner);
      vertices.add_own(), whole.own_vertices.push_back(s.id);
    };
    auto next = arrived.begin();
    for (const int slot : m_.by_id) {
      const int id = m_.id[std::size_t(slot)];
      for (; next != arrived.end() && next->id < id; ++next) add(*next, ghost(*next).owner);
      add({id, -1, slot}, m_.owner[std::size_t(slot)]);
    }
    for (; next != arrived.end(); ++next) add(*next, ghost(*next).owner);
    vertices.own_ids_at(whole.own_vertices.data(), sizeof(int));
    place_of_slot_.resize(m_.slots());
    for (std::size_t v = 0; v < sources_.size(); ++v)
      if (sources_[v].rank < 0) place_of_slot_[std::size_t(sources_[v].row)] = int(v);
  }

  int place(int id) const { return int(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()); }
  bool has_vertex(int id, int& at) const {
    at = place(id);
    return std::size_t(at) < ids_.size() && ids_[std::size_t(at)] == id;
  }

  // Merges own elements and those that arrived, by id, and calls add(id, owner, vertices of the part).
  template <std::size_t N, class Arrived, class Add>
  void merge(const std::vector<Element<N>>& own, const PerRank<Arrived>& arrived, const Add& add) const {
    std::vector<std::pair<const Arrived*, int>> others;
    for (std::size_t r = 0; r < arrived.size(); ++r)
      for (const Arrived& e : arrived[r]) others.push_back({&e, int(r)});
    std::sort(others.begin(), others.end(),
              [](const auto& x, const auto& y) { return x.first->id < y.first->id; });
    auto next = others.begin();
    const auto add_arrived = [&] {
      std::array<int, N> v;
      for (std::size_t k = 0; k < N; ++k)
        v[k] = place(ghosts_.vertices[std::size_t(next->second)][std::size_t(next->first->vertices[k])].id);
      add(next->first->id, next->second, v);
      ++next;
    };
    for (const Element<N>& e : own) {
      while (next != others.end() && next->first->id < e.id) add_arrived();
      std::array<int, N> v;
      for (std::size_t k = 0; k < N; ++k) v[k] = place_of_slot_[std::size_t(e.vertices[k])];
      add(e.id, m_.comm.rank(), v);
    }
    while (next != others.end()) add_arrived();
  }

  // Makes room for all elements and returns how many there are.
  template <std::size_t N, class Arrived>
  static std::size_t prepare(const std::vector<Element<N>>& own, const PerRank<Arrived>& arrived,
                             PartPrimitives& elements) {
    std::size_t count = own.size();
    for (const std::vector<Arrived>& of_rank : arrived) count += of_rank.size();
    elements.reserve(count);
    if (!own.empty()) elements.own_ids_at(&own[0].id, sizeof own[0]);
    return count;
  }
  void note(int id, int owner, PartPrimitives& elements) const {
    owner == m_.comm.rank() ? elements.add_own() : elements.add(id, owner);
  }
  void add_edges(MeshData& data, WholeScene& whole) {
    PartPrimitives& edges = whole.primitives[1];
    data.edges.reserve(prepare(m_.own_edges, ghosts_.edges, edges));
    merge<2>(m_.own_edges, ghosts_.edges, [&](int id, int owner, const std::array<int, 2>& v) {
      note(id, owner, edges);
      if (v[0] == v[1])
        points_.push_back(v[0]);
      else
        data.edges.push_back(v);
    });
  }
  void add_faces(MeshData& data, WholeScene& whole) {
    PartPrimitives& faces = whole.primitives[2];
    data.faces.reserve(prepare(m_.own_faces, ghosts_.faces, faces));
    merge<3>(m_.own_faces, ghosts_.faces, [&](int id, int owner, const std::array<int, 3>& v) {
      note(id, owner, faces);
      data.faces.push_back(v);
    });
  }

  // Takes a rule of slots and messages to the vertices of the part.
  template <class Values, class T>
  void take(const std::vector<T>& by_slot, T GhostRules::*of_ghost, Values& values) const {
    if (by_slot.empty()) return;
    values.reserve(sources_.size());
    for (const Source& s : sources_)
      values.push_back(s.rank < 0 ? by_slot[std::size_t(s.row)]
                                  : ghosts_.rules[std::size_t(s.rank)][std::size_t(s.row)].*of_ghost);
  }
  CollisionRules rules_of_vertices() const {
    CollisionRules rules;
    take(m_.thickness, &GhostRules::thickness, rules.thickness);
    take(m_.body, &GhostRules::body, rules.bodies);
    take(m_.group, &GhostRules::group, rules.groups);
    take(m_.mask, &GhostRules::mask, rules.masks);
    take(m_.is_static, &GhostRules::is_static, rules.static_vertices);
    rules.weld = m_.tables.weld;
    rules.planes = m_.tables.planes;
    return rules;
  }

  // Of a pair that is decided here one primitive is owned here, and its vertices are slots: what is near
  // slots is all that matters.
  std::shared_ptr<const VertexRings> near_vertices() const {
    std::vector<std::array<int, 2>> pairs;
    for (std::size_t slot = 0; slot < m_.slots(); ++slot)
      for (std::size_t i = m_.near.first[slot]; i < m_.near.first[slot + 1]; ++i) {
        int w = 0;
        const int v = place_of_slot_[slot];
        if (has_vertex(m_.near.ids[i], w)) pairs.push_back({std::min(v, w), std::max(v, w)});
      }
    return std::make_shared<const VertexRings>(int(sources_.size()), m_.near.rings, std::move(pairs));
  }

  // Rules that name vertices and pairs, as far as they are here.
  void name_pairs(const WholeScene& whole, CollisionRules& rules) const {
    int a = 0, b = 0;
    const auto& [vertices, edges, faces] = whole.primitives;
    for (const auto& [v, w] : m_.tables.excluded_vertices)
      if (has_vertex(v, a) && has_vertex(w, b)) rules.excluded_vertices.push_back({a, b});
    for (const Pair& p : m_.tables.excluded_pairs) {
      if (!(p.kind == PairKind::edge_edge ? edges : vertices).find(p.a, a)) continue;
      if (p.kind == PairKind::vertex_plane)
        b = p.b;
      else if (!(p.kind == PairKind::vertex_face ? faces : edges).find(p.b, b))
        continue;
      rules.excluded_pairs.push_back({p.kind, a, b, {}});
    }
    for (const Intersection& p : m_.tables.excluded_intersections)
      if (edges.find(p.edge, a) && (m_.dimension == 2 ? edges : faces).find(p.face, b)) {
        rules.excluded_intersections.push_back({});
        rules.excluded_intersections.back().edge = a, rules.excluded_intersections.back().face = b;
      }
  }

  void put_positions(Part& part) const {
    const std::size_t columns = std::size_t(m_.dimension);
    part.x_t0.reserve(columns * sources_.size()), part.x_t1.reserve(columns * sources_.size());
    for (const Source& s : sources_) {
      const double* x_t0 = s.rank < 0 ? own_.motion.t0(s.row) : ghost(s).x;
      const double* x_t1 = s.rank < 0 ? own_.end(s.row) : ghost(s).x + 3;
      part.x_t0.insert(part.x_t0.end(), x_t0, x_t0 + columns);
      part.x_t1.insert(part.x_t1.end(), x_t1, x_t1 + columns);
    }
  }

  const Mesh::Impl& m_;
  const OwnMotion& own_;
  const Ghosts& ghosts_;
  std::vector<Source> sources_;  // by vertex of the part
  std::vector<int> ids_;         // in the scene
  std::vector<int> place_of_slot_, points_;
};

void count_ghosts(const Mesh::Impl& m, const Part& part) {
  m.exchange.pairs = 0;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const PartPrimitives& all = part.whole->primitives[kind];
    m.exchange.ghosts[kind] = std::int64_t(all.elsewhere());
    m.exchange.owned[kind] = std::int64_t(all.size() - all.elsewhere());
  }
}

}  // namespace

void Part::rename(Pair& pair) const {
  if (pair.a < 0) return;
  pair.a =
      id_of(pair.kind == PairKind::vertex_plane ? Primitive::vertex : first_primitive(pair.kind), pair.a);
  if (pair.kind != PairKind::vertex_plane) pair.b = id_of(second_primitive(pair.kind), pair.b);
  rename_vertices(pair.vertices);
}

std::array<int, 4> Part::owners_of(const Pair& pair) const {
  std::array<int, 4> owners{-1, -1, -1, -1};
  for (std::size_t i = 0; i < 4; ++i)
    if (pair.vertices[i] >= 0) owners[i] = whole->owner(Primitive::vertex, pair.vertices[i]);
  return owners;
}

Part make_part(const Mesh::Impl& m, OwnMotion&& own, double inflation, Meetings meetings) {
  const Ghosts ghosts = exchange_ghosts(m, own, inflation, meetings);
  Part part;
  m.comm.agreed([&] {
    part = Assembly(m, own, ghosts).run();
    count_ghosts(m, part);
  });
  own = OwnMotion();
  return part;
}

MeshData reach_data(const Mesh::Impl& m, const WholeScene& whole) {
  MeshData data;
  data.dimension = m.dimension;
  data.body_separations = m.checked.body_separations;
  if (m.thickest > 0) data.thickness = {m.thickest};
  data.thickest_elsewhere = m.thickest;
  data.whole = std::make_shared<const WholeScene>(whole);
  return data;
}

}  // namespace onset::mpi
