// A vertex that turns about an axis, in doubles, with bounds of all roundings.
#pragma once

namespace onset {

// Sine and cosine of an angle in [0, 2^20].
//
// Guarantee: both within 6.5u, the sine also within 8u of itself times the angle: |sine - sin x| <= 8u x. The
// same bytes everywhere: no function of the host's mathematical library is asked (docs/trajectories.md).
struct SineCosine {
  double sine, cosine;
};
SineCosine sine_cosine(double x);

// Returns an upper bound of the length of a vector, within a factor 1 + 2^-46; a subnormal one may be short
// of it by 2^-1074. Infinite or NaN where a coordinate is.
double length_up(double x, double y, double z);

// A rotation by t |w| about w, with a translation by t d.
struct Turn {
  double axis[3];             // w / |w|, each within 4.5u of itself
  double angle;               // |w| within 3.5u of itself, at most about 2^20
  double translation[3];      // d
  double centre[3];           // c
  double translation_length;  // |d| or more, but for 2^-1074
};
// Makes the turn of a rotation vector that is not 0.
Turn make_turn(const double* rotation, const double* translation, const double* centre);

// Writes c + R(t w) (p - c) + t d; exactly p at t = 0.
void turn(const Turn& turn, double t, const double* p, double* x);

// What bounds need to know of a vertex: each is an upper bound, but for 2^-1074.
struct Orbit {
  double size;      // |p|
  double distance;  // |p - c|
  double radius;    // its distance from the axis
};
Orbit orbit_of(const Turn& turn, const double* p);

// Returns a bound of |turn() - the same in real arithmetic| for all times in [0, t].
double rounding_of_turn(const Turn& turn, const Orbit& orbit, double t);

// Returns a bound of how far the arc strays from its chord between t0 and t1, in real arithmetic:
// r (1 - cos(theta / 2)), 2 r from a whole turn on.
double straying_of_turn(const Turn& turn, const Orbit& orbit, double t0, double t1);

}  // namespace onset
