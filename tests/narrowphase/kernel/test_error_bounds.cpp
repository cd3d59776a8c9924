// The rounding errors of the kernels against the bounds that the code uses, in exact arithmetic. The copy of
// the text with contraction on must keep the same bounds.
#include <cmath>

#include "base/unit_roundoff.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/climb.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/narrowphase/kernel/kernel_batch.hpp"
#include "tests/narrowphase/kernel/kernel_values.hpp"
#include "tests/narrowphase/samples.hpp"
#include "tests/queries/random_query.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

struct Input {
  Query query;
  ValuesWanted wanted;
  double t_max = 1;
  bool diagonal = false;  // every axis as the first one: what one of them errs by, all do, in the same sense
};

// |w| <= 1 after rounding, or a little more, as narrowphase/kernel/direction.inl leaves it.
void set_direction(double (&w)[3], Point p) {
  const double n = std::hypot(p[0], p[1], p[2]);
  for (int a = 0; a < 3; ++a) w[a] = n > 0 ? p[a] / n : 0;
}

void keep_diagonal(Input& in) {
  if (!in.diagonal) return;
  for (auto* points : {&in.query.t0, &in.query.t1})
    for (Point& p : *points) p[1] = p[2] = p[0];
  for (auto* w : {&in.wanted.w, &in.wanted.wb}) set_direction(*w, {(*w)[0], (*w)[0], (*w)[0]});
}

Point some_direction(Random& random) {
  Point p = scenes::point(random);
  for (double& x : p)
    if (scenes::integer(random, 0, 5) == 0) x = scenes::integer(random, -1, 1);
  return p;
}

Query some_query(PairKind kind, Random& random) {
  Query query = scenes::mixed_query(kind, random);
  switch (scenes::integer(random, 0, 4)) {
    case 0:  // the far end matters: one time small, the other large
      for (Point& p : query.t0) p = scenes::times(scenes::power_of_ten(random, -12, 0), p);
      break;
    case 1:  // differences of large coordinates
      query = scenes::moved(query, scenes::point(random, scenes::power_of_ten(random, 0, 6)));
      break;
    case 2: {  // nearly a point against nearly a point
      const double size = scenes::power_of_ten(random, -10, 0);
      for (int i = 1; i < 4; ++i)
        if (i != scenes::first_body(kind)) {
          const int base = i < scenes::first_body(kind) ? 0 : scenes::first_body(kind);
          query.t0[i] = scenes::plus(query.t0[base], scenes::point(random, size));
          query.t1[i] = scenes::plus(query.t1[base], scenes::point(random, size));
        }
      break;
    }
    default:
      break;
  }
  return query;
}

Input make_input(PairKind kind, Random& random) {
  Input in;
  in.query = some_query(kind, random);
  // Along a corner every axis counts in full: |w| rho is what the bounds are made of.
  const bool along = scenes::integer(random, 0, 3) > 0;
  const int other = scenes::first_body(kind);
  set_direction(in.wanted.w,
                along ? scenes::minus(in.query.t0[0], in.query.t0[other]) : some_direction(random));
  set_direction(in.wanted.wb,
                along ? scenes::minus(in.query.t1[0], in.query.t1[other]) : some_direction(random));
  in.wanted.t = scenes::integer(random, 0, 3) ? scenes::unit(random) : 0;
  in.wanted.tb = in.wanted.t + (1 - in.wanted.t) * scenes::unit(random);
  in.wanted.u = scenes::unit(random);
  in.wanted.v = scenes::unit(random) * (kind == PairKind::vertex_face ? 1 - in.wanted.u : 1);
  return in;
}

// The motion cut short at t_max below 1; some of t_max are rounded to float by all that can be.
// Half of the time what is left of it is the motion of make_input, and the far end, thrown out along it, is
// as much larger as t_max is short; in a half of those the corners change sides on the way, which makes
// both terms of the cut corner larger than itself.
Input make_cut_input(PairKind kind, Random& random) {
  constexpr double kTMaxes[] = {
      1 - 0x1p-26, 0.5 * (1 + 0x1p-24), 0.7, 1.0 / 3, 0.125 * (1 + 0x1p-24), 0.1, 1e-3, 1e-6};
  Input in = make_input(kind, random);
  in.t_max = scenes::coin(random) ? kTMaxes[scenes::integer(random, 0, 7)] : scenes::unit(random);
  in.t_max = std::max(in.t_max, 0x1p-40);
  in.diagonal = scenes::coin(random);
  if (in.diagonal) {
    set_direction(in.wanted.w, {1, 1, 1});
    set_direction(in.wanted.wb, {1, 1, 1});
    keep_diagonal(in);
  }
  if (scenes::coin(random)) return in;
  const bool changes_sides = scenes::coin(random);
  if (changes_sides)
    for (int a = 0; a < 3; ++a) in.wanted.wb[a] = -in.wanted.w[a];
  for (std::size_t i = 0; i < 4; ++i) {
    if (changes_sides) in.query.t1[i] = scenes::times(-1, in.query.t0[i]);
    const Point way = scenes::minus(in.query.t1[i], in.query.t0[i]);
    in.query.t1[i] = scenes::plus(in.query.t0[i], scenes::times(1 / in.t_max, way));
  }
  return in;
}

Input change_input(Input in, Random& random) {
  const double size = scenes::power_of_ten(random, -16, -0.5);
  const auto nudge = [&](double x) { return nudged(x, size, random); };
  for (int changes = scenes::integer(random, 1, 3); changes > 0; --changes)
    switch (scenes::integer(random, 0, 3)) {
      case 0:
      case 1: {
        double& x = (scenes::coin(random)
                         ? in.query.t0
                         : in.query.t1)[scenes::integer(random, 0, 3)][scenes::integer(random, 0, 2)];
        x = nudge(x);
        break;
      }
      case 2: {
        auto& w = scenes::coin(random) ? in.wanted.w : in.wanted.wb;
        Point p{w[0], w[1], w[2]};
        double& x = p[scenes::integer(random, 0, 2)];
        x = nudge(x);
        set_direction(w, p);
        break;
      }
      default:
        in.wanted.t = std::min(1.0, std::max(0.0, nudge(in.wanted.t)));
        in.wanted.tb = std::max(in.wanted.t, std::min(1.0, nudge(in.wanted.tb)));
        in.wanted.u = std::min(1.0, nudge(in.wanted.u));
        if (in.query.kind == PairKind::vertex_face) in.wanted.v = std::min(in.wanted.v, 1 - in.wanted.u);
    }
  if (in.t_max < 1) in.t_max = std::min(1 - 0x1p-53, nudge(in.t_max));
  keep_diagonal(in);
  return in;
}

using Compute = decltype(&kernel_values_plain);

KernelValues compute(Compute values, const Input& in) {
  KernelBatch batch(in.query.kind);
  batch.add(in.query, 0);
  return values(in.query.kind == PairKind::edge_edge, batch.pairs(1), 0, in.wanted);
}

double ratio(const Rational& error, double bound) {
  return static_cast<double>(abs(error) / Rational(bound));
}

// The bounds, as they stand in narrowphase/kernel/certificates.inl and advance.inl.
double fixed_ratio(Compute values, const Input& in) {
  const KernelValues v = compute(values, in);
  const ExactPair pair(in.query, v.unit);
  double r = 0;
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < pair.corners; ++k)
      r = std::max(r,
                   ratio(Rational(v.g[end][k]) - dot(exact(in.wanted.w), pair.c[end][k]), 4.25 * kU * v.rho));
  return r;
}
double value_ratio(Compute values, const Input& in) {
  const KernelValues v = compute(values, in);
  const ExactPair pair(in.query, v.unit);
  double r = 0;
  for (int k = 0; k < pair.corners; ++k)
    r = std::max(r, ratio(Rational(v.at_t[k]) - dot(exact(in.wanted.w), pair.corner(k, in.wanted.t)),
                          7.25 * kU * v.rho));
  return r;
}
double moving_ratio(Compute values, const Input& in) {
  const KernelValues v = compute(values, in);
  const ExactPair pair(in.query, v.unit);
  const RationalVector w = exact(in.wanted.w), wb = exact(in.wanted.wb);
  const Rational ta(in.wanted.t), tb(in.wanted.tb);
  double r = 0;
  for (int k = 0; k < pair.corners; ++k) {
    const RationalVector ca = pair.corner(k, ta), cb = pair.corner(k, tb);
    const Rational b[3] = {dot(w, ca), (dot(w, cb) + dot(wb, ca)) / 2, dot(wb, cb)};
    for (int i = 0; i < 3; ++i) r = std::max(r, ratio(Rational(v.b[i][k]) - b[i], 8.25 * kU * v.rho));
  }
  return r;
}

// Bernstein coefficients of n(s).c(s) on [t, 1], then on the first share u of that, by subdivision.
void exact_cubic(const ExactPair& pair, const Rational& t, const Rational& u, Rational (&f)[4]) {
  const auto n = [&](int i, int j) { return cross(pair.e[i][0], pair.e[j][1]); };
  const RationalVector mixed = plus(n(0, 1), n(1, 0)), &c0 = pair.c[0][0], &c1 = pair.c[1][0];
  f[0] = dot(n(0, 0), c0);
  f[1] = (dot(n(0, 0), c1) + dot(mixed, c0)) / 3;
  f[2] = (dot(n(1, 1), c0) + dot(mixed, c1)) / 3;
  f[3] = dot(n(1, 1), c1);
  for (int level = 3; level > 0; --level)
    for (int i = 0; i < level; ++i) f[i] = between(f[i], f[i + 1], t);
  for (int level = 1; level < 4; ++level)
    for (int i = 3; i >= level; --i) f[i] = between(f[i - 1], f[i], u);
}
double cubic_ratio(Compute values, const Input& in) {
  const KernelValues v = compute(values, in);
  const ExactPair pair(in.query, v.unit);
  Rational f[4];
  exact_cubic(pair, in.wanted.t, in.wanted.u, f);
  double r = 0;
  for (int i = 0; i < 4; ++i) r = std::max(r, ratio(Rational(v.f[i]) - f[i], v.f_error));
  return r;
}
double normal_ratio(Compute values, const Input& in) {  // |n(s)| <= n_largest, at its control points
  const KernelValues v = compute(values, in);
  const ExactPair pair(in.query, v.unit);
  const RationalVector n00 = cross(pair.e[0][0], pair.e[0][1]), n11 = cross(pair.e[1][0], pair.e[1][1]);
  const RationalVector middle = oracle::scaled<Rational>(
      Rational(0.5), plus(cross(pair.e[0][0], pair.e[1][1]), cross(pair.e[1][0], pair.e[0][1])));
  const Rational squares[3] = {dot(n00, n00), dot(middle, middle), dot(n11, n11)};
  const Rational bound = Rational(v.n_largest) * Rational(v.n_largest);
  double r = 0;
  for (const Rational& s : squares) r = std::max(r, static_cast<double>(s / bound));
  return r;
}
double witness_ratio(Compute values, const Input& in) {  // 10u R per axis
  const KernelValues v = compute(values, in);
  const ExactPair pair(in.query, v.unit);
  const RationalVector f = pair.value(in.wanted.t, in.wanted.u, in.wanted.v);
  double r = 0;
  for (int a = 0; a < 3; ++a) {
    Rational largest = 0;
    for (int end = 0; end < 2; ++end)
      for (int k = 0; k < pair.corners; ++k) largest = std::max<Rational>(largest, abs(pair.c[end][k][a]));
    if (largest == 0) continue;
    r = std::max(r, static_cast<double>(abs(Rational(v.witness[a]) - f[a]) / (largest * Rational(10 * kU))));
  }
  return r;
}
// The coefficients in single precision on [0, t_max], against the motion of `pair`.
double coefficient_error(const KernelValues& v, const ExactPair& pair, double t_max, double bound) {
  const RationalVector w{Rational(v.wf[0]), Rational(v.wf[1]), Rational(v.wf[2])};
  const RationalVector wb{Rational(v.wbf[0]), Rational(v.wbf[1]), Rational(v.wbf[2])};
  double r = 0;
  for (int k = 0; k < pair.corners; ++k) {
    const RationalVector &c0 = pair.c[0][k], c1 = pair.corner(k, Rational(t_max)),
                         middle = between(c0, c1, Rational(0.5));
    const Rational b[5] = {dot(w, c0), (dot(w, c1) + dot(wb, c0)) / 2, dot(wb, c1),
                           (dot(w, middle) + dot(wb, c0)) / 2, dot(wb, middle)};
    for (int i = 0; i < 5; ++i) r = std::max(r, ratio(Rational(v.bf[i][k]) - b[i], bound));
  }
  return r;
}

struct FloatCase {
  KernelBatch batch;
  KernelPairs pairs;
  KernelValues v;

  FloatCase(Compute values, const Input& in, bool rounded) : batch(in.query.kind) {
    batch.add(in.query, 0);
    if (rounded) batch.round();
    pairs = batch.pairs(1);
    pairs.cull_t_max = in.t_max;
    v = values(in.query.kind == PairKind::edge_edge, pairs, 0, in.wanted);
  }
};

double float_ratio(Compute values, const Input& in) {
  const FloatCase f(values, in, false);
  return coefficient_error(f.v, ExactPair(in.query, 1 / f.pairs.scale), in.t_max, f.v.f_bound);
}
double rounded_ratio(Compute values, const Input& in) {
  const FloatCase f(values, in, true);
  return coefficient_error(f.v, ExactPair(in.query, 1 / f.pairs.scale), in.t_max, f.v.f_bound);
}

// Against the motion of the rounded positions: the share of the bound that is not theirs.
double arithmetic_ratio(Compute values, const Input& in) {
  const FloatCase f(values, in, true);
  Query rounded{in.query.kind, {}, {}};
  double of_vertex[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const float* row = f.pairs.rounded + i * kFloatStride;
    for (std::size_t a = 0; a < 3; ++a) rounded.t0[i][a] = row[a], rounded.t1[i][a] = row[4 + a];
    of_vertex[i] = row[3];
  }
  const int second = scenes::first_body(in.query.kind);
  const Rational theirs = Rational(*std::max_element(of_vertex, of_vertex + second)) +
                          Rational(*std::max_element(of_vertex + second, of_vertex + 4));
  const double bound = static_cast<double>(Rational(f.v.f_bound) - theirs);
  return coefficient_error(f.v, ExactPair(rounded, 1), in.t_max, bound);
}

int steps() { return std::max(500, fuzz(500)); }

constexpr ErrorBound<Input, Compute> kBounds[] = {
    {"dot with a corner, E4", make_input, fixed_ratio, 0.35, 6},
    {"dot at a time, E7", make_input, value_ratio, 0.2, 6},
    {"moving direction, E8", make_input, moving_ratio, 0.15, 6},
    {"cubic after two subdivisions, 34u", make_input, cubic_ratio, 0.03, 6},
    {"square of the normal's length", make_input, normal_ratio, 0.9, 6},
    {"witness point, 10u R", make_input, witness_ratio, 0.15, 6},
    {"single precision, 7u", make_input, float_ratio, 0.15, 6},
    {"the same cut short", make_cut_input, float_ratio, 0.15, 10},
    {"rounded positions, 7u and theirs", make_input, rounded_ratio, 0.15, 6},
    {"rounded positions, 7u", make_input, arithmetic_ratio, 0.15, 6},
    {"the same cut short, 16u and theirs", make_cut_input, rounded_ratio, 0.1, 10},
    {"the same cut short, 16u", make_cut_input, arithmetic_ratio, 0.1, 10}};

}  // namespace

TEST_CASE("rounding errors stay within their bounds", "[property][oracle]") {
  check_bounds("plain", kernel_values_plain, kBounds, change_input, steps());
}

#ifdef ONSET_HAVE_FMA
TEST_CASE("rounding errors stay within the same bounds when contracted", "[property][oracle]") {
  if (!__builtin_cpu_supports("fma")) return;
  check_bounds("contracted", kernel_values_contracted, kBounds, change_input, steps());
}
#endif
