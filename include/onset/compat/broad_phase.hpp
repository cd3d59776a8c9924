// The broad phases of onset/compat/ipc.hpp: objects there, an option here. Passed to a call, they say which
// of Onset's methods finds its pairs; asked themselves, they list pairs of overlapping boxes.
//
// Source: BroadPhase and the classes derived from it in ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit),
// whose names they have.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <onset/compat/arguments.hpp>
#include <onset/compat/box_pairs.hpp>
#include <onset/compat/collision_filter.hpp>
#include <onset/compat/stencils.hpp>
#include <onset/options.hpp>
#include <onset/step_size.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace onset::ipc {

class Candidates;

// Pairs of primitives that share no vertex, may collide, and whose boxes meet.
//
// Guarantee of the detect_ calls: these pairs, all of them, appended in ascending order, the same for any
// number of threads and each of the classes below. Boxes hold the primitive at both ends of the motion,
// inflation_radius (model length, >= 0) in each direction, and are rounded outwards.
// build throws std::invalid_argument for ids out of range or other shapes than #V x dim, #E x 2, #F x 3; the
// detect_ calls std::runtime_error where positions are NaN, infinite or beyond 2^1020. Const calls are safe
// from several threads where can_vertices_collide is.
class BroadPhase {
 public:
  BroadPhase() = default;
  virtual ~BroadPhase() = default;
  virtual std::string name() const = 0;
  // What a call that gets this object uses. All methods find the same pairs.
  virtual onset::BroadPhaseMethod onset_method() const { return onset::BroadPhaseMethod::automatic; }

  void build(const Vertices& vertices, const Ids& edges, const Ids& faces, double inflation_radius = 0) {
    build(vertices, vertices, edges, faces, inflation_radius);
  }
  void build(const Vertices& vertices_t0, const Vertices& vertices_t1, const Ids& edges, const Ids& faces,
             double inflation_radius = 0) {
    clear();
    if (vertices_t0->rows() != vertices_t1->rows() || vertices_t0->cols() != vertices_t1->cols() ||
        (vertices_t0->size() > 0 && vertices_t0->cols() != 2 && vertices_t0->cols() != 3))
      throw std::invalid_argument("BroadPhase::build: positions are #V x 3 or #V x 2, the same at both ends");
    if (!(inflation_radius >= 0))
      throw std::invalid_argument("BroadPhase::build: inflation_radius is " +
                                  std::to_string(inflation_radius));
    dim_ = int(vertices_t0->cols());
    in_default_float_environment(
        [&] { make_boxes(*vertices_t0, *vertices_t1, *edges, *faces, inflation_radius); });
  }
  void clear() {
    for (std::vector<compat::Box>* boxes : {&vertex_boxes_, &edge_boxes_, &face_boxes_}) boxes->clear();
    edges_.clear(), faces_.clear();
    dim_ = 0;
  }

  // In two dimensions edge_vertex, else edge_edge and face_vertex.
  void detect_collision_candidates(Candidates& candidates) const;
  void detect_vertex_vertex_candidates(std::vector<VertexVertexCandidate>& candidates) const {
    list(vertex_boxes_, nullptr, candidates, &BroadPhase::vertex, &BroadPhase::vertex);
  }
  void detect_edge_vertex_candidates(std::vector<EdgeVertexCandidate>& candidates) const {
    list(edge_boxes_, &vertex_boxes_, candidates, &BroadPhase::edge, &BroadPhase::vertex);
  }
  void detect_edge_edge_candidates(std::vector<EdgeEdgeCandidate>& candidates) const {
    list(edge_boxes_, nullptr, candidates, &BroadPhase::edge, &BroadPhase::edge);
  }
  void detect_face_vertex_candidates(std::vector<FaceVertexCandidate>& candidates) const {
    list(face_boxes_, &vertex_boxes_, candidates, &BroadPhase::face, &BroadPhase::vertex);
  }
  void detect_edge_face_candidates(std::vector<EdgeFaceCandidate>& candidates) const {
    list(edge_boxes_, &face_boxes_, candidates, &BroadPhase::edge, &BroadPhase::face);
  }
  void detect_face_face_candidates(std::vector<FaceFaceCandidate>& candidates) const {
    list(face_boxes_, nullptr, candidates, &BroadPhase::face, &BroadPhase::face);
  }

  // Asked by the detect_ calls. The calls of Candidates and the free functions ask CollisionMesh's.
  CollisionFilter can_vertices_collide;

 private:
  std::array<int, 1> vertex(int i) const { return {i}; }
  std::array<int, 2> edge(int i) const { return edges_[std::size_t(i)]; }
  std::array<int, 3> face(int i) const { return faces_[std::size_t(i)]; }

  template <class Candidate, class First, class Second>
  void list(const std::vector<compat::Box>& a, const std::vector<compat::Box>* b,
            std::vector<Candidate>& candidates, First first, Second second) const {
    for (const auto& [i, j] : compat::overlapping_boxes(a, b, onset_method()))
      if (may_collide((this->*first)(i), (this->*second)(j))) candidates.emplace_back(i, j);
  }
  template <class First, class Second>
  bool may_collide(const First& a, const Second& b) const {
    bool may = false;
    for (const int i : a)
      for (const int j : b) {
        if (i == j) return false;
        may = may || can_vertices_collide(std::size_t(i), std::size_t(j));
      }
    return may;
  }

  void make_boxes(const Eigen::MatrixXd& x0, const Eigen::MatrixXd& x1, const Eigen::MatrixXi& edges,
                  const Eigen::MatrixXi& faces, double radius) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (Eigen::Index v = 0; v < x0.rows(); ++v) {
      compat::Box box;
      for (Eigen::Index a = 0; a < x0.cols(); ++a) {
        const double p = x0(v, a), q = x1(v, a);
        // NaN stays: the lists are then refused.
        box.lo[std::size_t(a)] = std::nextafter((q < p ? q : p) - radius, -infinity);
        box.hi[std::size_t(a)] = std::nextafter((q > p ? q : p) + radius, infinity);
        if (q != q) box.lo[std::size_t(a)] = q;
      }
      vertex_boxes_.push_back(box);
    }
    add(edges, edges_, edge_boxes_);
    add(faces, faces_, face_boxes_);
  }
  template <std::size_t size>
  void add(const Eigen::MatrixXi& ids, std::vector<std::array<int, size>>& rows,
           std::vector<compat::Box>& boxes) {
    if (ids.size() == 0) return;
    if (ids.cols() != Eigen::Index(size))
      throw std::invalid_argument("BroadPhase::build: rows of " + std::to_string(ids.cols()) + " ids, not " +
                                  std::to_string(size));
    for (Eigen::Index r = 0; r < ids.rows(); ++r) {
      std::array<int, size> row{};
      for (std::size_t k = 0; k < size; ++k) {
        row[k] = ids(r, Eigen::Index(k));
        if (row[k] < 0 || std::size_t(row[k]) >= vertex_boxes_.size())
          throw std::invalid_argument("BroadPhase::build: row " + std::to_string(r) + ": vertex " +
                                      std::to_string(row[k]) + " is out of range");
      }
      compat::Box box = vertex_boxes_[std::size_t(row[0])];
      for (const int v : row) box.extend(vertex_boxes_[std::size_t(v)]);
      rows.push_back(row), boxes.push_back(box);
    }
  }

  std::vector<compat::Box> vertex_boxes_, edge_boxes_, face_boxes_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<std::array<int, 3>> faces_;
  int dim_ = 0;
};

// All pairs.
class BruteForce : public BroadPhase {
 public:
  std::string name() const override { return "BruteForce"; }
  onset::BroadPhaseMethod onset_method() const override { return onset::BroadPhaseMethod::brute; }
};
// A grid of hashed cells.
class HashGrid : public BroadPhase {
 public:
  std::string name() const override { return "HashGrid"; }
  onset::BroadPhaseMethod onset_method() const override { return onset::BroadPhaseMethod::hash; }
};
class SpatialHash : public BroadPhase {
 public:
  std::string name() const override { return "SpatialHash"; }
  onset::BroadPhaseMethod onset_method() const override { return onset::BroadPhaseMethod::hash; }
};
// A tree of boxes, by all of these names.
class LBVH : public BroadPhase {
 public:
  std::string name() const override { return "LBVH"; }
  onset::BroadPhaseMethod onset_method() const override { return onset::BroadPhaseMethod::bvh; }
};
class BVH : public LBVH {
 public:
  std::string name() const override { return "BVH"; }
};
class SweepAndPrune : public LBVH {
 public:
  std::string name() const override { return "SweepAndPrune"; }
};
// On the CPU here, in two dimensions too.
class SweepAndTiniestQueue : public LBVH {
 public:
  std::string name() const override { return "SweepAndTiniestQueue"; }
};

enum class BroadPhaseMethod : std::uint8_t {
  BRUTE_FORCE,
  HASH_GRID,
  SPATIAL_HASH,
  LBVH,
  SWEEP_AND_PRUNE,
  SWEEP_AND_TINIEST_QUEUE
};
// Throws std::runtime_error for another number.
inline std::shared_ptr<BroadPhase> create_broad_phase(BroadPhaseMethod method) {
  switch (method) {
    case BroadPhaseMethod::BRUTE_FORCE:
      return std::make_shared<BruteForce>();
    case BroadPhaseMethod::HASH_GRID:
      return std::make_shared<HashGrid>();
    case BroadPhaseMethod::SPATIAL_HASH:
      return std::make_shared<SpatialHash>();
    case BroadPhaseMethod::LBVH:
      return std::make_shared<LBVH>();
    case BroadPhaseMethod::SWEEP_AND_PRUNE:
      return std::make_shared<SweepAndPrune>();
    case BroadPhaseMethod::SWEEP_AND_TINIEST_QUEUE:
      return std::make_shared<SweepAndTiniestQueue>();
  }
  throw std::runtime_error("create_broad_phase: unknown method " + std::to_string(int(method)));
}
inline std::unique_ptr<BroadPhase> make_default_broad_phase() { return std::make_unique<LBVH>(); }

}  // namespace onset::ipc
