// Onset inside ipc-toolkit: a narrow phase and a broad phase that derive from ipc-toolkit's own, for codes
// that keep its energies and call its functions. It includes the ipc-toolkit (1.6) that the code has; Onset
// needs it nowhere else, and onset/onset.hpp does not include this.
//
// What changes in such a code is what it passes:
//   onset::ipc_toolkit::BroadPhase broad_phase;  // was ipc::LBVH
//   onset::ipc_toolkit::NarrowPhaseCCD ccd;      // was ipc::TightInclusionCCD
//   candidates.build(mesh, x_t0, x_t1, inflation_radius, &broad_phase);
//   step = candidates.compute_collision_free_stepsize(mesh, x_t0, x_t1, min_distance, ccd);
//
// Source: the interfaces of ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit); docs/from-ipc-toolkit.md.
#pragma once

#include <array>
#include <cstddef>
#include <ipc/broad_phase/broad_phase.hpp>
#include <ipc/ccd/narrow_phase_ccd.hpp>
#include <ipc/ccd/tight_inclusion_ccd.hpp>
#include <onset/compat/box_pairs.hpp>
#include <onset/compat/pair_queries.hpp>
#include <onset/options.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace onset::ipc_toolkit {

// Onset's queries of one pair.
//
// Guarantee: toi is never later than the exact time at which the pair comes as close as min_distance, and at
// toi it keeps 1 - conservative_rescaling of the gap beyond that. False only where the pair certainly stays
// beyond both up to tmax; toi is then infinite. A pair that touches at the start, or closes
// from within min_distance: true, toi 0. One that is within min_distance, or beyond it by no more than
// rounding (2^-45 of its size), apart, and parts, is not held back: it goes on as long as it comes no closer
// than it was, up to rounding (docs/steps.md). NaN, infinities and |x| > 2^1020: true, toi 0. This is of the
// exact motion: what storing x + toi dx changes is not looked at, as it is by Onset's calls on meshes. Planes
// do not ask this class (ipc-toolkit decides them). Throws std::invalid_argument for values out of range.
// Safe to call concurrently.
class NarrowPhaseCCD : public ::ipc::NarrowPhaseCCD {
  using Vector = ::Eigen::ConstRef<::ipc::VectorMax3d>;
  using Vector3 = ::Eigen::ConstRef<::Eigen::Vector3d>;

 public:
  // As ipc::TightInclusionCCD: tolerance is Options::tolerance (model length, > 0), max_iterations the checks
  // that one pair may cost, where ipc-toolkit's default and -1 stand for Onset's.
  explicit NarrowPhaseCCD(
      double tolerance = ::ipc::TightInclusionCCD::DEFAULT_TOLERANCE,
      long max_iterations = ::ipc::TightInclusionCCD::DEFAULT_MAX_ITERATIONS,
      double conservative_rescaling = ::ipc::TightInclusionCCD::DEFAULT_CONSERVATIVE_RESCALING)
      : tolerance(tolerance), max_iterations(max_iterations) {
    this->conservative_rescaling = conservative_rescaling;
  }

  bool point_point_ccd(Vector p0_t0, Vector p1_t0, Vector p0_t1, Vector p1_t1, double& toi,
                       double min_distance = 0, double tmax = 1) const override {
    return impact(toi, compat::moving_points(p0_t0, p1_t0, p0_t1, p1_t1), min_distance, tmax);
  }
  bool point_edge_ccd(Vector p_t0, Vector e0_t0, Vector e1_t0, Vector p_t1, Vector e0_t1, Vector e1_t1,
                      double& toi, double min_distance = 0, double tmax = 1) const override {
    return impact(toi, compat::moving_point_and_edge(p_t0, e0_t0, e1_t0, p_t1, e0_t1, e1_t1), min_distance,
                  tmax);
  }
  bool point_triangle_ccd(Vector3 p_t0, Vector3 t0_t0, Vector3 t1_t0, Vector3 t2_t0, Vector3 p_t1,
                          Vector3 t0_t1, Vector3 t1_t1, Vector3 t2_t1, double& toi, double min_distance = 0,
                          double tmax = 1) const override {
    return impact(
        toi, compat::moving_four(PairKind::vertex_face, p_t0, t0_t0, t1_t0, t2_t0, p_t1, t0_t1, t1_t1, t2_t1),
        min_distance, tmax);
  }
  bool edge_edge_ccd(Vector3 ea0_t0, Vector3 ea1_t0, Vector3 eb0_t0, Vector3 eb1_t0, Vector3 ea0_t1,
                     Vector3 ea1_t1, Vector3 eb0_t1, Vector3 eb1_t1, double& toi, double min_distance = 0,
                     double tmax = 1) const override {
    return impact(toi,
                  compat::moving_four(PairKind::edge_edge, ea0_t0, ea1_t0, eb0_t0, eb1_t0, ea0_t1, ea1_t1,
                                      eb0_t1, eb1_t1),
                  min_distance, tmax);
  }

  double tolerance;
  long max_iterations;

 private:
  bool impact(double& toi, const compat::PairMotion& motion, double min_distance, double tmax) const {
    Options options =
        compat::options_of_iterations(max_iterations, ::ipc::TightInclusionCCD::DEFAULT_MAX_ITERATIONS);
    options.tolerance = tolerance;
    return compat::impact(toi, motion, min_distance, tmax, conservative_rescaling, options);
  }
};

// Onset's broad phase over the boxes that ipc-toolkit makes.
//
// Guarantee: the pairs that ipc::BruteForce lists, in ascending order, the same for any number of threads:
// boxes meet, no common vertex, and can_vertices_collide lets some pair of their vertices collide.
// build throws std::runtime_error for positions that are not finite (ipc-toolkit's boxes would forget some of
// them), the detect_ calls for boxes that reach beyond 2^1020. These append, and are safe to call
// concurrently where can_vertices_collide is.
class BroadPhase : public ::ipc::BroadPhase {
  using Matrix = ::Eigen::ConstRef<::Eigen::MatrixXd>;
  using Ids = ::Eigen::ConstRef<::Eigen::MatrixXi>;

 public:
  // The method makes no difference to what is listed.
  explicit BroadPhase(BroadPhaseMethod method = BroadPhaseMethod::automatic) : method_(method) {}
  std::string name() const override { return "Onset"; }

  using ::ipc::BroadPhase::build;
  void build(Matrix vertices, Ids edges, Ids faces, const double inflation_radius = 0) override {
    require_finite(vertices);
    ::ipc::BroadPhase::build(vertices, edges, faces, inflation_radius);
  }
  void build(Matrix vertices_t0, Matrix vertices_t1, Ids edges, Ids faces,
             const double inflation_radius = 0) override {
    require_finite(vertices_t0), require_finite(vertices_t1);
    ::ipc::BroadPhase::build(vertices_t0, vertices_t1, edges, faces, inflation_radius);
  }

  void detect_vertex_vertex_candidates(std::vector<::ipc::VertexVertexCandidate>& candidates) const override {
    list(vertex_boxes, nullptr, candidates,
         [this](std::size_t i, std::size_t j) { return can_vertices_collide(i, j); });
  }
  void detect_edge_vertex_candidates(std::vector<::ipc::EdgeVertexCandidate>& candidates) const override {
    list(edge_boxes, &vertex_boxes, candidates,
         [this](std::size_t i, std::size_t j) { return can_edge_vertex_collide(i, j); });
  }
  void detect_edge_edge_candidates(std::vector<::ipc::EdgeEdgeCandidate>& candidates) const override {
    list(edge_boxes, nullptr, candidates,
         [this](std::size_t i, std::size_t j) { return can_edges_collide(i, j); });
  }
  void detect_face_vertex_candidates(std::vector<::ipc::FaceVertexCandidate>& candidates) const override {
    list(face_boxes, &vertex_boxes, candidates,
         [this](std::size_t i, std::size_t j) { return can_face_vertex_collide(i, j); });
  }
  void detect_edge_face_candidates(std::vector<::ipc::EdgeFaceCandidate>& candidates) const override {
    list(edge_boxes, &face_boxes, candidates,
         [this](std::size_t i, std::size_t j) { return can_edge_face_collide(i, j); });
  }
  void detect_face_face_candidates(std::vector<::ipc::FaceFaceCandidate>& candidates) const override {
    list(face_boxes, nullptr, candidates,
         [this](std::size_t i, std::size_t j) { return can_faces_collide(i, j); });
  }

 private:
  static void require_finite(Matrix x) {
    if (!x.allFinite()) throw std::runtime_error("BroadPhase::build: a position is not finite");
  }
  std::vector<compat::Box> copied(const ::ipc::AABBs& boxes) const {
    std::vector<compat::Box> r(boxes.size());
    for (std::size_t i = 0; i < r.size(); ++i)
      for (int a = 0; a < int(dim); ++a)
        r[i].lo[std::size_t(a)] = boxes[i].min[a], r[i].hi[std::size_t(a)] = boxes[i].max[a];
    return r;
  }
  template <class Candidate, class MayCollide>
  void list(const ::ipc::AABBs& a, const ::ipc::AABBs* b, std::vector<Candidate>& candidates,
            const MayCollide& may_collide) const {
    const std::vector<compat::Box> first = copied(a), second = b != nullptr ? copied(*b) : first;
    for (const auto& [i, j] : compat::overlapping_boxes(first, b != nullptr ? &second : nullptr, method_))
      if (may_collide(std::size_t(i), std::size_t(j))) candidates.emplace_back(i, j);
  }

  BroadPhaseMethod method_;
};

}  // namespace onset::ipc_toolkit
