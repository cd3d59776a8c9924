#include "scene/motion/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace onset {
namespace {

constexpr double kU = 0x1p-53;

// pi / 2 in three parts: n times the first two is exact for n < 2^20, as they have 33 bits; the third is
// rounded to 53, and what is left is below 2^-119.
constexpr double kHalfPi1 = 0x1.921fb544p0, kHalfPi2 = 0x1.0b4611a6p-34, kHalfPi3 = 0x1.3198a2e037073p-69;
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

// Taylor polynomials on [-0.79, 0.79]. What they leave out is below x^17 / 17! < 2^-53 x, and
// x^18 / 18! < 2^-58; the coefficients are rounded quotients.
double polynomial_sine(double x) {
  const double z = x * x;
  double p = -1.0 / 1307674368000;
  p = 1.0 / 6227020800 + z * p;
  p = -1.0 / 39916800 + z * p;
  p = 1.0 / 362880 + z * p;
  p = -1.0 / 5040 + z * p;
  p = 1.0 / 120 + z * p;
  p = -1.0 / 6 + z * p;
  return x + x * (z * p);
}
double polynomial_cosine(double x) {
  const double z = x * x;
  double p = 1.0 / 20922789888000;
  p = -1.0 / 87178291200 + z * p;
  p = 1.0 / 479001600 + z * p;
  p = -1.0 / 3628800 + z * p;
  p = 1.0 / 40320 + z * p;
  p = -1.0 / 720 + z * p;
  p = 1.0 / 24 + z * p;
  p = -0.5 + z * p;
  return 1 + z * p;
}

void cross(const double* a, const double* b, double* r) {
  r[0] = a[1] * b[2] - a[2] * b[1];
  r[1] = a[2] * b[0] - a[0] * b[2];
  r[2] = a[0] * b[1] - a[1] * b[0];
}

}  // namespace

SineCosine sine_cosine(double x) {
  // |x - n pi / 2| <= pi / 4 + 2^-30, since n is rounded from a product within 2u x.
  const double n = std::floor(x * kTwoOverPi + 0.5);
  const double y = ((x - n * kHalfPi1) - n * kHalfPi2) - n * kHalfPi3;
  const double s = polynomial_sine(y), c = polynomial_cosine(y);
  switch (static_cast<long long>(n) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

// The scale brings the largest coordinate into [1/2, 1): what underflows is below 2^-1000 of the sum.
// Squares, sums and the root err by less than 4u.
double length_up(double x, double y, double z) {
  const double largest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  if (!(largest > 0) || !std::isfinite(largest)) return std::fabs(x) + std::fabs(y) + std::fabs(z);
  int exponent;
  std::frexp(largest, &exponent);
  const double a = std::ldexp(x, -exponent), b = std::ldexp(y, -exponent), c = std::ldexp(z, -exponent);
  const double length = std::ldexp(std::sqrt(a * a + b * b + c * c) * (1 + 0x1p-48), exponent);
  return std::max(length, largest);  // a subnormal length is rounded to the nearest one
}

Turn make_turn(const double* rotation, const double* translation, const double* centre) {
  Turn r;
  const double largest = std::max({std::fabs(rotation[0]), std::fabs(rotation[1]), std::fabs(rotation[2])});
  int exponent = 0;
  if (std::isfinite(largest)) std::frexp(largest, &exponent);
  double w[3];  // scaled: the largest is in [1/2, 1)
  for (int a = 0; a < 3; ++a) w[a] = std::ldexp(rotation[a], -exponent);
  const double length = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  for (int a = 0; a < 3; ++a) {
    r.axis[a] = w[a] / length;
    r.translation[a] = translation[a], r.centre[a] = centre[a];
  }
  r.angle = std::ldexp(length, exponent);
  r.translation_length = length_up(translation[0], translation[1], translation[2]);
  return r;
}

// p + (t d + (R - 1) q), with q = p - c and (R - 1) q = 2 s (c k x q + s k x (k x q)), s and c those of half
// the angle: nothing cancels, and at t = 0 all is exact (docs/trajectories.md).
void turn(const Turn& turn, double t, const double* p, double* x) {
  const SineCosine half = sine_cosine(0.5 * (t * turn.angle));
  const double q[3] = {p[0] - turn.centre[0], p[1] - turn.centre[1], p[2] - turn.centre[2]};
  double v[3], w[3];
  cross(turn.axis, q, v);
  cross(turn.axis, v, w);
  for (int a = 0; a < 3; ++a) {
    const double turned = 2 * half.sine * (half.cosine * v[a] + half.sine * w[a]);
    x[a] = p[a] + (t * turn.translation[a] + turned);
  }
}

// The product k x q errs by 9u |q| (docs/trajectories.md).
Orbit orbit_of(const Turn& turn, const double* p) {
  const double q[3] = {p[0] - turn.centre[0], p[1] - turn.centre[1], p[2] - turn.centre[2]};
  double v[3];
  cross(turn.axis, q, v);
  const double distance = length_up(q[0], q[1], q[2]);
  return {length_up(p[0], p[1], p[2]), distance,
          length_up(v[0], v[1], v[2]) + 9.5 * kU * distance + 0x1p-1060};
}

// The last two terms are products, angles and lengths that underflow.
double rounding_of_turn(const Turn& turn, const Orbit& orbit, double t) {
  const double sum = orbit.size + 84 * (t * turn.angle) * orbit.distance + 5 * t * turn.translation_length;
  return (kU * sum) * (1 + 0x1p-30) + 0x1p-1068 * orbit.distance + 0x1p-1050;
}

double straying_of_turn(const Turn& turn, const Orbit& orbit, double t0, double t1) {
  const double quarter = 0.25 * ((t1 - t0) * turn.angle) * (1 + 0x1p-48);
  if (!(quarter < 1.57)) return 2 * orbit.radius;
  const double s = sine_cosine(quarter).sine * (1 + 0x1p-48);
  return 2 * orbit.radius * (s * s) * (1 + 0x1p-48) + 0x1p-1068 * orbit.radius + 0x1p-1050;
}

}  // namespace onset
