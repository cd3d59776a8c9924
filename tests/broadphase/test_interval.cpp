// Widened coordinates contain the exact ones, and are not much wider.
#include "broadphase/interval.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/arithmetic/rational.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;
using oracle::Rational;
using scenes::Random;

namespace {

double coordinate(Random& random) {
  switch (scenes::integer(random, 0, 4)) {
    case 0:
      return scenes::integer(random, -3, 3);
    case 1:
      return std::ldexp(scenes::uniform(random, -1, 1), scenes::integer(random, -1074, -1010));
    case 2:
      return std::ldexp(scenes::uniform(random, -1, 1), scenes::integer(random, 1000, 1020));
    default:
      return std::ldexp(scenes::uniform(random, -1, 1), scenes::integer(random, -5, 5));
  }
}

}  // namespace

TEST_CASE("the interval at t_max contains the exact position", "[oracle]") {
  Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x0 = coordinate(random), x1 = scenes::coin(random) ? coordinate(random) : x0 * 1.5;
    const double h = scenes::coin(random) ? scenes::unit(random) : std::ldexp(scenes::unit(random), -40);
    const Rational exact = Rational(x0) + Rational(h) * (Rational(x1) - Rational(x0));
    const Interval found = at_t_max(x0, x1, h);
    const double slack = std::max(std::fabs(x0), std::fabs(x1)) * 0x1p-48 + 0x1p-1068;
    if (!(Rational(found.lo) <= exact && exact <= Rational(found.hi) && found.hi - found.lo <= slack))
      FAIL(std::hexfloat << x0 << " to " << x1 << " at " << h << ": " << found.lo << " " << found.hi);
    if (!(std::min(x0, x1) <= found.lo && found.hi <= std::max(x0, x1))) FAIL("beyond the ends");
  }
  CHECK(at_t_max(0.1, 0.3, 1).lo == 0.3);
  CHECK(at_t_max(0.1, 0.3, 1).hi == 0.3);
}

TEST_CASE("widening by an inflation rounds outward, and not at all without one", "[oracle]") {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const double x = coordinate(random),
                 r = scenes::coin(random) ? std::fabs(coordinate(random)) : std::fabs(x) * 0.1;
    const double lo = widen_down(x, r), hi = widen_up(x, r), slack = (std::fabs(x) + r) * 0x1p-50;
    if (!(Rational(lo) <= Rational(x) - Rational(r) && Rational(hi) >= Rational(x) + Rational(r)))
      FAIL(std::hexfloat << x << " widened by " << r << ": " << lo << " " << hi);
    if (!(x - r - lo <= slack && hi - (x + r) <= slack))
      FAIL("too wide: " << std::hexfloat << x << " by " << r);
    if (!(widen_down(x, 0) == x && widen_up(x, 0) == x)) FAIL("without inflation");
  }
}

TEST_CASE("widening keeps the order of coordinates", "[property]") {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const double x = coordinate(random), next = std::nextafter(x, 1e308), r = std::fabs(coordinate(random));
    if (!(widen_down(x, r) <= widen_down(next, r) && widen_up(x, r) <= widen_up(next, r)))
      FAIL(std::hexfloat << x << " widened by " << r);
  }
}
