#include "mpi/scene/part_rules.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "scene/primitive_filter.hpp"
#include "scene/rules.hpp"

namespace onset::mpi {
namespace {

// FNV-1a of the bytes of all that is added.
class Hash {
 public:
  std::uint64_t value() const { return value_; }
  template <class T>
  void add(const T& x) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &x, sizeof(T));
    for (const unsigned char b : bytes) value_ = (value_ ^ b) * 0x100000001b3u;
  }
  template <class T, std::size_t N>
  void add(const std::array<T, N>& all) {
    for (const T& x : all) add(x);
  }
  template <class T>
  void add_all(const std::vector<T>& all) {
    add(all.size());
    for (const T& x : all) add(x);
  }
  void add_all(const std::vector<bool>& all) {
    add(all.size());
    for (const bool x : all) add(x);
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

template <class Rows, class AddRow>
std::uint64_t hash_of(const Rows& rows, const AddRow& add) {
  Hash hash;
  hash.add(rows.size());
  for (const auto& row : rows) add(hash, row);
  return hash.value();
}
template <class Rows>
std::uint64_t hash_of(const Rows& rows) {
  Hash hash;
  hash.add_all(rows);
  return hash.value();
}

// (c) Of the rules of the scene.
void require_same(const Communicator& comm, const CollisionRules& r) {
  Hash rest_share;
  rest_share.add(r.rest_share);
  comm.require_same(
      {{"rule weld", std::uint64_t(r.weld)},
       {"rule rest_share", rest_share.value()},
       {"rule excluded_rings", std::uint64_t(r.excluded_rings)},
       {"rule rigid_bodies", hash_of(r.rigid_bodies)},
       {"rule bodies_without_self_collision", hash_of(r.bodies_without_self_collision)},
       {"rule excluded_bodies", hash_of(r.excluded_bodies)},
       {"rule excluded_vertices", hash_of(r.excluded_vertices)},
       {"rule body_separations", hash_of(r.body_separations,
                                         [](Hash& hash, const BodySeparation& s) {
                                           hash.add(s.body_a), hash.add(s.body_b), hash.add(s.separation);
                                         })},
       {"rule planes", hash_of(r.planes,
                               [](Hash& hash, const Plane& p) {
                                 hash.add(p.normal), hash.add(p.offset), hash.add(p.group), hash.add(p.mask);
                               })},
       {"rule excluded_pairs",
        hash_of(r.excluded_pairs,
                [](Hash& hash, const Pair& p) { hash.add(p.kind), hash.add(p.a), hash.add(p.b); })},
       {"rule excluded_intersections",
        hash_of(r.excluded_intersections,
                [](Hash& hash, const Intersection& p) { hash.add(p.edge), hash.add(p.face); })}});
}

// (c) Of a rule with a value for each row: whether there is one, which all ranks with rows must agree on.
bool is_given(const Communicator& comm, const char* what, std::size_t values, std::ptrdiff_t rows) {
  std::int64_t given[2] = {values > 0, rows > 0 && values == 0};
  comm.agreed([&] {
    if (values > 0) check_size(what, values, rows, "rows");
  });
  comm.maximum(given, 2);
  if (given[0] != 0 && given[1] != 0)
    throw std::invalid_argument(std::string(what) + " is given on some ranks only");
  return given[0] != 0;
}

// (c) Takes a rule's values to slots.
template <class T, class Values>
void take(const char* what, const Values& values, Mesh::Impl& m, std::vector<T>& by_slot) {
  if (!is_given(m.comm, what, values.size(), m.rows)) return;
  m.has_rules = true;
  m.comm.agreed([&] {
    by_slot.resize(m.slots());
    for (std::size_t i = 0; i < std::size_t(m.owned); ++i) by_slot[i] = T(values[i]);
  });
  m.halo.fill(m.comm, by_slot.data());
}

std::string id_out_of_range(int id, std::int64_t count) {
  return "id " + std::to_string(id) + " is out of range, there are " + std::to_string(count);
}

// The names of vertices and pairs, which a part has with ids of the scene.
void check_names(const CollisionRules& tables, const Mesh::Impl& m) {
  const auto check = [](const char* what, std::size_t row, int id, std::int64_t count) {
    if (id < 0 || id >= count) reject_row(what, std::ptrdiff_t(row), id_out_of_range(id, count));
  };
  for (std::size_t r = 0; r < tables.excluded_vertices.size(); ++r) {
    const auto& [v, w] = tables.excluded_vertices[r];
    check("excluded_vertices", r, v, m.vertices), check("excluded_vertices", r, w, m.vertices);
    if (v == w)
      reject_row("excluded_vertices", std::ptrdiff_t(r), "id " + std::to_string(v) + " is repeated");
  }
  for (std::size_t r = 0; r < tables.excluded_pairs.size(); ++r) {
    const Pair& p = tables.excluded_pairs[r];
    const bool in_plane = p.kind == PairKind::vertex_edge;
    if (p.kind > PairKind::vertex_plane ||
        (p.kind != PairKind::vertex_plane && in_plane != (m.dimension == 2)))
      reject_row("excluded_pairs", std::ptrdiff_t(r), "the mesh has no pairs of this kind");
    check("excluded_pairs", r, p.a, p.kind == PairKind::edge_edge ? m.edges : m.vertices);
    check("excluded_pairs", r, p.b,
          p.kind == PairKind::vertex_face    ? m.faces
          : p.kind == PairKind::vertex_plane ? std::int64_t(tables.planes.size())
                                             : m.edges);
  }
  for (std::size_t r = 0; r < tables.excluded_intersections.size(); ++r) {
    const Intersection& p = tables.excluded_intersections[r];
    check("excluded_intersections", r, p.edge, m.edges);
    check("excluded_intersections", r, p.face, m.dimension == 2 ? m.edges : m.faces);
  }
}

// Checks what names bodies and planes, on a mesh that has as many bodies.
void check_tables(const CollisionRules& tables, int bodies, const Mesh::Impl& m, MeshData& checked) {
  CollisionRules rules = tables;
  rules.excluded_vertices = {}, rules.excluded_pairs = {}, rules.excluded_intersections = {};
  rules.excluded_rings = 0;
  checked.num_vertices = bodies, checked.dimension = m.dimension;
  rules.bodies.resize(std::size_t(bodies));
  std::iota(rules.bodies.begin(), rules.bodies.end(), 0);
  apply_rules(rules, checked);
}

template <std::size_t N>
void check_one_body(const char* what, const std::vector<Element<N>>& elements, const Mesh::Impl& m) {
  for (const Element<N>& e : elements)
    for (const int v : e.vertices)
      if (!m.body.empty() && m.body[std::size_t(v)] != m.body[std::size_t(e.vertices[0])])
        throw std::invalid_argument(std::string(what) + " id " + std::to_string(e.id) +
                                    " has vertices of two bodies");
}

void check_vertices(const Mesh::Impl& m) {
  const auto vertex = [&](std::size_t slot) { return " of vertex " + std::to_string(m.id[slot]); };
  for (std::size_t s = 0; s < m.thickness.size(); ++s)
    if (const double t = m.thickness[s]; !(t >= 0 && t <= 0x1p1020))
      throw std::invalid_argument("thickness" + vertex(s) + " is " + std::to_string(t) +
                                  "; it must be >= 0, at most 2^1020");
  for (std::size_t s = 0; s < m.body.size(); ++s)
    if (const int b = m.body[s]; b < 0 || b == std::numeric_limits<int>::max())
      throw std::invalid_argument("body" + vertex(s) + " is " + std::to_string(b) +
                                  ", which is not in [0, 2^31 - 1)");
  if (m.group.empty() != m.mask.empty()) throw std::invalid_argument("groups and masks are not both given");
  check_one_body("edge", m.own_edges, m), check_one_body("face", m.own_faces, m);
}

}  // namespace

void take_rules(const MeshPart& part, Mesh::Impl& m) {
  const CollisionRules& rules = part.rules;
  require_same(m.comm, rules);
  take("thickness", rules.thickness, m, m.thickness);
  take("bodies", rules.bodies, m, m.body);
  take("groups", rules.groups, m, m.group);
  take("masks", rules.masks, m, m.mask);
  take("static_vertices", rules.static_vertices, m, m.is_static);
  std::int64_t bodies = 1;
  m.comm.agreed([&] {
    check_vertices(m);
    for (const int b : m.body) bodies = std::max(bodies, std::int64_t(b) + 1);
    for (const double t : m.thickness) m.thickest = std::max(m.thickest, t);
  });
  m.comm.maximum(&bodies, 1);
  m.comm.maximum(&m.thickest, 1);
  m.comm.agreed([&] {
    if (m.thickest == 0) m.thickness = {};  // as a mesh of one process has it
    m.tables = rules;
    m.tables.thickness = {}, m.tables.bodies = {}, m.tables.groups = {}, m.tables.masks = {};
    m.tables.static_vertices = {}, m.tables.points = {};
    check_tables(m.tables, int(bodies), m, m.checked);
    check_names(m.tables, m);
  });
}

void put_tables(const Mesh::Impl& m, MeshData& data) {
  data.rigid = m.checked.rigid, data.no_self = m.checked.no_self;
  data.body_separations = m.checked.body_separations;
  const int bodies = count_bodies(data);
  for (const std::array<int, 2>& pair : m.checked.excluded_bodies)
    if (pair[0] < bodies && pair[1] < bodies) data.excluded_bodies.push_back(pair);
}

}  // namespace onset::mpi
