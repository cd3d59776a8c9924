// Pairs of primitives by their ids, as onset/compat/ipc.hpp lists them: which vertices they have, how far
// apart they are, and when they meet.
//
// Source: CollisionStencil and the candidates derived from it in ipc-toolkit
// (https://github.com/ipc-sim/ipc-toolkit), whose names they have.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <onset/compat/arguments.hpp>
#include <onset/compat/narrow_phase.hpp>
#include <onset/compat/pair_queries.hpp>
#include <onset/compat/plane_query.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

namespace onset::ipc {

// What a pair of at most four vertices can be asked. `positions` are the coordinates of its vertices, one
// after the other, as dof() gives them; edges and faces those of the mesh, #E x 2 and #F x 3.
//
// Throws std::invalid_argument for positions of another size. Ids are not checked against the matrices.
class CollisionStencil {
 public:
  static constexpr int STENCIL_SIZE = 4;

  CollisionStencil() = default;
  virtual ~CollisionStencil() = default;

  // As one of the classes below. Throws std::bad_cast where it is another.
  template <class Candidate>
  Candidate& as() {
    return dynamic_cast<Candidate&>(*this);
  }
  template <class Candidate>
  const Candidate& as() const {
    return dynamic_cast<const Candidate&>(*this);
  }

  virtual int num_vertices() const = 0;
  int dim(int ndof) const { return ndof / num_vertices(); }
  // Those beyond num_vertices() are -1.
  virtual std::array<index_t, STENCIL_SIZE> vertex_ids(const Ids& edges, const Ids& faces) const = 0;
  std::array<VectorMax3d, STENCIL_SIZE> vertices(const Vertices& x, const Ids& edges,
                                                 const Ids& faces) const {
    compat::require_space(*x);
    const auto ids = vertex_ids(edges, faces);
    std::array<VectorMax3d, STENCIL_SIZE> r;
    for (std::size_t i = 0; i < r.size(); ++i)
      if (ids[i] >= 0)
        r[i] = x->row(ids[i]).transpose();
      else
        r[i].setConstant(x->cols(), std::numeric_limits<double>::quiet_NaN());
    return r;
  }
  VectorMax12d dof(const Vertices& x, const Ids& edges, const Ids& faces) const {
    compat::require_space(*x);
    const auto ids = vertex_ids(edges, faces);
    VectorMax12d r(num_vertices() * x->cols());
    for (int i = 0; i < num_vertices(); ++i)
      r.segment(i * x->cols(), x->cols()) = x->row(ids[std::size_t(i)]).transpose();
    return r;
  }

  // The SQUARED distance, as in ipc-toolkit: the square of one within 2^-45 of the pair's size. NaN where
  // positions are not finite.
  double compute_distance(const Dofs& positions) const {
    double squared = 0;
    in_default_float_environment([&] {
      const compat::Nearest nearest = closest(positions);
      squared = nearest.distance * nearest.distance;
    });
    return squared;
  }
  double compute_distance(const Vertices& x, const Ids& edges, const Ids& faces) const {
    return compute_distance(dof(x, edges, faces));
  }
  // Weights of the vertices whose sum is the vector between the closest points.
  VectorMax4d compute_coefficients(const Dofs& positions) const {
    const compat::Nearest nearest = closest(positions);
    VectorMax4d r(num_vertices());
    for (int i = 0; i < r.size(); ++i) r[i] = nearest.weights[std::size_t(i)];
    return r;
  }
  VectorMax4d compute_coefficients(const Vertices& x, const Ids& edges, const Ids& faces) const {
    return compute_coefficients(dof(x, edges, faces));
  }

  // Tells whether the pair comes as close as min_distance by tmax, and when: as the queries of
  // narrow_phase_ccd say (NarrowPhaseCCD).
  virtual bool ccd(const Dofs& vertices_t0, const Dofs& vertices_t1, double& toi, double min_distance = 0,
                   double tmax = 1,
                   const NarrowPhaseCCD& narrow_phase_ccd = DEFAULT_NARROW_PHASE_CCD) const = 0;

 protected:
  virtual compat::Nearest closest(const Dofs& positions) const = 0;
  // Vertex i of positions.
  VectorMax3d point(const Dofs& positions, int i) const {
    const Eigen::Index size = positions->size() / num_vertices();
    if (positions->size() != size * num_vertices() || (size != 2 && size != 3))
      throw std::invalid_argument(std::to_string(positions->size()) + " coordinates, for " +
                                  std::to_string(num_vertices()) + " vertices");
    return positions->segment(i * size, size);
  }
  Eigen::Vector3d point3(const Dofs& positions, int i) const {
    const VectorMax3d p = point(positions, i);
    if (p.size() != 3) throw std::invalid_argument("this pair has no place in two dimensions");
    return p;
  }
};

class VertexVertexCandidate : public CollisionStencil {
 public:
  VertexVertexCandidate(index_t vertex0_id, index_t vertex1_id)
      : vertex0_id(vertex0_id), vertex1_id(vertex1_id) {}
  int num_vertices() const override { return 2; }
  std::array<index_t, 4> vertex_ids(const Ids&, const Ids&) const override {
    return {vertex0_id, vertex1_id, -1, -1};
  }
  bool ccd(const Dofs& a, const Dofs& b, double& toi, double min_distance = 0, double tmax = 1,
           const NarrowPhaseCCD& narrow_phase_ccd = DEFAULT_NARROW_PHASE_CCD) const override {
    return narrow_phase_ccd.point_point_ccd(point(a, 0), point(a, 1), point(b, 0), point(b, 1), toi,
                                            min_distance, tmax);
  }
  // In either order.
  bool operator==(const VertexVertexCandidate& o) const { return key() == o.key(); }
  bool operator!=(const VertexVertexCandidate& o) const { return key() != o.key(); }
  bool operator<(const VertexVertexCandidate& o) const { return key() < o.key(); }

  index_t vertex0_id, vertex1_id;

 protected:
  compat::Nearest closest(const Dofs& x) const override {
    return compat::nearest(compat::moving_points(point(x, 0), point(x, 1), point(x, 0), point(x, 1)));
  }

 private:
  std::tuple<index_t, index_t> key() const {
    return {std::min(vertex0_id, vertex1_id), std::max(vertex0_id, vertex1_id)};
  }
};

class EdgeVertexCandidate : public CollisionStencil {
 public:
  EdgeVertexCandidate(index_t edge_id, index_t vertex_id) : edge_id(edge_id), vertex_id(vertex_id) {}
  int num_vertices() const override { return 3; }
  // The vertex, then the edge's.
  std::array<index_t, 4> vertex_ids(const Ids& edges, const Ids&) const override {
    return {vertex_id, (*edges)(edge_id, 0), (*edges)(edge_id, 1), -1};
  }
  bool ccd(const Dofs& a, const Dofs& b, double& toi, double min_distance = 0, double tmax = 1,
           const NarrowPhaseCCD& narrow_phase_ccd = DEFAULT_NARROW_PHASE_CCD) const override {
    return narrow_phase_ccd.point_edge_ccd(point(a, 0), point(a, 1), point(a, 2), point(b, 0), point(b, 1),
                                           point(b, 2), toi, min_distance, tmax);
  }
  bool operator==(const EdgeVertexCandidate& o) const { return key() == o.key(); }
  bool operator!=(const EdgeVertexCandidate& o) const { return key() != o.key(); }
  bool operator<(const EdgeVertexCandidate& o) const { return key() < o.key(); }

  index_t edge_id, vertex_id;

 protected:
  compat::Nearest closest(const Dofs& x) const override {
    return compat::nearest(compat::moving_point_and_edge(point(x, 0), point(x, 1), point(x, 2), point(x, 0),
                                                         point(x, 1), point(x, 2)));
  }

 private:
  std::tuple<index_t, index_t> key() const { return {edge_id, vertex_id}; }
};

class EdgeEdgeCandidate : public CollisionStencil {
 public:
  EdgeEdgeCandidate(index_t edge0_id, index_t edge1_id) : edge0_id(edge0_id), edge1_id(edge1_id) {}
  int num_vertices() const override { return 4; }
  std::array<index_t, 4> vertex_ids(const Ids& edges, const Ids&) const override {
    return {(*edges)(edge0_id, 0), (*edges)(edge0_id, 1), (*edges)(edge1_id, 0), (*edges)(edge1_id, 1)};
  }
  bool ccd(const Dofs& a, const Dofs& b, double& toi, double min_distance = 0, double tmax = 1,
           const NarrowPhaseCCD& narrow_phase_ccd = DEFAULT_NARROW_PHASE_CCD) const override {
    return narrow_phase_ccd.edge_edge_ccd(point3(a, 0), point3(a, 1), point3(a, 2), point3(a, 3),
                                          point3(b, 0), point3(b, 1), point3(b, 2), point3(b, 3), toi,
                                          min_distance, tmax);
  }
  // In either order.
  bool operator==(const EdgeEdgeCandidate& o) const { return key() == o.key(); }
  bool operator!=(const EdgeEdgeCandidate& o) const { return key() != o.key(); }
  bool operator<(const EdgeEdgeCandidate& o) const { return key() < o.key(); }

  index_t edge0_id, edge1_id;

 protected:
  compat::Nearest closest(const Dofs& x) const override {
    const std::array<Point, 4> p{compat::point_of(point3(x, 0)), compat::point_of(point3(x, 1)),
                                 compat::point_of(point3(x, 2)), compat::point_of(point3(x, 3))};
    return compat::nearest({PairKind::edge_edge, p, p, {0, 1, 2, 3}});
  }

 private:
  std::tuple<index_t, index_t> key() const {
    return {std::min(edge0_id, edge1_id), std::max(edge0_id, edge1_id)};
  }
};

class FaceVertexCandidate : public CollisionStencil {
 public:
  FaceVertexCandidate(index_t face_id, index_t vertex_id) : face_id(face_id), vertex_id(vertex_id) {}
  int num_vertices() const override { return 4; }
  // The vertex, then the face's.
  std::array<index_t, 4> vertex_ids(const Ids&, const Ids& faces) const override {
    return {vertex_id, (*faces)(face_id, 0), (*faces)(face_id, 1), (*faces)(face_id, 2)};
  }
  bool ccd(const Dofs& a, const Dofs& b, double& toi, double min_distance = 0, double tmax = 1,
           const NarrowPhaseCCD& narrow_phase_ccd = DEFAULT_NARROW_PHASE_CCD) const override {
    return narrow_phase_ccd.point_triangle_ccd(point3(a, 0), point3(a, 1), point3(a, 2), point3(a, 3),
                                               point3(b, 0), point3(b, 1), point3(b, 2), point3(b, 3), toi,
                                               min_distance, tmax);
  }
  bool operator==(const FaceVertexCandidate& o) const { return key() == o.key(); }
  bool operator!=(const FaceVertexCandidate& o) const { return key() != o.key(); }
  bool operator<(const FaceVertexCandidate& o) const { return key() < o.key(); }

  index_t face_id, vertex_id;

 protected:
  compat::Nearest closest(const Dofs& x) const override {
    const std::array<Point, 4> p{compat::point_of(point3(x, 0)), compat::point_of(point3(x, 1)),
                                 compat::point_of(point3(x, 2)), compat::point_of(point3(x, 3))};
    return compat::nearest({PairKind::vertex_face, p, p, {0, 1, 2, 3}});
  }

 private:
  std::tuple<index_t, index_t> key() const { return {face_id, vertex_id}; }
};

// A vertex and a half-space that it stays out of: free where plane.signedDistance(x) > 0.
class PlaneVertexCandidate : public CollisionStencil {
 public:
  PlaneVertexCandidate(const Eigen::Hyperplane<double, 3>& plane, index_t vertex_id)
      : plane(plane), vertex_id(vertex_id) {}
  int num_vertices() const override { return 1; }
  std::array<index_t, 4> vertex_ids(const Ids&, const Ids&) const override { return {vertex_id, -1, -1, -1}; }
  bool ccd(const Dofs& a, const Dofs& b, double& toi, double min_distance = 0, double tmax = 1,
           const NarrowPhaseCCD& narrow_phase_ccd = DEFAULT_NARROW_PHASE_CCD) const override {
    return compat::plane_impact(toi, plane, point(a, 0), point(b, 0), min_distance, tmax,
                                narrow_phase_ccd.conservative_rescaling);
  }
  bool operator==(const PlaneVertexCandidate& o) const {
    return vertex_id == o.vertex_id && plane.coeffs() == o.plane.coeffs();
  }
  bool operator!=(const PlaneVertexCandidate& o) const { return !(*this == o); }
  bool operator<(const PlaneVertexCandidate& o) const {
    return std::tuple(vertex_id, plane.offset()) < std::tuple(o.vertex_id, o.plane.offset());
  }

  Eigen::Hyperplane<double, 3> plane;
  index_t vertex_id;

 protected:
  compat::Nearest closest(const Dofs& x) const override {
    return compat::nearest_to_plane(plane, point(x, 0));
  }
};

// Not among Candidates: what BroadPhase lists for intersections.
struct EdgeFaceCandidate {
  EdgeFaceCandidate(index_t edge_id, index_t face_id) : edge_id(edge_id), face_id(face_id) {}
  bool operator==(const EdgeFaceCandidate& o) const { return edge_id == o.edge_id && face_id == o.face_id; }
  bool operator!=(const EdgeFaceCandidate& o) const { return !(*this == o); }
  bool operator<(const EdgeFaceCandidate& o) const {
    return std::tuple(edge_id, face_id) < std::tuple(o.edge_id, o.face_id);
  }
  index_t edge_id, face_id;
};
struct FaceFaceCandidate {
  FaceFaceCandidate(index_t face0_id, index_t face1_id) : face0_id(face0_id), face1_id(face1_id) {}
  // In either order.
  bool operator==(const FaceFaceCandidate& o) const { return key() == o.key(); }
  bool operator!=(const FaceFaceCandidate& o) const { return key() != o.key(); }
  bool operator<(const FaceFaceCandidate& o) const { return key() < o.key(); }
  index_t face0_id, face1_id;

 private:
  std::tuple<index_t, index_t> key() const {
    return {std::min(face0_id, face1_id), std::max(face0_id, face1_id)};
  }
};

}  // namespace onset::ipc
