// The CollisionMesh of onset/compat/ipc.hpp, which includes this.
//
// Source: ipc::CollisionMesh of ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit), whose names it has.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <functional>
#include <iterator>
#include <onset/mesh.hpp>
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
class CollisionMesh {
 public:
  // rest_positions: #V x 3 or #V x 2, model length.
  // edges: #E x 2, faces: #F x 3, ids of vertices. Empty edges are those of the faces.
  // displacement_map: dim #V x dim #full or #V x #full, from displacements of the full mesh to those of the
  // surface; empty: the surface is the full mesh.
  // Throws as onset::Mesh, also where `edges` lacks one of a face, as ipc-toolkit does, and
  // std::invalid_argument for a map of another shape.
  CollisionMesh(const Eigen::MatrixXd& rest_positions, const Eigen::MatrixXi& edges = {},
                const Eigen::MatrixXi& faces = {}, const Eigen::SparseMatrix<double>& displacement_map = {})
      : rest_(rest_positions),
        full_rest_(rest_positions),
        edges_(edges.size() == 0 && faces.size() > 0 ? onset::edges(faces) : edges),
        faces_(faces),
        mesh_(rest_, edges_, faces_),
        dim_(mesh_.dimension()) {
    if (displacement_map.size() > 0) set_map(displacement_map);
    for (int v = 0; v < rest_.rows(); ++v) full_vertex_.push_back(v);
    std::vector<bool> used(full_vertex_.size());
    for (const Eigen::MatrixXi* ids : {&edges_, &faces_})
      for (Eigen::Index i = 0; i < ids->size(); ++i) used[std::size_t(ids->data()[i])] = true;
    std::copy_if(full_vertex_.begin(), full_vertex_.end(), std::back_inserter(codim_vertices_),
                 [&](int v) { return !used[std::size_t(v)]; });
    CollisionRules rules;
    rules.points = codim_vertices_;
    mesh_.set_rules(rules);
  }

  // Makes the surface of those vertices of the full mesh that an edge or a face uses, in their order.
  // full_rest_positions: #full x 3, model length; edges, faces: ids of the full mesh.
  // Throws std::invalid_argument for an id out of range, and as onset::Mesh.
  static CollisionMesh build_from_full_mesh(const Eigen::MatrixXd& full_rest_positions,
                                            const Eigen::MatrixXi& edges, const Eigen::MatrixXi& faces) {
    std::vector<int> surface(std::size_t(full_rest_positions.rows()), -1), full;
    const auto use = [&](const Eigen::MatrixXi& ids) {
      for (Eigen::Index i = 0; i < ids.size(); ++i) {
        const int v = ids.data()[i];
        if (v < 0 || v >= full_rest_positions.rows())
          throw std::invalid_argument("vertex " + std::to_string(v) + " is out of range, the full mesh has " +
                                      std::to_string(full_rest_positions.rows()));
        surface[std::size_t(v)] = 0;
      }
    };
    use(edges), use(faces);
    if (edges.size() > 0)
      onset::Mesh(full_rest_positions.rows(), edges, faces);  // throws by the full mesh's ids
    for (std::size_t v = 0; v < surface.size(); ++v)
      if (surface[v] == 0) surface[v] = int(full.size()), full.push_back(int(v));
    const auto renumbered = [&](Eigen::MatrixXi ids) {
      for (Eigen::Index i = 0; i < ids.size(); ++i) ids.data()[i] = surface[std::size_t(ids.data()[i])];
      return ids;
    };
    Eigen::MatrixXd rest(Eigen::Index(full.size()), full_rest_positions.cols());
    for (std::size_t v = 0; v < full.size(); ++v)
      rest.row(Eigen::Index(v)) = full_rest_positions.row(full[v]);
    CollisionMesh mesh(rest, renumbered(edges), renumbered(faces));
    mesh.full_vertex_ = full;
    mesh.full_rest_ = full_rest_positions;
    return mesh;
  }

  const Eigen::MatrixXd& rest_positions() const { return rest_; }
  const Eigen::MatrixXi& edges() const { return edges_; }
  const Eigen::MatrixXi& faces() const { return faces_; }
  std::size_t num_vertices() const { return std::size_t(rest_.rows()); }
  std::size_t num_edges() const { return std::size_t(edges_.rows()); }
  std::size_t num_faces() const { return std::size_t(faces_.rows()); }
  // Vertices of no edge and no face, ascending: they collide with edges and with each other, too.
  const std::vector<int>& codim_vertices() const { return codim_vertices_; }
  std::size_t num_codim_vertices() const { return codim_vertices_.size(); }
  std::size_t ndof() const { return std::size_t(dim_) * num_vertices(); }
  std::size_t full_num_vertices() const {
    return std::size_t(has_map_ ? map_.num_dofs() / dim_ : full_rest_.rows());
  }
  std::size_t full_ndof() const { return std::size_t(dim_) * full_num_vertices(); }
  int dim() const { return dim_; }
  int to_full_vertex_id(int vertex) const { return full_vertex_.at(std::size_t(vertex)); }

  // vertices: surface positions of full positions (#full x dim). The other two take displacements of the full
  // mesh (#full x dim) and give surface positions and displacements of the surface.
  // Throws std::invalid_argument for a wrong number of rows or columns. So does `vertices` for a map from
  // another number of vertices than the surface has: positions of those at rest are not known, as they are
  // not in ipc-toolkit.
  Eigen::MatrixXd vertices(const Eigen::MatrixXd& full_positions) const {
    if (Eigen::Index(full_num_vertices()) != full_rest_.rows())
      throw std::invalid_argument("the map is from " + std::to_string(full_num_vertices()) + " vertices to " +
                                  std::to_string(rest_.rows()) +
                                  ", whose positions at rest are not known: use displace_vertices");
    require(full_positions, full_rest_.rows());
    return has_map_ ? displace_vertices(full_positions - full_rest_) : chosen(full_positions);
  }
  Eigen::MatrixXd displace_vertices(const Eigen::MatrixXd& full_displacements) const {
    return rest_ + map_displacements(full_displacements);
  }
  Eigen::MatrixXd map_displacements(const Eigen::MatrixXd& full_displacements) const {
    require(full_displacements, Eigen::Index(full_num_vertices()));
    if (!has_map_) return chosen(full_displacements);
    const std::vector<double> x = map_.positions(full_displacements);
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

  // Half-spaces that all vertices stay out of, in every call below. Throws as onset::Mesh.
  void set_planes(const std::vector<Plane>& planes) {
    CollisionRules rules = mesh_.rules();
    rules.planes = planes;
    mesh_.set_rules(rules);
  }

  // Whether two vertices may collide; empty: all may. It is not asked about planes. A pair of primitives is
  // left out where none of its pairs of vertices may. Candidates::build and has_intersections ask it on the
  // caller's thread.
  std::function<bool(std::size_t, std::size_t)> can_collide;

  const onset::Mesh& onset_mesh() const { return mesh_; }

  // Throws std::invalid_argument where positions are not #V x dim: Eigen does not ask in optimised builds.
  void require_surface(const Eigen::MatrixXd& x) const {
    if (x.rows() != rest_.rows() || x.cols() != dim_)
      throw std::invalid_argument("got " + shape(x) + " positions; the surface has " +
                                  std::to_string(rest_.rows()) + " vertices");
  }

 private:
  template <class Matrix>
  static std::string shape(const Matrix& x) {
    return std::to_string(x.rows()) + " x " + std::to_string(x.cols());
  }
  void require(const Eigen::MatrixXd& x, Eigen::Index rows) const {
    if (x.rows() != rows || x.cols() != dim_)
      throw std::invalid_argument("got " + shape(x) + " values; the full mesh has " + std::to_string(rows) +
                                  " vertices");
  }
  void require_dof(Eigen::Index rows, Eigen::Index cols, const std::string& got) const {
    if (rows != Eigen::Index(ndof()) || cols != rows)
      throw std::invalid_argument("got " + got + " values; the surface has " + std::to_string(ndof()) +
                                  " degrees of freedom");
  }
  void set_map(const Eigen::SparseMatrix<double>& map) {
    const Eigen::Index n = rest_.rows();
    if (map.rows() != n && (map.rows() != dim_ * n || map.cols() % dim_ != 0))
      throw std::invalid_argument("the displacement_map is " + shape(map) + ": for " + std::to_string(n) +
                                  " vertices it is " + std::to_string(n) + " x #full or " +
                                  std::to_string(dim_ * n) + " x " + std::to_string(dim_) + " #full");
    map_ = VertexMap(n, map, dim_), has_map_ = true;
  }
  Eigen::MatrixXd chosen(const Eigen::MatrixXd& full) const {
    Eigen::MatrixXd x(rest_.rows(), dim_);
    for (Eigen::Index v = 0; v < x.rows(); ++v) x.row(v) = full.row(full_vertex_[std::size_t(v)]);
    return x;
  }
  Eigen::SparseMatrix<double> to_full() const {
    if (has_map_) return map_.matrix();
    Eigen::SparseMatrix<double> chosen{Eigen::Index(num_vertices()), Eigen::Index(full_num_vertices())};
    for (std::size_t v = 0; v < full_vertex_.size(); ++v) chosen.insert(Eigen::Index(v), full_vertex_[v]) = 1;
    return VertexMap(rest_.rows(), chosen, dim_).matrix();
  }

  Eigen::MatrixXd rest_, full_rest_;
  Eigen::MatrixXi edges_, faces_;
  bool has_map_ = false;
  VertexMap map_;
  std::vector<int> full_vertex_, codim_vertices_;
  onset::Mesh mesh_;
  int dim_;
};

}  // namespace onset::ipc
