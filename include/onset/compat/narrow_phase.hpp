// The narrow phases of onset/compat/ipc.hpp: what ipc-toolkit passes to say how accurate, how long, and what
// share of a gap a step may use up; and their queries of one pair.
//
// Source: NarrowPhaseCCD, TightInclusionCCD and AdditiveCCD of ipc-toolkit
// (https://github.com/ipc-sim/ipc-toolkit), whose names and defaults they have. What answers is Onset's.
#pragma once

#include <Eigen/Core>
#include <onset/compat/arguments.hpp>
#include <onset/compat/pair_queries.hpp>
#include <onset/options.hpp>
#include <optional>

namespace onset::ipc {

// One query a function. Positions (model length) at the two ends of a linear motion; points have two or three
// coordinates, all of a query the same number.
//
// Returns whether there is an impact by tmax, in [0, 1], and in toi its time; without one toi is infinite.
// min_distance: model length, >= 0.
class NarrowPhaseCCD {
 public:
  using Vector = Eigen::Ref<const VectorMax3d>;
  using Vector3 = Eigen::Ref<const Eigen::Vector3d>;

  NarrowPhaseCCD() = default;
  virtual ~NarrowPhaseCCD() = default;

  virtual bool point_point_ccd(const Vector& p0_t0, const Vector& p1_t0, const Vector& p0_t1,
                               const Vector& p1_t1, double& toi, double min_distance = 0,
                               double tmax = 1) const = 0;
  virtual bool point_edge_ccd(const Vector& p_t0, const Vector& e0_t0, const Vector& e1_t0,
                              const Vector& p_t1, const Vector& e0_t1, const Vector& e1_t1, double& toi,
                              double min_distance = 0, double tmax = 1) const = 0;
  virtual bool point_triangle_ccd(const Vector3& p_t0, const Vector3& t0_t0, const Vector3& t1_t0,
                                  const Vector3& t2_t0, const Vector3& p_t1, const Vector3& t0_t1,
                                  const Vector3& t1_t1, const Vector3& t2_t1, double& toi,
                                  double min_distance = 0, double tmax = 1) const = 0;
  virtual bool edge_edge_ccd(const Vector3& ea0_t0, const Vector3& ea1_t0, const Vector3& eb0_t0,
                             const Vector3& eb1_t0, const Vector3& ea0_t1, const Vector3& ea1_t1,
                             const Vector3& eb0_t1, const Vector3& eb1_t1, double& toi,
                             double min_distance = 0, double tmax = 1) const = 0;

  // What Onset's own calls are to be told instead of asking the four functions pair by pair. A class of your
  // own that does not say is asked for each candidate, and what holds of its answers is its own promise.
  virtual std::optional<Options> onset_options() const { return std::nullopt; }

  // In (0, 1]: what a step may use up of every gap; 1 - conservative_rescaling of it is kept, so that the
  // next step is not 0.
  double conservative_rescaling = 0.8;
};

// What Onset answers.
//
// Guarantee: toi is never later than the exact time at which the pair comes as close as min_distance, and at
// toi it keeps 1 - conservative_rescaling of the gap beyond that. False only where the pair certainly stays
// beyond both up to tmax. A pair that touches at the start, or closes from within min_distance: true, toi 0.
// One that is within min_distance, or beyond it by no more than rounding (2^-45 of its size), apart, and
// parts, is not held back: it goes on as long as it comes no closer than it was, up to rounding
// (docs/steps.md). NaN, infinities and |x| > 2^1020: true, toi 0. This is of the exact motion: what storing x
// + toi dx changes is not looked at, as it is by the calls on meshes. Throws std::invalid_argument for values
// out of range. Eigen converts the points, and looks at their size in debug builds alone. Safe to call
// concurrently.
//
// A class derived from one of these that answers a query in another way has to return nothing from
// onset_options, else the calls on meshes do not ask it.
class CertifiedCCD : public NarrowPhaseCCD {
 public:
  // Of each query.
  virtual Options options() const = 0;
  std::optional<Options> onset_options() const override { return options(); }

  bool point_point_ccd(const Vector& p0_t0, const Vector& p1_t0, const Vector& p0_t1, const Vector& p1_t1,
                       double& toi, double min_distance = 0, double tmax = 1) const override {
    return impact(toi, compat::moving_points(p0_t0, p1_t0, p0_t1, p1_t1), min_distance, tmax);
  }
  bool point_edge_ccd(const Vector& p_t0, const Vector& e0_t0, const Vector& e1_t0, const Vector& p_t1,
                      const Vector& e0_t1, const Vector& e1_t1, double& toi, double min_distance = 0,
                      double tmax = 1) const override {
    return impact(toi, compat::moving_point_and_edge(p_t0, e0_t0, e1_t0, p_t1, e0_t1, e1_t1), min_distance,
                  tmax);
  }
  bool point_triangle_ccd(const Vector3& p_t0, const Vector3& t0_t0, const Vector3& t1_t0,
                          const Vector3& t2_t0, const Vector3& p_t1, const Vector3& t0_t1,
                          const Vector3& t1_t1, const Vector3& t2_t1, double& toi, double min_distance = 0,
                          double tmax = 1) const override {
    return impact(
        toi, compat::moving_four(PairKind::vertex_face, p_t0, t0_t0, t1_t0, t2_t0, p_t1, t0_t1, t1_t1, t2_t1),
        min_distance, tmax);
  }
  bool edge_edge_ccd(const Vector3& ea0_t0, const Vector3& ea1_t0, const Vector3& eb0_t0,
                     const Vector3& eb1_t0, const Vector3& ea0_t1, const Vector3& ea1_t1,
                     const Vector3& eb0_t1, const Vector3& eb1_t1, double& toi, double min_distance = 0,
                     double tmax = 1) const override {
    return impact(toi,
                  compat::moving_four(PairKind::edge_edge, ea0_t0, ea1_t0, eb0_t0, eb1_t0, ea0_t1, ea1_t1,
                                      eb0_t1, eb1_t1),
                  min_distance, tmax);
  }

 private:
  bool impact(double& toi, const compat::PairMotion& motion, double min_distance, double tmax) const {
    return compat::impact(toi, motion, min_distance, tmax, conservative_rescaling, options());
  }
};

// What the root finder of Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, "A Large-Scale Benchmark and an
// Inclusion-Based Algorithm for Continuous Collision Detection", ACM Transactions on Graphics 40(5), 2021, is
// told there: its tolerance is Options::tolerance here.
class TightInclusionCCD : public CertifiedCCD {
 public:
  static constexpr double DEFAULT_TOLERANCE = 1e-6;
  static constexpr long DEFAULT_MAX_ITERATIONS = 10'000'000L;
  static constexpr double DEFAULT_CONSERVATIVE_RESCALING = 0.8;
  // Not used: there are no second queries here.
  static constexpr double SMALL_TOI = 1e-6;

  explicit TightInclusionCCD(double tolerance = DEFAULT_TOLERANCE,
                             long max_iterations = DEFAULT_MAX_ITERATIONS,
                             double conservative_rescaling = DEFAULT_CONSERVATIVE_RESCALING)
      : tolerance(tolerance), max_iterations(max_iterations) {
    this->conservative_rescaling = conservative_rescaling;
  }
  Options options() const override {
    Options options = compat::options_of_iterations(max_iterations, DEFAULT_MAX_ITERATIONS);
    options.tolerance = tolerance;
    return options;
  }

  // Model length, > 0.
  double tolerance;
  // >= 1, or -1.
  long max_iterations;
};

// What the additive method of Li, Kaufman, Jiang, "Codimensional Incremental Potential Contact", ACM
// Transactions on Graphics 40(4), 2021, is told there. It has no tolerance: Onset's is relative to the pairs.
class AdditiveCCD : public CertifiedCCD {
 public:
  static constexpr long DEFAULT_MAX_ITERATIONS = 10'000'000L;
  static constexpr long UNLIMITTED_ITERATIONS = -1;
  static constexpr double DEFAULT_CONSERVATIVE_RESCALING = 0.9;

  explicit AdditiveCCD(long max_iterations = UNLIMITTED_ITERATIONS,
                       double conservative_rescaling = DEFAULT_CONSERVATIVE_RESCALING)
      : max_iterations(max_iterations) {
    this->conservative_rescaling = conservative_rescaling;
  }
  Options options() const override {
    return compat::options_of_iterations(max_iterations, DEFAULT_MAX_ITERATIONS);
  }

  long max_iterations;
};

inline const TightInclusionCCD DEFAULT_NARROW_PHASE_CCD;

}  // namespace onset::ipc
