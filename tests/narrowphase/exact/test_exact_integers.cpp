// The integers and polynomials that the exact decision stands on.
#include "narrowphase/exact/integer_polynomial.hpp"
#include "narrowphase/exact/wide.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/random.hpp"

using namespace onset;

namespace {

template <int N>
Wide<N> to_wide(Integer x) {
  const bool negative = x < 0;
  if (negative) x = -x;
  Wide<N> r(0);
  for (int i = 0; i < N; ++i, x >>= 64) r.limb[i] = std::uint64_t(x & ~std::uint64_t(0));
  return negative ? -r : r;
}

Integer random_integer(scenes::Random& random, int bits) {
  Integer x = 0;
  for (int i = 0; i < bits; ++i) x = 2 * x + scenes::integer(random, 0, 1);
  return scenes::coin(random) ? x : Integer(-x);
}

template <int N>
bool same(const Wide<N>& a, const Wide<N>& b) {
  return sign_of(a - b) == 0;
}

template <int N>
void check_arithmetic() {
  scenes::Random random(N);
  for (int i = 0; i < 300; ++i) {
    const Integer x = random_integer(random, scenes::integer(random, 0, 32 * N - 2));
    const Integer y = random_integer(random, scenes::integer(random, 0, 32 * N - 2));
    const Wide<N> a = to_wide<N>(x), b = to_wide<N>(y);
    const int shift = scenes::integer(random, 0, 32 * N - 1);
    CHECK(same(a + b, to_wide<N>(x + y)));
    CHECK(same(a - b, to_wide<N>(x - y)));
    CHECK(same(-a, to_wide<N>(-x)));
    CHECK(same(a * b, to_wide<N>(x * y)));
    CHECK(same(shifted(a, shift), to_wide<N>(Integer(x * (Integer(1) << unsigned(shift))))));
    CHECK(sign_of(a) == x.sign());
    CHECK(estimate(a) == Approx(static_cast<double>(x)));
  }
}

IntegerPolynomial with_roots(std::initializer_list<int> eighths) {  // product of (8 t - k)
  IntegerPolynomial p({Integer(1)});
  for (const int k : eighths) p = p * IntegerPolynomial({Integer(-k), Integer(8)});
  return p;
}

}  // namespace

TEST_CASE("limbs compute as integers of any size do", "[unit]") {
  check_arithmetic<2>();
  check_arithmetic<4>();
  check_arithmetic<7>();
  check_arithmetic<8>();
  check_arithmetic<13>();
  for (const std::int64_t x : {std::int64_t(0), std::int64_t(-1), INT64_MAX, INT64_MIN}) {
    CHECK(same(Wide<4>(x), to_wide<4>(Integer(x))));
    CHECK(same(Wide<4>(Int128(x) * x), to_wide<4>(Integer(x) * x)));
    CHECK(same(Wide<8>(Wide<4>(x)), to_wide<8>(Integer(x))));
  }
}

TEST_CASE("roots are isolated, each once and in order", "[unit]") {
  auto roots = isolated_roots(with_roots({0, 3, 3, 8}));
  REQUIRE(roots.size() == 3);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k <= 8; ++k) {
      const int where[] = {0, 3, 8};
      CHECK(sign_at(with_roots({k}), roots[std::size_t(i)]) == (where[i] > k) - (where[i] < k));
    }
  CHECK(isolated_roots(with_roots({-1, 9})).empty());
  CHECK(isolated_roots(IntegerPolynomial({Integer(7)})).empty());
  const IntegerPolynomial near({-(Integer(1) << 99) - 1, Integer(1) << 100});  // 1/2 + 2^-100
  CHECK(isolated_roots(near * with_roots({4, 4})).size() == 2);
}

TEST_CASE("signs at irrational roots, zero among them", "[unit]") {
  const IntegerPolynomial half({Integer(-1), Integer(0), Integer(2)});  // 2 t^2 - 1
  auto roots = isolated_roots(half * with_roots({1}));
  REQUIRE(roots.size() == 2);
  IsolatedRoot& root = roots[1];
  CHECK(sign_at(half, root) == 0);
  CHECK(sign_at(half * IntegerPolynomial({Integer(5), Integer(3)}), root) == 0);
  const Integer digits("7071067811865475244008443621048490392848359376884740");
  const Integer scale = pow(Integer(10), 52);
  CHECK(sign_at(IntegerPolynomial({Integer(-digits), scale}), root) == 1);
  CHECK(sign_at(IntegerPolynomial({Integer(-digits - 1), scale}), root) == -1);
  CHECK(sign_at(IntegerPolynomial({Integer(-3)}), root) == -1);
}
