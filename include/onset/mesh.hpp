// What can touch: vertices, edges and faces, and who may meet whom; checked once and shared by every call.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <onset/export.hpp>
#include <onset/filter_counts.hpp>
#include <onset/result.hpp>
#include <onset/views.hpp>
#include <vector>

namespace onset {

struct MeshData;      // scene/mesh_data.hpp
struct Intersection;  // onset/intersections.hpp

// Immutable after construction apart from the set_ functions; const calls from any number of threads are
// safe, a set_ function with any other call is not. Copies share their data until one of them is changed. A
// set_ function takes time linear in the mesh (n log n with bodies), throws std::invalid_argument naming the
// row, or leaves the mesh as it was, and replaces what an earlier call of it set.
//
// Tested are vertices against faces and edges against edges. Vertices of no element (points) and edges of no
// face (wires) take part like all others. Two points, or a point and a wire, pass one another without
// touching unless aimed exactly: they are tested against each other where they are declared (set_points), as
// those that must keep a distance should be.
//
// A pair is left out of every call, and named by none, where any of the rules below says so; the primitives
// left with no partner get no box. filter_counts() counts.
class ONSET_API Mesh {
 public:
  // `vertices`: #V, the number of rows of every positions matrix. `edges`: #E x 2; `faces`: #F x 3. Throws
  // std::invalid_argument naming the row for an id out of [0, #V), a repeated vertex in a row, a wrong number
  // of columns, or a face that has an edge which `edges` lacks: its contacts would be lost. complete_edges
  // adds them. An edge given twice is two edges: the pairs of both are listed.
  Mesh(std::ptrdiff_t vertices, const Indices& edges, const Indices& faces);
  // As above with edges derived from the faces: onset::edges(faces), the order of igl::edges.
  Mesh(std::ptrdiff_t vertices, const Indices& faces);
  // As above; `rest` (#V x 3) gives the number of vertices. Its values are not used.
  Mesh(const Positions& rest, const Indices& edges, const Indices& faces);
  Mesh(const Positions& rest, const Indices& faces);

  std::ptrdiff_t num_vertices() const;
  std::ptrdiff_t num_edges() const;  // with those of length zero that set_points adds
  std::ptrdiff_t num_faces() const;
  std::array<int, 2> edge(std::ptrdiff_t row) const;
  std::array<int, 3> face(std::ptrdiff_t row) const;

  // Points (vertices of no edge and no face) that meet each other, wires and all other edges, as particles
  // with a separation or thickness do. Each becomes an edge {v, v} of length zero, after all others, in the
  // order given: its pairs are edge_edge pairs by the id num_edges() - num_points() + row, whose `vertices`
  // name v twice; the first of the two has the point's whole weight (1 or -1), the second 0. A pair with an
  // edge of a face says no more than the point and that face do. Throws std::invalid_argument naming the row
  // for an id out of [0, #V), repeated, or of a vertex of an edge or a face.
  void set_points(const std::vector<int>& ids);
  std::ptrdiff_t num_points() const;  // those set so

  // Thickness of each vertex (#V values >= 0, model length): a pair must stay apart by
  // Options::min_separation plus the largest thickness among the vertices of each of its two primitives.
  // Throws std::invalid_argument naming the row.
  void set_thickness(const std::vector<double>& thickness);

  // Bodies: one id a vertex (#V values >= 0), the same for all vertices of an edge or face. Until set, all is
  // body 0. Forgets what was set by body id: rigid, self-collision, excluded bodies.
  void set_bodies(const std::vector<int>& body);
  // The connected parts of edges and faces as bodies, numbered by their first vertex; a point is a body.
  std::vector<int> components() const;
  int num_bodies() const;  // the largest id + 1
  int body(std::ptrdiff_t vertex) const;

  // Static vertices (#V flags): they stay where they are, x_t1 = x_t0 in every call (else the call throws,
  // naming the vertex). Pairs all of whose vertices are static are left out. Boxes and tree of the primitives
  // all of whose vertices are static are kept from call to call until one of these vertices is found
  // elsewhere.
  void set_static(const std::vector<bool>& vertices);

  // One flag a body. Rigid: its parts never meet each other; that it moves rigidly is the caller's business
  // and not checked. Self-collision: off does the same for a body that deforms. Until set: not rigid, on.
  void set_rigid(const std::vector<bool>& bodies);
  void set_self_collision(const std::vector<bool>& bodies);

  // Bits of the groups that each vertex is in, and of those that it meets (#V values each). Primitives have
  // the bits of all of their vertices, and meet if each is in a group that the other one meets.
  void set_groups(const std::vector<std::uint32_t>& groups, const std::vector<std::uint32_t>& masks);

  // Bodies (#pairs x 2, different ids) that pass through each other; vertices (the same) that count as one,
  // as at a seam: a pair with one of the two on each side is left out as if it shared a vertex.
  void set_excluded_bodies(const std::vector<std::array<int, 2>>& pairs);
  void set_excluded_vertices(const std::vector<std::array<int, 2>>& pairs);

  // These very pairs, in every call and at any distance: they may pass through each other from now on. Such as those that
  // check() finds touching at the start: std::vector<Pair>(list.begin(),
  // list.end()) makes one of any list of pairs. `vertices` are not looked at. set_points forgets pairs of
  // points.
  void set_excluded_pairs(const std::vector<Pair>& pairs);
  // The same for an edge and a face, in intersections(), has_intersections() and check().
  void set_excluded_intersections(const std::vector<Intersection>& pairs);

  // Vertices that are at one place, exactly, at both ends of a motion count as one in it, as the copies of a seam's
  // vertices do: pairs with one of them on each side are left out as if they shared a vertex. Distances at one time
  // (close_pairs) are those of a motion that stays there. Until set: off.
  void set_weld(bool on);

  // One value a body (num_bodies() of them) as one value a vertex, for the functions that take these.
  template <class T>
  std::vector<T> of_bodies(const std::vector<T>& values) const {
    std::vector<T> each(static_cast<std::size_t>(num_vertices()));
    for (std::size_t v = 0; v < each.size(); ++v)
      each[v] = values.at(static_cast<std::size_t>(body(std::ptrdiff_t(v))));
    return each;
  }

  // Where this is the surface of a full (tetrahedral) mesh: the full mesh's vertex of each vertex (#V
  // different ids in [0, full_vertices)). All positions stay those of the surface; these map between the two.
  void set_full_vertices(const std::vector<int>& ids, std::ptrdiff_t full_vertices);
  std::ptrdiff_t num_full_vertices() const;
  int full_vertex(std::ptrdiff_t vertex) const;
  std::array<int, 4> full_vertices(const Pair& pair) const;
  std::array<std::ptrdiff_t, 12> full_dofs(
      const Pair& pair) const;  // 3 full_vertex + axis, in the pair's order
  // x y z of each surface vertex, out of the full mesh's positions: `Positions(p.data(), num_vertices())`.
  std::vector<double> surface_positions(const Positions& full) const;

  // Which pairs remain and what left the others out.
  const FilterCounts& filter_counts() const;

  // A mesh keeps the trees of its latest calls, their order and memory, for the next call on it, which gives
  // the same bytes with and without. This frees them; safe to call at any time.
  void release_memory() const;

  const MeshData& data() const { return *data_; }

 private:
  template <class F>
  void change(F&& f);
  std::shared_ptr<const MeshData> data_;
};

// The undirected edges of `faces`, each once, in the order of igl::edges: see scene/edges.cpp.
ONSET_API std::vector<std::array<int, 2>> edge_list(const Indices& faces);

// One row an edge.
inline Eigen::MatrixXi edge_matrix(const std::vector<std::array<int, 2>>& list) {
  Eigen::MatrixXi E(list.size(), 2);
  for (std::size_t i = 0; i < list.size(); ++i) E.row(i) << list[i][0], list[i][1];
  return E;
}

// The same as a matrix (#E x 2).
inline Eigen::MatrixXi edges(const Indices& faces) { return edge_matrix(edge_list(faces)); }

// `edges`, followed by the edges of `faces` that are not among them, in the order of igl::edges.
ONSET_API std::vector<std::array<int, 2>> complete_edge_list(const Indices& edges, const Indices& faces);

// The same as a matrix (#E x 2): what a mesh of wires and faces is made from.
inline Eigen::MatrixXi complete_edges(const Indices& edges, const Indices& faces) {
  return edge_matrix(complete_edge_list(edges, faces));
}

}  // namespace onset
