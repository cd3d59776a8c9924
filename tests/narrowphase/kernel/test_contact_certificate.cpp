// The errors of the certificate that a contact is real (narrowphase/kernel/contact_certificate.inl) against
// its bounds, in exact arithmetic.
#include "onset/options.hpp"
#include "tests/catch.hpp"
#include "tests/fuzz.hpp"
#include "tests/narrowphase/climb.hpp"
#include "tests/narrowphase/exact/exact_pair.hpp"
#include "tests/narrowphase/kernel/kernel_batch.hpp"
#include "tests/narrowphase/kernel/kernel_values.hpp"
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;
using namespace onset::tests;
using scenes::Query;
using scenes::Random;

namespace {

struct Input {
  Query query;
  double time = 0, width = 0;  // of the bracket: at most 1/64
  double where = 0;            // [-1, 1], in the bracket
};

// Neither rounding below the normal range nor overflow: those are the certificate's other guards.
bool has_moderate_size(const Query& query) {
  for (const auto* points : {&query.t0, &query.t1})
    for (const Point& p : *points)
      for (const double x : p)
        if (x != 0 && !(std::fabs(x) < 1e60 && std::fabs(x) > 1e-60)) return false;
  return true;
}

Input make_input(PairKind kind, Random& random) {
  Input in;
  const auto& families = scenes::families();
  if (scenes::coin(random)) {
    in.query = scenes::mixed_query(kind, random);
  } else {
    do
      in.query =
          families[std::size_t(scenes::integer(random, 0, int(families.size()) - 1))].make(kind, random);
    while (!has_moderate_size(in.query));
  }
  if (scenes::coin(random))  // differences of large coordinates
    in.query = scenes::moved(in.query, scenes::point(random, scenes::power_of_ten(random, 0, 6)));
  in.time = scenes::unit(random);
  in.width = scenes::coin(random) ? scenes::power_of_ten(random, -16, -1.81) : 0;
  in.where = scenes::coin(random) ? (scenes::coin(random) ? 1 : -1) : scenes::uniform(random, -1, 1);
  return in;
}

Input change_input(Input in, Random& random) {
  const double size = scenes::power_of_ten(random, -16, -0.5);
  const auto nudge = [&](double x) { return nudged(x, size, random); };
  for (int changes = scenes::integer(random, 1, 3); changes > 0; --changes) {
    auto& points = scenes::coin(random) ? in.query.t0 : in.query.t1;
    double& x =
        points[std::size_t(scenes::integer(random, 0, 3))][std::size_t(scenes::integer(random, 0, 2))];
    x = nudge(x);
    if (scenes::coin(random)) in.time = std::clamp(nudge(in.time), 0.0, 1.0);
  }
  return in;
}

// q, a, b of the exact motion.
struct Vectors {
  RationalVector q, a, b;
};
Vectors vectors_at(const Query& query, const Rational& t) {
  RationalVector x[4];
  for (int i = 0; i < 4; ++i)
    x[i] = between(exact(query.t0[std::size_t(i)]), exact(query.t1[std::size_t(i)]), t);
  if (query.kind == PairKind::edge_edge) return {x[2] - x[0], x[1] - x[0], x[2] - x[3]};
  return {x[0] - x[1], x[2] - x[1], x[3] - x[1]};
}

using Compute = decltype(&contact_values_plain);
ContactValues compute(Compute values, const Input& in) {
  KernelBatch batch(in.query.kind);
  batch.add(in.query, 0);
  return values(in.query.kind == PairKind::edge_edge, batch.pairs(1), 0, in.time, in.width);
}

double ratio(const Rational& error, double bound) {
  return static_cast<double>(Rational(abs(error) / Rational(bound)));
}

double cubic_ratio(Compute values, const Input& in) {
  const ContactValues v = compute(values, in);
  const Vectors r = vectors_at(in.query, Rational(in.time));
  const Rational scale(v.scale);
  const Rational f = 3 * scale * scale * scale * dot(r.q, cross(r.a, r.b));
  return ratio(Rational(v.cubic) - f, v.cubic_error);
}

double inside_ratio(Compute values, const Input& in) {
  const ContactValues v = compute(values, in);
  Rational t = Rational(in.time) + Rational(in.width) * Rational(in.where);
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const Vectors r = vectors_at(in.query, t);
  const RationalVector n = exact(v.n);
  const Rational square = Rational(v.scale) * Rational(v.scale);
  const Rational u = square * dot(n, cross(r.q, r.b)), w = square * dot(n, cross(r.a, r.q)),
                 big_n = square * dot(n, cross(r.a, r.b));
  const double up = 1 + 0x1p-48;
  double largest = std::max({ratio(Rational(v.u) - u, v.eu), ratio(Rational(v.v) - w, v.ev),
                             ratio(Rational(v.big_n) - big_n, v.en)});
  if (in.query.kind == PairKind::vertex_face)
    return std::max(largest,
                    ratio(Rational(v.big_n - v.u - v.v) - (big_n - u - w), (v.eu + v.ev + v.en) * up));
  largest = std::max(largest, ratio(Rational(v.big_n - v.u) - (big_n - u), (v.eu + v.en) * up));
  return std::max(largest, ratio(Rational(v.big_n - v.v) - (big_n - w), (v.ev + v.en) * up));
}

int steps() { return std::max(100, fuzz(200)); }

constexpr ErrorBound<Input, Compute> kBounds[] = {
    {"contact's cubic, 350u Mq Ma Mb", make_input, cubic_ratio, 0.005, 40},
    {"inside functions in a bracket", make_input, inside_ratio, 0.1, 40}};

}  // namespace

TEST_CASE("the certificate of a contact errs by less than its bounds", "[property][oracle]") {
  check_bounds("plain", contact_values_plain, kBounds, change_input, steps());
}

#ifdef ONSET_HAVE_FMA
TEST_CASE("the certificate of a contact errs by less than its bounds when contracted", "[property][oracle]") {
  if (!__builtin_cpu_supports("fma")) return;
  check_bounds("contracted", contact_values_contracted, kBounds, change_input, steps());
}
#endif
