// What can touch: vertices, edges and faces, and the rules of who may meet whom.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <onset/collision_rules.hpp>
#include <onset/export.hpp>
#include <onset/filter_counts.hpp>
#include <onset/result.hpp>
#include <onset/views.hpp>
#include <utility>
#include <vector>

namespace onset {

struct MeshData;  // scene/mesh_data.hpp

// A mesh of any mixture of faces, edges of no face (wires) and vertices of no element (points).
//
// Tested are vertices against faces and edges against edges. Two points, or a point and a wire, pass one
// another without touching unless aimed exactly: they are tested against each other where they are declared
// (CollisionRules::points), as those that must keep a distance should be.
//
// A mesh in the plane is made from positions of two columns, or by in_plane. It has no faces, its positions
// are #V x 2 in every call, and tested is every vertex against every edge that is not its own; so are two
// points where they are declared, once from each side (docs/two-dimensions.md).
//
// Checked once, shared by every call. Immutable but for the two set_ functions. Const calls from any number
// of threads are safe, a set_ function with any other call is not. Copies share their data until one of them
// is changed. What throws, for want of memory too (std::bad_alloc), leaves a mesh as it was.
class ONSET_API Mesh {
 public:
  // Of no vertices: to be assigned to.
  Mesh();
  Mesh(const Mesh&) = default;
  Mesh& operator=(const Mesh&) = default;
  // The other one is left with no vertices.
  Mesh(Mesh&& other) noexcept;
  Mesh& operator=(Mesh&& other) noexcept;
  ~Mesh() = default;

  // vertices: #V, the number of rows of every positions matrix.
  // edges: #E x 2, faces: #F x 3, ids of vertices. An edge given twice is two edges: the pairs of both are
  // listed.
  // Throws std::invalid_argument naming the row for an id out of [0, #V), a repeated vertex in a row, a wrong
  // number of columns, a face that has an edge which `edges` lacks, as its contacts would be lost
  // (complete_edges adds them), or what is wrong with the rules; std::runtime_error as Options::threads says,
  // where it sorts the edges of many faces, or counts neighbours (CollisionRules::excluded_rings).
  Mesh(std::ptrdiff_t vertices, const Indices& edges, const Indices& faces, const CollisionRules& rules = {});
  // As above with edges derived from the faces: onset::edges(faces), the order of igl::edges.
  Mesh(std::ptrdiff_t vertices, const Indices& faces, const CollisionRules& rules = {});
  // As above; `rest` (#V x 3) gives the number of vertices. Its values are not used. Where it is #V x 2 the
  // mesh is in the plane: `faces` must then have no rows, and the second one takes edges, #E x 2.
  Mesh(const Positions& rest, const Indices& edges, const Indices& faces, const CollisionRules& rules = {});
  Mesh(const Positions& rest, const Indices& faces, const CollisionRules& rules = {});
  // Returns a mesh in the plane. Parameters and errors are those of the first constructor.
  static Mesh in_plane(std::ptrdiff_t vertices, const Indices& edges, const CollisionRules& rules = {});

  // Replaces the rules. Throws std::invalid_argument naming the rule and the row, and then leaves the mesh as
  // it was. O(#V + #E + #F), n log n with bodies, and the pairs within CollisionRules::excluded_rings.
  void set_rules(const CollisionRules& rules);
  const CollisionRules& rules() const noexcept;

  // 3, or 2 in the plane: the number of columns of positions.
  int dimension() const noexcept;
  std::ptrdiff_t num_vertices() const noexcept;
  // With those of length zero that points are.
  std::ptrdiff_t num_edges() const noexcept;
  std::ptrdiff_t num_faces() const noexcept;
  // Those that the rules declare.
  std::ptrdiff_t num_points() const noexcept;
  std::array<int, 2> edge(std::ptrdiff_t row) const;
  std::array<int, 3> face(std::ptrdiff_t row) const;

  // The connected parts of edges and faces as bodies (#V ids, for CollisionRules::bodies), numbered by their
  // first vertex; a point is a body.
  std::vector<int> components() const;
  // The largest body id of the rules that are set, plus 1.
  int num_bodies() const noexcept;
  int body(std::ptrdiff_t vertex) const;
  // One value a body (num_bodies() of them) as one value a vertex, for the bodies of the rules that are set
  // already: set CollisionRules::bodies before asking for flags of its bodies.
  template <class T>
  std::vector<T> of_bodies(const std::vector<T>& values) const {
    std::vector<T> each(static_cast<std::size_t>(num_vertices()));
    for (std::size_t v = 0; v < each.size(); ++v)
      each[v] = values.at(static_cast<std::size_t>(body(std::ptrdiff_t(v))));
    return each;
  }

  // Which pairs remain and what left the others out.
  const FilterCounts& filter_counts() const noexcept;

  // Where this is the surface of a full (tetrahedral) mesh: the full mesh's vertex of each vertex (#V
  // different ids in [0, full_vertices)). All positions stay those of the surface; the functions below map
  // between the two.
  // Throws std::invalid_argument naming the row.
  void set_full_vertices(const std::vector<int>& ids, std::ptrdiff_t full_vertices);
  std::ptrdiff_t num_full_vertices() const noexcept;
  int full_vertex(std::ptrdiff_t vertex) const;
  std::array<int, 4> full_vertices(const Pair& pair) const;
  // 3 full_vertex + axis, in the pair's order; in the plane 2 full_vertex + axis, then -1 from the seventh
  // on.
  std::array<std::ptrdiff_t, 12> full_dofs(const Pair& pair) const;
  // x y z (in the plane x y) of each surface vertex, out of the full mesh's positions: `Positions(p.data(),
  // num_vertices(), dimension())`.
  std::vector<double> surface_positions(const Positions& full) const;

  // Frees the trees of the latest calls, their order and memory, which a mesh keeps for the next call on it.
  // That gives the same bytes with and without. Safe to call at any time.
  void release_memory() const noexcept;

  const MeshData& data() const noexcept { return *data_; }
  // Of what the library has made.
  explicit Mesh(std::shared_ptr<const MeshData> data) noexcept : data_(std::move(data)) {}

 private:
  template <class F>
  void change(F&& f);
  std::shared_ptr<const MeshData> data_;
};

// Lists the undirected edges of `faces`, each once, in the order of igl::edges: by the larger id, then the
// smaller.
ONSET_API std::vector<std::array<int, 2>> edge_list(const Indices& faces);
// `edges`, followed by the edges of `faces` that are not among them, in that order.
ONSET_API std::vector<std::array<int, 2>> complete_edge_list(const Indices& edges, const Indices& faces);

// One row an edge.
inline Eigen::MatrixXi edge_matrix(const std::vector<std::array<int, 2>>& list) {
  Eigen::MatrixXi E(list.size(), 2);
  for (std::size_t i = 0; i < list.size(); ++i) E.row(i) << list[i][0], list[i][1];
  return E;
}
// The same as matrices (#E x 2); complete_edges: what a mesh of wires and faces is made from.
inline Eigen::MatrixXi edges(const Indices& faces) { return edge_matrix(edge_list(faces)); }
inline Eigen::MatrixXi complete_edges(const Indices& edges, const Indices& faces) {
  return edge_matrix(complete_edge_list(edges, faces));
}

}  // namespace onset
