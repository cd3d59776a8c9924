// Motion that is not linear: trajectories of vertices, rigid bodies that turn, and the calls on them.
#pragma once

#include <cstddef>
#include <memory>
#include <onset/active_set.hpp>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/step_size.hpp>
#include <onset/views.hpp>
#include <vector>

namespace onset {

// Where all vertices of a scene are during a step, t in [0, 1]: true positions x(t) in real arithmetic, and
// what is stored of them in doubles, X(t). The calls below promise what they say of both.
//
// A class of the caller's own derives from it. Its functions are called from several threads at once, in the
// floating-point environment of the library, and must give the same bytes for the same arguments; what they
// throw leaves the call.
//
// Source: Redon, Kheddar, Coquillart, "Fast Continuous Collision Detection between Rigid Bodies", Computer
// Graphics Forum 21(3), 2002, for motion between chords; Ferguson, Li, Schneider, Gil-Ureta, Langlois, Jiang,
// Zorin, Kaufman, Panozzo, "Intersection-free Rigid Body Dynamics", ACM Transactions on Graphics 40(4), 2021,
// section 6, for chords with the distance that a vertex strays as a separation; docs/trajectories.md.
class ONSET_API Trajectory {
 public:
  // How a vertex moves, as body() says it. linear: x(t) = X(0) + t (X(1) - X(0)). free: in any way. A number
  // >= 0: as a part of the rigid body of that number, x(t) at one distance from its other vertices always.
  static constexpr int kLinear = -1, kFree = -2;

  Trajectory() = default;
  Trajectory(const Trajectory&) = default;
  Trajectory& operator=(const Trajectory&) = default;
  virtual ~Trajectory();

  virtual std::ptrdiff_t num_vertices() const = 0;
  // kLinear, kFree, or the number of a rigid body, at most 2^24.
  virtual int body(std::ptrdiff_t vertex) const = 0;
  // Writes X(t), model length, of `count` vertices: x y z of vertices[i] from xyz[3 i] on. NaN and infinite
  // ones are an outcome. t: in [0, 1]. X(0) must be x(0).
  virtual void positions(double t, const int* vertices, std::size_t count, double* xyz) const = 0;
  // Writes a bound, model length, >= 0, for each of `count` vertices that are not linear: at each t in
  // [t0, t1], 0 <= t0 <= t1 <= 1, x(t) and X(t) are no farther, in the Euclidean norm, from the point at t of
  // the chord, X(t0) + (t - t0) / (t1 - t0) (X(t1) - X(t0)) in real arithmetic. Rounding is included: with
  // t0 = t1 it is all that there is, and of a vertex of a rigid body what it is at t0 = t1 = 1 must hold at
  // all times. A bound that is NaN or infinite is an outcome, whenever it is asked for; one below 0 is
  // refused. The bound should fall with the square of t1 - t0, else calls are slow: a pair may then be looked
  // at in up to 2^62 pieces of time, unless Options sets a budget.
  virtual void straying(double t0, double t1, const int* vertices, std::size_t count,
                        double* bounds) const = 0;

  // X(t) of all vertices: what to store after a step to t in [0, 1].
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> at(double t) const {
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> x(num_vertices(), 3);
    all_positions(t, x.data());
    return x;
  }

 private:
  void all_positions(double t, double* xyz) const;
};

// Rigid bodies that turn and move, among vertices that move linearly.
//
// The truth for a vertex p = x_t0(v) of a body, in real arithmetic of the doubles given:
//   x(t) = c + R(t w) (p - c) + t d,
// R(t w) the rotation by the angle t |w| about w, c the centre, d the translation. What is stored of it is
// within u (|p| + 84 t |w| |p - c| + 5 t |d|) of that, times 1 + 2^-30, u = 2^-53. The bound of straying is
// r (1 - cos(theta / 2)), r the vertex's distance from the axis and theta the angle from t0 to t1, with twice
// that rounding; 2 r from a whole turn on. A translation is linear and adds nothing (docs/trajectories.md has
// the proofs). A body with w = 0 is linear.
//
// Const calls are safe from several threads.
class ONSET_API RigidTrajectory final : public Trajectory {
 public:
  // x_t0, x_t1: #V x 3, copied; vertices of no body move linearly from one to the other, or stay where they
  // are. Throws std::invalid_argument where the shapes are not #V x 3.
  RigidTrajectory(const Positions& x_t0, const Positions& x_t1);
  explicit RigidTrajectory(const Positions& x_t0);
  RigidTrajectory(const RigidTrajectory&);
  RigidTrajectory& operator=(const RigidTrajectory&);
  RigidTrajectory(RigidTrajectory&&) noexcept;
  RigidTrajectory& operator=(RigidTrajectory&&) noexcept;
  ~RigidTrajectory() override;

  // Adds a body of these vertices, or of [first, last), and returns its number, which body() says of them if
  // w is not 0; x_t1 of them is not used. rotation: w, radians, a rotation vector of any length up to 2^20.
  // translation: d, centre: c, model length. Numbers that are not finite make X(t) NaN, which a call answers
  // with an outcome. Throws std::invalid_argument that names what is wrong: a vertex out of range, one that
  // is in a body already, a longer rotation.
  int add_body(const std::vector<int>& vertices, const Eigen::Vector3d& rotation,
               const Eigen::Vector3d& translation, const Eigen::Vector3d& centre) {
    return add(vertices, rotation.data(), translation.data(), centre.data());
  }
  int add_body(std::ptrdiff_t first, std::ptrdiff_t last, const Eigen::Vector3d& rotation,
               const Eigen::Vector3d& translation, const Eigen::Vector3d& centre) {
    return add(first, last, rotation.data(), translation.data(), centre.data());
  }

  std::ptrdiff_t num_vertices() const override;
  int body(std::ptrdiff_t vertex) const override;
  void positions(double t, const int* vertices, std::size_t count, double* xyz) const override;
  void straying(double t0, double t1, const int* vertices, std::size_t count, double* bounds) const override;

 private:
  struct Impl;
  int add(const std::vector<int>& vertices, const double* rotation, const double* translation,
          const double* centre);
  int add(std::ptrdiff_t first, std::ptrdiff_t last, const double* rotation, const double* translation,
          const double* centre);
  std::unique_ptr<Impl> impl_;
};

// Computes the largest step along a trajectory that is certainly free of contact: StepResult::step is an s in
// [0, 1] such that x(t) has no contact for any t in [0, s], nor has X(s), nor X(t) for t in [shortest, s].
//
// Guarantee: never late. step > 0 wherever all pairs start apart by more than twice StepResult::rounding. A
// pair that comes within its separation plus the tolerance may be reported as a contact. Pairs of two linear
// primitives are decided as, and cost what, the call on x_t0 and x_t1 does; where no vertex turns the answer
// is that of that call, byte for byte. A pair with a part that turns is not proved to touch by a step, only
// by an active set. Such a pair that starts within its separation blocks the step, also where the motion
// parts it; so does one within a rigid body, which stays as close, and one there that is apart by less than
// what storing can change (below_rounding). The same bytes for any number of threads
// and any instruction set. Budgets and progress are of the whole call; max_checks is of a pair in one piece
// of time; of memory_limit, 256 bytes are counted for each pair that one piece leaves undecided.
//
// Throws std::invalid_argument as the call on positions, and for a trajectory of another number of vertices,
// a static vertex that is not linear, a bound of straying below 0, and, where a vertex is not linear,
// touching_may_pass_through. CollisionRules::weld holds between linear primitives, and within a body.
// Safe to call concurrently on one Mesh.
//
// Example:
//   onset::RigidTrajectory motion(x_t0, x_t1);
//   motion.add_body(0, x_t0.rows(), {0, 0, 3}, {0, 0, 0}, {0, 0, 1});
//   x = motion.at(onset::compute_collision_free_stepsize(mesh, motion).step);
//
// Source: as for Trajectory.
ONSET_API StepResult compute_collision_free_stepsize(const Mesh& mesh, const Trajectory& trajectory,
                                                     const Options& options = {});

// Tells whether the whole trajectory is certified free of contact. Otherwise as above, and as
// is_step_collision_free of positions.
ONSET_API bool is_step_collision_free(const Mesh& mesh, const Trajectory& trajectory,
                                      const Options& options = {});

// Finds every pair that is not certified free on the whole trajectory, each once, at its earliest contact.
//
// Guarantee: no pair with a contact is left out (up to complete_until), none has a toi later than its exact
// time, and none is listed that stays beyond separation + tolerance. toi_hi is finite where the contact is
// proved: the paths of both cross by then, or come as close as the separation. Contact points, normal and gap
// are those of the chords at toi, no farther from x(toi) than the tolerance; speed is of the motion at toi,
// scaled to the whole step. Otherwise as above, and as construct_active_set of positions.
ONSET_API ActiveSet construct_active_set(const Mesh& mesh, const Trajectory& trajectory,
                                         const Options& options = {});

}  // namespace onset
