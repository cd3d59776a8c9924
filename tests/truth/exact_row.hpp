// A row of an active set against the exact side that its pair came from.
#pragma once

#include <onset/onset.hpp>

#include "tests/catch.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/oracle/arithmetic/polynomial.hpp"
#include "tests/oracle/distance.hpp"

namespace onset::tests {

using Exact = RationalVector;

// The pair's motion in exact arithmetic, in units of a power of two near its size.
struct PairMotion {
  PairKind kind;
  std::array<Exact, 4> x0, x1;
  int exponent = 0;  // of the unit
  double rho = 0;    // the largest corner difference at both ends, rounded up

  explicit PairMotion(const scenes::Query& q) : kind(q.kind) {
    double largest = 0;
    for (const auto* x : {&q.t0, &q.t1})
      for (const Point& p : *x)
        for (std::size_t a = 0; a < 3; ++a) largest = std::max(largest, std::fabs(p[a] - q.t0[0][a]));
    exponent = largest > 0 ? std::ilogb(largest) : 0;
    const Rational scale =
        Rational(std::ldexp(1.0, -exponent / 2)) * Rational(std::ldexp(1.0, -(exponent - exponent / 2)));
    for (std::size_t i = 0; i < 4; ++i) {
      x0[i] = oracle::scaled<Rational>(scale, exact(q.t0[i]));
      x1[i] = oracle::scaled<Rational>(scale, exact(q.t1[i]));
    }
    const std::size_t side = std::size_t(scenes::first_body(kind));
    for (const auto* x : {&x0, &x1})
      for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = side; j < 4; ++j) rho = std::max(rho, length((*x)[i] - (*x)[j]));
  }
  static double length(const Exact& v) {
    return std::sqrt(static_cast<double>(Rational(dot(v, v)))) * (1 + 0x1p-50);
  }
  double in_units(double length) const { return std::ldexp(length, -exponent); }
  std::array<Exact, 4> at(const Rational& t) const {
    std::array<Exact, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = between(x0[i], x1[i], t);
    return x;
  }
  // From second to first.
  Exact shortest(const Rational& t) const {
    const Exact d = oracle::shortest_difference(oracle::relative<Rational>(kind, at(t)));
    return kind == PairKind::vertex_face ? d : oracle::scaled<Rational>(Rational(-1), d);
  }
  // a x b at t, on the side that the first primitive is on just before t (at t = 0: at it); 0 where it is on
  // neither.
  Exact across(double t) const {
    using P = oracle::Polynomial<Rational>;
    std::array<oracle::Vector<P>, 4> x;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t a = 0; a < 3; ++a) x[i][a] = P::linear(x0[i][a], x1[i][a]);
    const oracle::Relative<P> r = oracle::relative<P>(kind, x);
    int turn = kind == PairKind::vertex_face ? 1 : -1;
    const oracle::Relative<Rational> here = oracle::relative<Rational>(kind, at(Rational(t)));
    for (P f = dot(r.q, cross(r.a, r.b)); !f.is_zero(); f = derivative(f), turn = -turn) {
      const int s = oracle::sign<Rational>(f.value(Rational(t)));
      if (s != 0) return oracle::scaled<Rational>(Rational(turn * s), cross(here.a, here.b));
      if (t == 0) break;
    }
    return {0, 0, 0};
  }
};

// How far the closest points are from the boundary of their primitives, as a share of it: 0 at the boundary.
inline double depth(const std::array<double, 4>& w) {
  double r = 1;
  for (const double x : w) r = std::min(r, std::fabs(x));
  return r;
}

enum class Past { closing, parting, any };

struct Counts {
  int rows = 0, flagged = 0, resolved = 0, inside = 0;
};

// One row of an active set against the truth.
class RowCheck {
 public:
  RowCheck(const scenes::Query& q, const ActiveSet& s) : motion_(q), set_(s) {
    t_ = set_[0].toi;
    n_ = exact(set_[0].normal);
    shortest_ = motion_.shortest(Rational(t_));
    gap_ = PairMotion::length(shortest_);
    flagged_ = set_[0].degenerate;
  }

  void check(Past past, Counts& counts) {
    const double rho = motion_.rho;
    CAPTURE(t_, gap_, rho, flagged_, set_[0].normal[0], set_[0].normal[1], set_[0].normal[2], set_[0].speed,
            set_[0].weights[1], set_[0].weights[2], set_[0].weights[3], to_string(set_[0].outcome));
    CHECK(std::fabs(PairMotion::length(n_) - 1) <= 0x1p-49);
    const bool resolved = gap_ > 0x1p-45 * rho, inside = depth(set_[0].weights) > 0x1p-30;
    ++counts.rows, counts.flagged += flagged_, counts.resolved += resolved, counts.inside += inside;
    if (resolved) CHECK_FALSE(flagged_);
    if (gap_ > 0 && !flagged_) check_along(shortest_);
    if (gap_ == 0 && depth(set_[0].weights) == 0) CHECK(flagged_);
    if (gap_ == 0 && t_ == 0) CHECK(flagged_);
    if (inside) check_inside();
    check_weights_and_speed(past);
  }

 private:
  // Parallel to v, in its sense.
  void check_along(const Exact& v) const {
    const double size = PairMotion::length(v);
    CHECK(dot(n_, v) > 0);
    CHECK(PairMotion::length(cross(n_, v)) <= 0x1p-26 * size);
  }
  void check_inside() const {
    const Exact across = motion_.across(t_);
    const bool known = dot(across, across) != 0;
    if (known && plane_is_clear(across)) CHECK_FALSE(flagged_);
    if (known && !flagged_) check_along(across);
    if (gap_ == 0 && !known) CHECK(flagged_);
  }
  bool plane_is_clear(const Exact& across) const {
    return PairMotion::length(across) > 0x1p-40 * motion_.rho * motion_.rho;
  }
  void check_weights_and_speed(Past past) const {
    const auto difference = [&](const std::array<Exact, 4>& x) {
      Exact sum{0, 0, 0};
      for (std::size_t i = 0; i < 4; ++i)
        sum = plus(sum, oracle::scaled<Rational>(Rational(set_[0].weights[i]), x[i]));
      return sum;
    };
    const double noise = 0x1p-47 * motion_.rho + motion_.in_units(0x1p-1074);
    const Exact apart = difference(motion_.at(Rational(t_)));
    CHECK(std::fabs(PairMotion::length(apart) - motion_.in_units(set_[0].gap)) <= noise);
    CHECK(PairMotion::length(apart) <= gap_ + noise);
    const Exact moved = difference(motion_.x1) - difference(motion_.x0);
    const double exact_speed = static_cast<double>(Rational(dot(n_, moved))),
                 speed = motion_.in_units(set_[0].speed);
    CHECK(std::fabs(speed - exact_speed) <= noise);
    const double still = 0x1p-49 * PairMotion::length(moved);
    if (past == Past::closing) {
      CHECK(speed <= still);
      // The constraint of this row holds where the pair comes from.
      CHECK(Rational(dot(n_, difference(motion_.x0))) >= -Rational(gap_ > 0 ? noise : still));
    }
    // Whether a pair parts is asked along a direction in doubles, off by a few roundings of the size over the
    // gap.
    const double tilt = flagged_ || gap_ == 0 ? 0 : 0x1p-44 * motion_.rho / gap_ * PairMotion::length(moved);
    if (past == Past::parting && (flagged_ || gap_ > 0)) CHECK(speed >= -still - tilt);
  }

  const PairMotion motion_;
  const ActiveSet& set_;
  double t_, gap_;
  Exact n_, shortest_;
  bool flagged_;
};

}  // namespace onset::tests
