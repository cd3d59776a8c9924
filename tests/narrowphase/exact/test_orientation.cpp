#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "narrowphase/exact/orientation.hpp"
#include "tests/catch.hpp"

using Rational = boost::multiprecision::cpp_rational;

namespace {

int exact_sign(const double (&p)[4][3]) {
  Rational m[3][3];
  for (int r = 0; r < 3; ++r)
    for (int i = 0; i < 3; ++i) m[r][i] = Rational(p[r][i]) - Rational(p[3][i]);
  const Rational det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                       m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det.sign();
}

int computed_sign(const double (&p)[4][3]) { return onset::orientation(p[0], p[1], p[2], p[3]); }

}  // namespace

TEST_CASE("orientation agrees with rationals on points within rounding of a plane", "[unit][oracle]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    double p[4][3];
    for (auto& point : p)
      for (double& x : point) x = std::ldexp(uniform(random), i % 60 - 30);
    for (int a = 0; a < 3; ++a)
      p[3][a] = 0.25 * p[0][a] + 0.5 * p[1][a] + 0.25 * p[2][a];  // rounded: almost coplanar
    if (i % 3 == 0) p[3][i % 2] = std::nextafter(p[3][i % 2], INFINITY);
    if (i % 5 == 0)
      for (auto& point : p) point[1] = point[0];  // exactly coplanar
    const int sign = exact_sign(p);
    zeros += sign == 0;
    REQUIRE(computed_sign(p) == sign);
  }
  CHECK(zeros > 0);
}

TEST_CASE("orientation says so when exact products would underflow", "[unit]") {
  const double p[4][3] = {{1, 0, 0}, {0, 0x1p-900, 0}, {0, 0, 1}, {0, 0, 0}};
  CHECK(computed_sign(p) == onset::kUnknownSide);
}

TEST_CASE("orientation agrees with rationals on subnormal points", "[unit][oracle]") {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> few(-3, 3);
  int signs[3] = {};
  for (int i = 0; i < 2000; ++i) {
    double p[4][3];
    for (auto& point : p)
      for (double& x : point) x = few(random) * std::ldexp(1.0, -1074 + i % 60);
    const int sign = exact_sign(p);
    ++signs[sign + 1];
    REQUIRE(computed_sign(p) == sign);
  }
  for (const int count : signs) CHECK(count > 100);
}
