// The algebra below the oracle: polynomials, isolated roots, signs at irrational numbers.
#include "tests/catch.hpp"
#include "tests/oracle/arithmetic/root.hpp"
#include "tests/scenes/random.hpp"

using namespace onset::oracle;
using P = Polynomial<Rational>;

static P polynomial(std::initializer_list<int> coefficients) {
  std::vector<Rational> c;
  for (int x : coefficients) c.emplace_back(x);
  return P(c);
}
static P with_root(const Rational& r) { return P({-r, Rational(1)}); }

TEST_CASE("rounding to doubles encloses, and is exact for doubles", "[unit][oracle]") {
  const double samples[] = {0.0, 1.0, -1.0, 0x1p-1074, -0x1p-1074, 0x1.fffffffffffffp-1022, 0.1, 1e300};
  for (double x : samples) {
    CHECK(round_down(Rational(x)) == x);
    CHECK(round_up(Rational(x)) == x);
    const Rational between = (Rational(x) + Rational(std::nextafter(x, INFINITY))) / 2;
    CHECK(round_down(between) == x);
    CHECK(round_up(between) == std::nextafter(x, INFINITY));
  }
}

TEST_CASE("division and greatest common divisors of polynomials", "[unit][oracle]") {
  const P a = with_root(Rational(1) / 3), b = with_root(2), c = polynomial({1, 0, 1});
  const Division<Rational> d = divide(a * b * c + polynomial({7}), a * c);
  CHECK((d.quotient - b).is_zero());
  CHECK((d.remainder - polynomial({7})).is_zero());
  CHECK((gcd(a * b, a * c * polynomial({5})) - a).is_zero());
  CHECK(gcd(a, b).degree() == 0);
  CHECK((gcd(P(), a) - a).is_zero());
  CHECK(gcd(P(), P()).is_zero());
  CHECK((square_free(a * a * a * b) - a * b).is_zero());
}

TEST_CASE("roots are found once each, in order, with their ends", "[unit][oracle]") {
  const P f = with_root(0) * with_root(0) * with_root(Rational(1) / 3) * with_root(Rational(1) / 2) *
              with_root(1) * with_root(2) * with_root(-1);
  const auto roots = roots_in_unit_interval(f);
  REQUIRE(roots.size() == 4);
  CHECK(to_doubles(roots[0]).hi == 0);
  CHECK(to_doubles(roots[1]).lo == round_down<Rational>(Rational(1) / 3));
  CHECK(to_doubles(roots[1]).hi == round_up<Rational>(Rational(1) / 3));
  CHECK(to_doubles(roots[2]).lo == 0.5);
  CHECK(to_doubles(roots[2]).hi == 0.5);
  CHECK(to_doubles(roots[3]).lo == 1);
  CHECK(roots_in_unit_interval(polynomial({1, 0, 1})).empty());
  CHECK(roots_in_unit_interval(polynomial({3})).empty());
}

TEST_CASE("signs at an irrational root", "[unit][oracle]") {
  auto roots = roots_in_unit_interval(polynomial({-1, 0, 2}));  // sqrt(1/2)
  REQUIRE(roots.size() == 1);
  auto root = roots[0];
  const Rational close = Rational(std::sqrt(0.5)), ulp = Rational(0x1p-53);
  CHECK(sign_at(with_root(close - ulp), root) > 0);
  CHECK(sign_at(with_root(close + ulp), root) < 0);
  CHECK(sign_at(polynomial({-1, 0, 2}) * polynomial({3, 1}), root) == 0);
  CHECK(sign_at(P(), root) == 0);
  CHECK(sign_at(polynomial({-3}), root) < 0);
  CHECK(sign_at(polynomial({-1, 0, 2}) * with_root(5) + with_root(close + ulp), root) < 0);
  const Bracket bracket = to_doubles(root);
  CHECK(std::nextafter(bracket.lo, 1) == bracket.hi);
  CHECK(Rational(bracket.lo) * Rational(bracket.lo) * 2 < 1);
  CHECK(Rational(bracket.hi) * Rational(bracket.hi) * 2 > 1);
}

TEST_CASE("random products of linear factors give their roots back", "[property][oracle]") {
  onset::scenes::Random random(1);
  for (int round = 0; round < 200; ++round) {
    P f = polynomial({1});
    std::vector<Rational> expected;
    const int degree = onset::scenes::integer(random, 1, 4),
              denominator = onset::scenes::integer(random, 1, 12);
    for (int i = 0; i < degree; ++i) {
      const Rational root = Rational(onset::scenes::integer(random, -2, denominator + 2)) / denominator;
      f = f * with_root(root);
      if (root >= 0 && root <= 1) expected.push_back(root);
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    auto roots = roots_in_unit_interval(f);
    REQUIRE(roots.size() == expected.size());
    for (std::size_t i = 0; i < roots.size(); ++i) {
      CHECK(sign_at(with_root(expected[i]), roots[i]) == 0);
      CHECK(sign_at(f, roots[i]) == 0);
      CHECK(sign_at(with_root(expected[i] + Rational(1) / 1000000), roots[i]) < 0);
      CHECK(to_doubles(roots[i]).lo == round_down(expected[i]));
      CHECK(to_doubles(roots[i]).hi == round_up(expected[i]));
    }
  }
}
