// What is true of a vertex and a plane, in rational numbers.
#pragma once

#include <onset/onset.hpp>

#include "tests/oracle/arithmetic/rational.hpp"

namespace onset::tests {

using oracle::Rational;

class HalfSpaceTruth {
 public:
  HalfSpaceTruth(const Plane& plane, double separation, Norm norm) : offset_(plane.offset) {
    Rational sum = 0, squares = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      normal_[a] = Rational(plane.normal[a]);
      squares += normal_[a] * normal_[a];
      sum += oracle::sign(normal_[a]) < 0 ? Rational(-normal_[a]) : normal_[a];
    }
    length_squared_ = squares;
    const Rational d(separation);
    maximum_ = norm == Norm::maximum;
    separation_ = maximum_ ? Rational(d * sum) : Rational(d * d * squares);
  }

  // n.x - offset.
  template <class Row>
  Rational value(const Row& x) const {
    Rational f = -offset_;
    for (int a = 0; a < 3; ++a) f += normal_[std::size_t(a)] * Rational(double(x[a]));
    return f;
  }
  // The sign of the distance less the separation, where n.x - offset is f; negative behind the plane.
  int side(const Rational& f) const {
    if (maximum_) return oracle::sign(Rational(f - separation_));
    if (oracle::sign(separation_) == 0) return oracle::sign(f);
    return oracle::sign(f) <= 0 ? -1 : oracle::sign(Rational(f * f - separation_));
  }
  const Rational& length_squared() const { return length_squared_; }

 private:
  std::array<Rational, 3> normal_;
  Rational offset_, length_squared_, separation_;
  bool maximum_;
};

// A vertex on its way.
struct PlaneWay {
  Rational start, end;
  Rational at(double t) const { return start + Rational(t) * (end - start); }
};

}  // namespace onset::tests
