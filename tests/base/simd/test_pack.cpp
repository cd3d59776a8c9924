// Packs of plain arrays and packs of AVX2 and AVX-512 registers are the same for every input.
#include <cmath>
#include <cstring>
#include <limits>

#include "base/instruction_set.hpp"
#include "tests/base/simd/pack_operations.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/scenes/random.hpp"

#ifdef ONSET_HAVE_AVX2

using namespace onset;
using namespace onset::tests;
using scenes::Random;

namespace {

template <class T>
T from_random_bits(Random& random) {
  const std::uint64_t bits = random();
  T x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

// Any bit pattern, values that tie, subnormal and signed zero ones, infinities, NaN.
template <class T>
T some_value(Random& random) {
  using L = std::numeric_limits<T>;
  const T special[] = {T(0),
                       -T(0),
                       L::denorm_min(),
                       -L::denorm_min(),
                       L::min(),
                       -L::min(),
                       L::max(),
                       -L::max(),
                       L::infinity(),
                       -L::infinity(),
                       L::quiet_NaN(),
                       -L::quiet_NaN(),
                       T(1),
                       T(-1),
                       std::nextafter(T(1), T(2))};
  switch (scenes::integer(random, 0, 4)) {
    case 0:
      return special[scenes::integer(random, 0, 14)];
    case 1:
      return from_random_bits<T>(random);
    case 2:
      return T(scenes::integer(random, -3, 3));
    case 3:
      return L::min() * T(scenes::uniform(random, -2, 2));
    default:
      return T(scenes::uniform(random, -1, 1));
  }
}

template <class T>
bool same_bits(T a, T b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class T, std::size_t N, std::size_t Lanes>
bool same(const T (&a)[N][Lanes], const T (&b)[N][Lanes], bool any_nan) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t l = 0; l < Lanes; ++l)
      if (!same_bits(a[i][l], b[i][l]) && !(any_nan && a[i][l] != a[i][l] && b[i][l] != b[i][l]))
        return false;
  return true;
}

void compare(PackResults (*operations)(const PackInputs&)) {
  Random random(71);
  for (int i = 0; i < fuzz(200000); ++i) {
    PackInputs in;
    for (double* p : {in.a, in.b, in.c})
      for (int l = 0; l < kDoubles; ++l) p[l] = some_value<double>(random);
    for (float* p : {in.x, in.y, in.z})
      for (int l = 0; l < kFloats; ++l) p[l] = some_value<float>(random);
    const PackResults s = pack_operations_scalar(in), v = operations(in);
    if (!same(s.arithmetic_d, v.arithmetic_d, true) || !same(s.arithmetic_f, v.arithmetic_f, true) ||
        !same(s.exact_d, v.exact_d, false) || !same(s.exact_f, v.exact_f, false) ||
        std::memcmp(s.masks, v.masks, sizeof s.masks) != 0 || s.compressed_count != v.compressed_count ||
        std::memcmp(s.compressed, v.compressed, sizeof s.compressed) != 0)
      FAIL_CHECK("inputs " << i);
  }
}

}  // namespace

TEST_CASE("pack operations give the same bits on every instruction set", "[simd][property]") {
  if (has_avx2()) compare(pack_operations_avx2);
#ifdef ONSET_HAVE_AVX512
  if (has_avx512()) compare(pack_operations_avx512);
#endif
}

// What the comments in base/simd/pack.hpp promise.
TEST_CASE("min and max give their second operand on a tie or NaN", "[simd]") {
  PackInputs in{};
  const double a[kDoubles] = {0.0, -0.0, NAN, 1}, b[kDoubles] = {-0.0, 0.0, 1, NAN};
  std::memcpy(in.a, a, sizeof a);
  std::memcpy(in.b, b, sizeof b);
  const PackResults s = pack_operations_scalar(in);
  CHECK(same_bits(s.exact_d[0][0], in.b[0]));
  CHECK(same_bits(s.exact_d[0][1], in.b[1]));
  CHECK(s.exact_d[0][2] == 1);
  CHECK(std::isnan(s.exact_d[0][3]));
}

TEST_CASE("the power of two brings a value into [1, 2)", "[unit]") {
  Random random(72);
  for (int i = 0; i < 1000; ++i) {
    PackInputs in{};
    for (double& x : in.a) x = std::ldexp(1 + scenes::unit(random), scenes::integer(random, -1022, 1022));
    const PackResults r = pack_operations_scalar(in);
    for (int l = 0; l < kDoubles; ++l) {
      const double scaled = in.a[l] * r.exact_d[5][l];
      CHECK(scaled >= 1);
      CHECK(scaled < 2);
      CHECK(std::ldexp(scaled, std::ilogb(in.a[l])) == in.a[l]);
    }
  }
}

TEST_CASE("the table of lanes is made at run time as by the compiler", "[unit]") {
  CHECK(lane_table_is_made_again());
}

#else
TEST_CASE("this build has one kind of pack", "[simd]") { SUCCEED(); }
#endif
