// Zeros in integers of fixed width, against integers of any size: quadratics that vanish at a cubic's root,
// motion in one plane or on one line.
#include <cmath>

#include "narrowphase/exact/common_root.hpp"
#include "narrowphase/exact/complete.hpp"
#include "narrowphase/exact/coplanar.hpp"
#include "narrowphase/exact/integer_polynomial.hpp"
#include "tests/catch.hpp"
#include "tests/narrowphase/exact/exact_query.hpp"
#include "tests/oracle/promises.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using scenes::Query;
using scenes::Random;

namespace {

Wide<7> wide(const Integer& x) {
  const Integer size = abs(x);
  Wide<7> r(0);
  for (unsigned i = 0; i < 7; ++i) r.limb[i] = std::uint64_t((size >> (64 * i)) & ~std::uint64_t(0));
  return x < 0 ? -r : r;
}

Integer random_integer(Random& random, int bits) {
  Integer x = 0;
  for (int i = scenes::integer(random, 1, bits); i > 0; --i) x = 2 * x + scenes::integer(random, 0, 1);
  return scenes::coin(random) ? x : Integer(-x);
}
IntegerPolynomial random_polynomial(Random& random, int degree, int bits) {
  std::vector<Integer> c;
  for (int i = 0; i <= degree; ++i) c.push_back(random_integer(random, bits));
  return IntegerPolynomial(std::move(c));
}

// Six times the Bernstein coefficients on [0, 1], degree 3, and twice those of degree 2.
void set_bernstein(const IntegerPolynomial& p, Wide<7> (&b)[4]) {
  const auto c = [&](int i) { return i <= p.degree() ? p[i] : Integer(0); };
  b[0] = wide(6 * c(0)), b[1] = wide(6 * c(0) + 2 * c(1)), b[2] = wide(6 * c(0) + 4 * c(1) + 2 * c(2));
  b[3] = wide(6 * (c(0) + c(1) + c(2) + c(3)));
}
void set_bernstein(const IntegerPolynomial& p, Wide<7> (&b)[3]) {
  const auto c = [&](int i) { return i <= p.degree() ? p[i] : Integer(0); };
  b[0] = wide(2 * c(0)), b[1] = wide(2 * c(0) + c(1)), b[2] = wide(2 * (c(0) + c(1) + c(2)));
}

struct Counts {
  int zeros = 0, others = 0;
};
void check_zero(const IntegerPolynomial& f, const IntegerPolynomial& g, Counts& counts, bool narrow = true) {
  if (f.degree() < 1 || g.is_zero() || square_free(f).degree() != f.degree()) return;
  Wide<7> cubic[4], quadratic[3];
  set_bernstein(f, cubic);
  set_bernstein(g, quadratic);
  for (const IsolatedRoot& root : isolated_roots(f)) {
    if (root.exact || root.depth > 24) continue;
    IsolatedRoot at = root;
    const bool zero = sign_at(g, at) == 0;
    const bool changes = sign_at(g, root.k, root.depth) * sign_at(g, root.k + 1, root.depth) < 0;
    const auto k = std::uint64_t(root.k);
    CHECK(vanishes_at_root(WideCommonRoot(), cubic, quadratic, k, int(root.depth), changes) == zero);
    if (narrow)
      CHECK(vanishes_at_root(NarrowCommonRoot(), cubic, quadratic, k, int(root.depth), changes) == zero);
    ++(zero ? counts.zeros : counts.others);
  }
}

Query in_plane(Query query, const scenes::Matrix& map) {
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points) p[2] = 0, p = scenes::product(map, p);
  return query;
}
Query on_line(Query query, const Point& direction) {
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points) p = scenes::times(p[0], direction);
  return query;
}

void check_plane(const Query& query, int& contacts) {
  const ExactPair pair = scenes::exact_pair(query);
  const auto quick = exact_first_contact(pair), complete = complete_first_contact(pair);
  INFO(to_text(query));
  CHECK(quick.has_value() == complete.has_value());
  const ExactAnswer wide = exact_answer(pair, Effort::quick);
  CHECK(wide.answer == (complete ? Answer::yes : Answer::no));
  if (!quick || !complete) return;
  CHECK(wide.time.lo <= complete->lo);
  CHECK(wide.time.hi >= complete->hi);
  CHECK(quick->lo == complete->lo);
  CHECK(quick->hi == complete->hi);
  contacts += complete->hi > 0;
}

}  // namespace

TEST_CASE("a quadratic that is zero at a cubic's root is known to be", "[unit]") {
  Random random(oracle::fuzz_seed() + 51);
  Counts counts;
  for (int i = 0; i < oracle::fuzz(2000); ++i) {
    const int bits = scenes::integer(random, 1, 60);
    const IntegerPolynomial line = random_polynomial(random, 1, bits),
                            other = random_polynomial(random, 1, bits),
                            square = random_polynomial(random, 2, 2 * bits);
    check_zero(line * square, line * other, counts);  // a rational root, in common or not
    check_zero(line * square, square, counts);        // the quadratic divides the cubic
    check_zero(square, square, counts);               // ... whose degree is less
    check_zero(line * other, line, counts);           // that of both
    check_zero(line * square, line * other + IntegerPolynomial({Integer(1)}), counts);
    check_zero(random_polynomial(random, 3, 3 * bits), square, counts);
  }
  CHECK(counts.zeros > oracle::fuzz(1000));
  CHECK(counts.others > oracle::fuzz(1000));
}

// As large as coordinates below 2^62 and 2^120 can make them.
TEST_CASE("a common root of the largest polynomials", "[unit]") {
  Random random(oracle::fuzz_seed() + 52);
  for (const unsigned bits : {62, 120}) {
    Counts counts;
    const Integer big = Integer(1) << bits;
    const auto near_big = [&] { return Integer(big - scenes::integer(random, 0, 9)); };
    const auto of_any_sign = [&](const Integer& x) { return scenes::coin(random) ? x : Integer(-x); };
    for (int i = 0; i < 400; ++i) {
      const IntegerPolynomial line(
          {Integer(-(near_big() * scenes::integer(random, 1, 999)) / 1000), near_big()});
      const IntegerPolynomial other({of_any_sign(near_big()), near_big()});
      const IntegerPolynomial square(
          {near_big() * near_big(), of_any_sign(near_big() * big), near_big() * near_big()});
      check_zero(line * square, line * other, counts, bits == 62);
      check_zero(line * square, line * other + IntegerPolynomial({Integer(1)}), counts, bits == 62);
    }
    CHECK(counts.zeros > 300);
    CHECK(counts.others > 300);
  }
}

TEST_CASE("motion in one plane: the first contact as the complete decision has it", "[property]") {
  Random random(oracle::fuzz_seed() + 53);
  int contacts = 0;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (int i = 0; i < oracle::fuzz(600); ++i) {
      const Query query = scenes::grid_query(kind, random, scenes::integer(random, 1, 48));
      check_plane(in_plane(query, scenes::integer_matrix(random)), contacts);
      check_plane(in_plane(query, {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}}), contacts);
    }
  CHECK(contacts > 100);
}

// Two points pass each other on a line, or just meet: double roots, too.
TEST_CASE("motion on one line: the first contact as the complete decision has it", "[property]") {
  Random random(oracle::fuzz_seed() + 54);
  int contacts = 0;
  for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
    for (int i = 0; i < oracle::fuzz(600); ++i) {
      Query query = scenes::grid_query(kind, random, scenes::integer(random, 1, 45));
      const Point direction = {1, double(scenes::integer(random, -2, 2)),
                               double(scenes::integer(random, 0, 3))};
      check_plane(on_line(query, direction), contacts);
      query.t1[0] = query.t0[1];  // end where another starts
      check_plane(on_line(query, direction), contacts);
    }
  CHECK(contacts > 100);
}

// As large as the widths allow: all of 61 or 120 bits.
TEST_CASE("motion in one plane of many bits", "[unit]") {
  Random random(oracle::fuzz_seed() + 55);
  for (const int bits : {61, 120}) {
    int contacts = 0;
    const double large = std::ldexp(1 - 0x1p-53, bits), half = std::ldexp(1.0, bits - 1);
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
      for (int i = 0; i < oracle::fuzz(400); ++i) {
        Query query = scenes::grid_query(kind, random, 3);
        for (auto* points : {&query.t0, &query.t1})
          for (Point& p : *points)
            for (double& x : p) {
              const double size = scenes::coin(random) ? large : half;
              x = scenes::integer(random, 0, 5) == 0 ? x : x > 0 ? size : x < 0 ? -size : 0.5 * half;
            }
        check_plane(in_plane(query, {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}), contacts);
      }
    CHECK(contacts > 30);
  }
}

// The last bit of a coordinate decides between a hit of the shared edge and a miss.
TEST_CASE("contact on the boundary, at a time that is no double, is certain without much effort", "[unit]") {
  const Query hit{PairKind::vertex_face,
                  {{{0, 1, 3}, {0, 0, 0}, {0, 3, 0}, {5, 0, 0}}},
                  {{{0, 1, -4}, {0, 0, 0}, {0, 3, 0}, {5, 0, 0}}}};
  const ExactAnswer yes = exact_answer(scenes::exact_pair(hit), Effort::quick);
  CHECK(yes.answer == Answer::yes);
  Query miss = hit;
  miss.t0[0][0] = miss.t1[0][0] = -0x1p-50;
  CHECK(exact_answer(scenes::exact_pair(miss), Effort::quick).answer == Answer::no);
}

// A vertex at 2^-52 from an edge as long, on the way to it by 2^52 a step: 2^-104 of the step. Doubles beside
// that have more bits than the integers of fixed width have room for.
TEST_CASE("motion in one plane: a contact after 2^-104 of the step", "[unit]") {
  for (const double hidden : {1.0, 3.0}) {
    Query query{PairKind::vertex_face, {}, {}};
    query.t0 = {{{1, 0, 0}, {0, 0, 0}, {0x1p52, 1, 0}, {0, 0x1p52, 0}}};
    query.t1 = query.t0;
    query.t1[0][1] += hidden * 0x1p52;
    const auto time = exact_first_contact(scenes::exact_pair(query)),
               complete = complete_first_contact(scenes::exact_pair(query));
    CAPTURE(hidden);
    REQUIRE((time && complete));
    CHECK((time->lo == complete->lo && time->hi == complete->hi));
    CHECK((time->lo <= 0x1p-104 / hidden && time->hi >= 0x1p-104 / hidden));
    CHECK(time->hi <= std::nextafter(time->lo, 1));
    query.t1[0][1] = -0x1p52;  // and away
    CHECK_FALSE(exact_first_contact(scenes::exact_pair(query)));
  }
}
