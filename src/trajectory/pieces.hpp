// The motion of a piece of time as chords, with how far each vertex strays from its own as thickness.
#pragma once

#include <vector>

#include "onset/result.hpp"
#include "onset/trajectory.hpp"
#include "scene/motion/motion.hpp"
#include "src/trajectory/bounds.hpp"
#include "src/trajectory/crossing.hpp"
#include "src/trajectory/turning_scene.hpp"

namespace onset {

// All vertices where they start: rows of a motion of which a piece sets some, while a broad phase takes
// samples of all. Coordinates that are not usable are 0.
Motion standing_still(const std::vector<double>& x0);

// All of it is of the vertices that `set` was given last.
class Pieces {
 public:
  // x0, x1: X(0) and X(1), 3 #V, finite; all must outlive it.
  Pieces(TurningScene& scene, const Trajectory& trajectory, const std::vector<double>& x0,
         const std::vector<double>& x1);

  // Makes the chords of [t0, t1] and the thickness of scene.pieces. Returns whether nothing was wrong so far.
  //
  // Pairs whose chords keep their separation, both thicknesses and both of the largest bounds keep their
  // separation, truly and as stored: a point of a primitive strays no farther than the vertex that strays
  // most. Boxes have the thickness of scene.pieces: where vertices have one of their own all get the largest
  // bound there, since the thickest need not be the one that strays.
  bool set(double t0, double t1, const std::vector<int>& vertices);
  // The first thing that was wrong with a position or a bound, in all that was asked of the trajectory:
  // answers are then of no use. For a bound below 0 std::invalid_argument is thrown.
  const Fault& fault() const { return fault_; }

  const Motion& motion() const { return motion_; }
  // Of each vertex: how far it strays.
  const std::vector<double>& bounds() const { return bound_; }
  double t0() const { return t0_; }
  double t1() const { return t1_; }
  // Returns a time that is not later than t0 + share (t1 - t0), and before it unless that is t0.
  double time_at(double share) const;
  // Whether it may be cut in two.
  bool divisible() const;
  double middle() const { return t0_ + 0.5 * (t1_ - t0_); }

  // How much separation the pair has been given, rounded up.
  double added(const std::array<int, 4>& vertices, PairKind kind) const;
  // How much of that is rounding at the middle, which is in both halves.
  double rounding(const std::array<int, 4>& vertices, PairKind kind);
  // The most that rounding makes of any of these vertices, none of which is linear, at t = 1.
  double largest_rounding(const std::vector<int>& vertices);
  // Contains a vertex, truly, at all times of [t0, t1]; the vertex and the times may be any.
  VertexBox box(int v, double t0, double t1);
  // Whether chords follow the paths so badly that boxes around them are no good: more than 1/32 of the way,
  // about a quarter of a radian, and more than `enough`.
  bool is_coarse(const std::vector<int>& vertices, double enough);
  double largest_bound() const { return largest_; }

 private:
  void put_linear(int v, double t, double* x) const;
  void fill(double t0, double t1, const int* vertices, std::size_t count);
  double linear_bound(int v) const;
  double rounding_at(double t, int v);
  void note(Outcome outcome, int vertex) {
    if (outcome != Outcome::free && fault_.outcome == Outcome::free) fault_ = {outcome, vertex};
  }

  TurningScene& scene_;
  const Trajectory& trajectory_;
  const std::vector<double>&x0_, &x1_;
  Motion motion_;
  std::vector<double> bound_;
  double t0_ = 0, t1_ = 0, largest_ = 0;
  Fault fault_;
};

}  // namespace onset
