// The CollisionMesh of onset/compat/ipc.hpp, which includes this.
//
// Source: ipc::CollisionMesh of ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit), whose names it has.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>
#include <onset/compat/arguments.hpp>
#include <onset/compat/collision_filter.hpp>
#include <onset/compat/mesh_maps.hpp>
#include <onset/compat/mesh_with_planes.hpp>
#include <onset/mesh.hpp>
#include <onset/step_size.hpp>
#include <onset/vertex_map.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace onset::ipc {

// A surface, and how it lies in a full (volume) mesh. Vertices are rows.
//
// The calls below take surface positions (#V x dim, model length), as vertices() returns them. dim is 3, or 2
// where the rest positions have two columns: a mesh of edges in the plane, without faces. Const calls are
// safe from several threads where can_collide is. Sums with rest positions are the host's arithmetic, in
// whatever floating-point environment it has set; a displacement map is onset::VertexMap's.
//
// Matrices may be column- or row-major, blocks, expressions, and of float; what is returned is of double.
class CollisionMesh {
 public:
  // Of no vertices: to be assigned to.
  CollisionMesh() = default;
  // rest_positions: #V x 3 or #V x 2, model length.
  // edges: #E x 2, faces: #F x 3, ids of vertices. Empty edges are those of the faces.
  // displacement_map: dim #V x dim #full or #V x #full, from displacements of the full mesh to those of the
  // surface; empty: the surface is the full mesh.
  // Throws as onset::Mesh, also where `edges` lacks one of a face, as ipc-toolkit does, and
  // std::invalid_argument for a map of another shape.
  explicit CollisionMesh(const Vertices& rest_positions, const Ids& edges = {}, const Ids& faces = {},
                         const Eigen::SparseMatrix<double>& displacement_map = {})
      : CollisionMesh(std::vector<bool>(std::size_t(rest_positions->rows()), true), {}, rest_positions, edges,
                      faces, displacement_map) {}
  // The surface of those vertices of the full mesh that include_vertex (#full flags) says, in their order.
  // full_rest_positions, edges, faces: ids of the full mesh. orient_vertex: #full flags, or none; not used
  // but by is_orient_vertex. displacement_map: rows of the full mesh, of which those of the surface are used.
  // Throws as above, and for an edge or face with a vertex that is not included.
  CollisionMesh(const std::vector<bool>& include_vertex, const std::vector<bool>& orient_vertex,
                const Vertices& full_rest_positions, const Ids& edges = {}, const Ids& faces = {},
                const Eigen::SparseMatrix<double>& displacement_map = {})
      : full_rest_(*full_rest_positions), edges_(*edges), faces_(*faces) {
    const std::size_t full = std::size_t(full_rest_.rows());
    if (full > 0 && full_rest_.cols() != 2 && full_rest_.cols() != 3)
      throw std::invalid_argument("rest_positions are " + shape(full_rest_) +
                                  "; vertices have two or three coordinates");
    if (include_vertex.size() != full || (!orient_vertex.empty() && orient_vertex.size() != full))
      throw std::invalid_argument("include_vertex and orient_vertex are one flag for each of " +
                                  std::to_string(full) + " vertices");
    if (edges_.size() == 0) edges_ = faces_.size() > 0 ? onset::edges(faces_) : Eigen::MatrixXi(0, 2);
    full_vertex_ = MeshMaps::where(include_vertex);
    if (full_vertex_.size() < full_rest_.rows()) renumber();
    rest_ = chosen(full_rest_);
    for (const int v : full_vertex_)
      is_orient_vertex_.push_back(!orient_vertex.empty() && orient_vertex[std::size_t(v)]);
    onset::Mesh mesh(rest_, edges_, faces_);
    dim_ = mesh.dimension();
    maps_ = MeshMaps(num_vertices(), edges_, faces_);
    CollisionRules rules;
    rules.points.assign(codim_vertices().data(), codim_vertices().data() + num_codim_vertices());
    mesh.set_rules(rules);
    mesh_ = MeshWithPlanes(mesh);
    if (displacement_map.size() > 0) set_map(displacement_map);
  }

  // Makes the surface of those vertices of the full mesh that an edge or a face uses, in their order.
  // full_rest_positions: #full x dim, model length; edges, faces: ids of the full mesh.
  // Throws std::invalid_argument for an id out of range, and as onset::Mesh.
  static CollisionMesh build_from_full_mesh(const Vertices& full_rest_positions, const Ids& edges,
                                            const Ids& faces = {}) {
    const auto full = std::size_t(full_rest_positions->rows());
    std::vector<bool> used(full);
    for (const Eigen::MatrixXi* ids : {&*edges, &*faces})
      for (Eigen::Index i = 0; i < ids->size(); ++i) used[require_id(ids->data()[i], full)] = true;
    return CollisionMesh(used, {}, full_rest_positions, edges, faces);
  }

  const Eigen::MatrixXd& rest_positions() const { return rest_; }
  const Eigen::MatrixXi& edges() const { return edges_; }
  const Eigen::MatrixXi& faces() const { return faces_; }
  std::size_t num_vertices() const { return std::size_t(full_vertex_.size()); }
  std::size_t num_edges() const { return std::size_t(edges_.rows()); }
  std::size_t num_faces() const { return std::size_t(faces_.rows()); }
  // Vertices of no edge and no face, ascending: they collide with edges and with each other, too.
  const Eigen::VectorXi& codim_vertices() const { return maps_.codim_vertices; }
  std::size_t num_codim_vertices() const { return std::size_t(codim_vertices().size()); }
  // Edges of no face, ascending.
  const Eigen::VectorXi& codim_edges() const { return maps_.codim_edges; }
  std::size_t num_codim_edges() const { return std::size_t(codim_edges().size()); }
  bool is_codim_vertex(index_t v) const { return maps_.is_codim_vertex.at(std::size_t(v)); }
  bool is_codim_edge(index_t e) const { return maps_.is_codim_edge.at(std::size_t(e)); }
  bool is_orient_vertex(index_t v) const { return is_orient_vertex_.at(std::size_t(v)); }
  std::size_t ndof() const { return dim() * num_vertices(); }
  std::size_t full_num_vertices() const {
    return std::size_t(has_map_ ? map_.num_dofs() / dim_ : full_rest_.rows());
  }
  std::size_t full_ndof() const { return dim() * full_num_vertices(); }
  std::size_t dim() const { return std::size_t(dim_); }
  index_t to_full_vertex_id(index_t vertex) const {
    if (vertex < 0 || std::size_t(vertex) >= num_vertices())
      throw std::out_of_range("vertex " + std::to_string(vertex) + " is out of range");
    return full_vertex_[vertex];
  }
  const Eigen::VectorXi& to_full_vertex_id() const { return full_vertex_; }

  // Rows of `edges` of each face (#F x 3, edges 0 1, 1 2, 2 0), and what lies at each vertex and edge. Lists
  // are ascending. They are made by the constructor: init_adjacencies has nothing to do.
  const Eigen::MatrixXi& faces_to_edges() const { return maps_.face_edges; }
  const AdjacencyList& edges_to_faces() const { return maps_.edge_faces; }
  const AdjacencyList& vertices_to_edges() const { return maps_.vertex_edges; }
  const AdjacencyList& vertices_to_faces() const { return maps_.vertex_faces; }
  void init_adjacencies() {}
  bool are_adjacencies_initialized() const { return num_vertices() > 0; }
  const AdjacencyList& vertex_vertex_adjacencies() const { return maps_.vertex_vertices; }
  const AdjacencyList& vertex_edge_adjacencies() const { return maps_.vertex_edges; }
  const AdjacencyList& vertex_face_adjacencies() const { return maps_.vertex_faces; }
  // The vertices opposite of an edge in its faces.
  const AdjacencyList& edge_vertex_adjacencies() const { return maps_.edge_vertices; }
  // Of an edge at rest, and of the longest. Throws std::out_of_range.
  double edge_length(index_t e) const {
    if (e < 0 || e >= edges_.rows()) throw std::out_of_range("CollisionMesh: there is no such edge");
    double length = 0;
    in_default_float_environment(
        [&] { length = (rest_.row(edges_(e, 1)) - rest_.row(edges_(e, 0))).norm(); });
    return length;
  }
  double max_edge_length() const {
    double longest = 0;
    for (index_t e = 0; e < edges_.rows(); ++e) longest = std::max(longest, edge_length(e));
    return longest;
  }

  // vertices: surface positions of full positions (#full x dim). The other two take displacements of the full
  // mesh (#full x dim) and give surface positions and displacements of the surface.
  // Throws std::invalid_argument for a wrong number of rows or columns. So does `vertices` for a map from
  // another number of vertices than the surface has: positions of those at rest are not known, as they are
  // not in ipc-toolkit.
  Eigen::MatrixXd vertices(const Vertices& full_positions) const {
    if (Eigen::Index(full_num_vertices()) != full_rest_.rows())
      throw std::invalid_argument("the map is from " + std::to_string(full_num_vertices()) + " vertices to " +
                                  std::to_string(rest_.rows()) +
                                  ", whose positions at rest are not known: use displace_vertices");
    require(*full_positions, full_rest_.rows());
    if (!has_map_) return chosen(*full_positions);
    return displace_vertices(Eigen::MatrixXd(*full_positions - full_rest_));
  }
  Eigen::MatrixXd displace_vertices(const Vertices& full_displacements) const {
    return rest_ + map_displacements(full_displacements);
  }
  Eigen::MatrixXd map_displacements(const Vertices& full_displacements) const {
    require(*full_displacements, Eigen::Index(full_num_vertices()));
    if (!has_map_) return chosen(*full_displacements);
    const std::vector<double> x = map_.positions(*full_displacements);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const Rows>(x.data(), rest_.rows(), dim_);
  }

  // Takes a gradient (ndof) or a Hessian (ndof x ndof) from the surface's degrees of freedom (x y z of vertex
  // 0, ...) to those of the full mesh.
  // Throws std::invalid_argument for another size.
  Eigen::VectorXd to_full_dof(const Eigen::VectorXd& x) const {
    require_dof(x.rows(), x.rows(), std::to_string(x.rows()));
    return to_full().transpose() * x;
  }
  Eigen::SparseMatrix<double> to_full_dof(const Eigen::SparseMatrix<double>& hessian) const {
    require_dof(hessian.rows(), hessian.cols(), shape(hessian));
    const Eigen::SparseMatrix<double> m = to_full();
    return Eigen::SparseMatrix<double>(m.transpose() * hessian * m);
  }

  // Which of num_vertices a row of `edges` or codim_vertices has.
  static std::vector<bool> construct_is_on_surface(std::size_t num_vertices, const Ids& edges,
                                                   const Eigen::VectorXi& codim_vertices = {}) {
    std::vector<bool> r(num_vertices);
    for (Eigen::Index i = 0; i < edges->size(); ++i) r[require_id(edges->data()[i], num_vertices)] = true;
    for (const int v : codim_vertices) r[require_id(v, num_vertices)] = true;
    return r;
  }
  static Eigen::MatrixXi construct_faces_to_edges(const Ids& faces, const Ids& edges) {
    return ipc::faces_to_edges(*faces, *edges);
  }
  // From weights of vertices to the same weights of coordinates, x y z of vertex 0 first.
  static Eigen::SparseMatrix<double> vertex_matrix_to_dof_matrix(const Eigen::SparseMatrix<double>& weights,
                                                                 int dim) {
    return VertexMap(weights.rows(), weights, dim).matrix();
  }

  // Whether two vertices may collide; at first all may. It is not asked about planes. A pair of primitives is
  // left out where none of its pairs of vertices may. Calls ask it on the caller's thread.
  CollisionFilter can_collide;

  // Half-spaces that all vertices stay out of, in every call: free where signedDistance(x) > 0, exactly, for
  // the stored normal (of any length) and offset. In two dimensions the third component is 0. Every call
  // throws std::invalid_argument for one that is not finite or has no normal.
  std::vector<Eigen::Hyperplane<double, 3>> planes;
  void set_planes(const std::vector<Plane>& half_spaces) {
    planes.clear();
    for (const Plane& p : half_spaces)
      planes.emplace_back(Eigen::Vector3d(p.normal[0], p.normal[1], p.normal[2]), -p.offset);
    onset_mesh();  // throws
  }

  // With the planes as they are now.
  onset::Mesh onset_mesh() const { return mesh_.with(planes); }

  // Throws std::invalid_argument where positions are not #V x dim: Eigen does not ask in optimised builds.
  void require_surface(const Eigen::MatrixXd& x) const {
    if (x.rows() == 0 && rest_.rows() == 0) return;
    if (x.rows() != rest_.rows() || x.cols() != rest_.cols())
      throw std::invalid_argument("got " + shape(x) + " positions; the surface has " +
                                  std::to_string(rest_.rows()) + " vertices");
  }

 private:
  template <class Matrix>
  static std::string shape(const Matrix& x) {
    return std::to_string(x.rows()) + " x " + std::to_string(x.cols());
  }
  static std::size_t require_id(int v, std::size_t vertices) {
    if (v < 0 || std::size_t(v) >= vertices)
      throw std::invalid_argument("vertex " + std::to_string(v) + " is out of range, the full mesh has " +
                                  std::to_string(vertices));
    return std::size_t(v);
  }
  // Of what was passed by the ids of the full mesh, whose faults are named by those.
  void renumber() {
    if (full_rest_.cols() == 2 && faces_.size() == 0)
      onset::Mesh::in_plane(full_rest_.rows(), edges_);
    else
      onset::Mesh(full_rest_.rows(), edges_, faces_);
    std::vector<int> surface(std::size_t(full_rest_.rows()), -1);
    for (int v = 0; v < full_vertex_.size(); ++v) surface[std::size_t(full_vertex_[v])] = v;
    for (Eigen::MatrixXi* ids : {&edges_, &faces_})
      for (Eigen::Index i = 0; i < ids->size(); ++i) {
        int& v = ids->data()[i];
        if (surface[std::size_t(v)] < 0)
          throw std::invalid_argument("vertex " + std::to_string(v) +
                                      " has an edge or face, and is not included");
        v = surface[std::size_t(v)];
      }
  }
  void require(const Eigen::MatrixXd& x, Eigen::Index rows) const {
    if (x.rows() != rows || x.cols() != full_rest_.cols())
      throw std::invalid_argument("got " + shape(x) + " values; the full mesh has " + std::to_string(rows) +
                                  " vertices");
  }
  void require_dof(Eigen::Index rows, Eigen::Index cols, const std::string& got) const {
    if (rows != Eigen::Index(ndof()) || cols != rows)
      throw std::invalid_argument("got " + got + " values; the surface has " + std::to_string(ndof()) +
                                  " degrees of freedom");
  }
  void set_map(const Eigen::SparseMatrix<double>& map) {
    const Eigen::Index n = full_rest_.rows();
    if (map.rows() != n && (map.rows() != dim_ * n || map.cols() % dim_ != 0))
      throw std::invalid_argument("the displacement_map is " + shape(map) + ": for " + std::to_string(n) +
                                  " vertices it is " + std::to_string(n) + " x #full or " +
                                  std::to_string(dim_ * n) + " x " + std::to_string(dim_) + " #full");
    if (full_vertex_.size() == n) {
      map_ = VertexMap(n, map, dim_);
    } else {  // the rows of the surface
      const int each = int(map.rows() / n);
      Eigen::SparseMatrix<double> select(each * full_vertex_.size(), map.rows());
      for (int v = 0; v < full_vertex_.size(); ++v)
        for (int a = 0; a < each; ++a) select.insert(each * v + a, each * full_vertex_[v] + a) = 1;
      map_ = VertexMap(full_vertex_.size(), Eigen::SparseMatrix<double>(select * map), dim_);
    }
    has_map_ = true;
  }
  Eigen::MatrixXd chosen(const Eigen::MatrixXd& full) const {
    Eigen::MatrixXd x(full_vertex_.size(), full.cols());
    for (Eigen::Index v = 0; v < x.rows(); ++v) x.row(v) = full.row(full_vertex_[v]);
    return x;
  }
  Eigen::SparseMatrix<double> to_full() const {
    if (has_map_) return map_.matrix();
    Eigen::SparseMatrix<double> selected{Eigen::Index(num_vertices()), Eigen::Index(full_num_vertices())};
    for (Eigen::Index v = 0; v < full_vertex_.size(); ++v) selected.insert(v, full_vertex_[v]) = 1;
    return VertexMap(rest_.rows(), selected, dim_).matrix();
  }

  Eigen::MatrixXd rest_, full_rest_;
  Eigen::MatrixXi edges_, faces_;
  bool has_map_ = false;
  VertexMap map_;
  Eigen::VectorXi full_vertex_;
  std::vector<bool> is_orient_vertex_;
  MeshMaps maps_;
  MeshWithPlanes mesh_;
  int dim_ = 3;
};

}  // namespace onset::ipc
