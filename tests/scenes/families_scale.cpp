// Ordinary geometry at extraordinary scales, offsets and speeds.
#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

namespace onset::scenes {

template <int kExponent>
static Query at_scale_of_ten(PairKind kind, Random& random) {
  return scaled(mixed_query(kind, random), std::pow(10.0, kExponent));
}

// Features of size 1e-6 at `offset`: a few bits of the coordinates are left for the geometry.
static Query far_away(PairKind kind, Random& random, double offset) {
  const Point where = point(random, offset);
  return moved(scaled(mixed_query(kind, random), 1e-6), where);
}
static Query offset_1e6(PairKind kind, Random& random) { return far_away(kind, random, 1e6); }
static Query offset_1e8(PairKind kind, Random& random) { return far_away(kind, random, 1e8); }

// Each primitive travels 1e6 times its size.
static Query fast(PairKind kind, Random& random) {
  Query query = random_query(kind, random);
  const Point first = point(random, 1e6), second = point(random, 1e6);
  for (int i = 0; i < 4; ++i) query.t1[i] = plus(query.t0[i], i < first_body(kind) ? first : second);
  aim(query, unit(random), 0.25, 0.5);
  return query;
}

// Every coordinate with its own magnitude.
static Query mixed_magnitudes(PairKind kind, Random& random) {
  Query query = random_query(kind, random);
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points)
      for (double& x : p) x *= power_of_ten(random, -30, 30);
  return query;
}

static Query two_scale(PairKind kind, Random& random) {
  Query query = grid_query(kind, random, 1);
  const Query small = grid_query(kind, random, 2);
  for (int i = 0; i < 4; ++i) {
    query.t0[i] = plus(query.t0[i], times(0x1p-30, small.t0[i]));
    query.t1[i] = plus(query.t1[i], times(0x1p-30, small.t1[i]));
  }
  return query;
}

// Integers times 2^-1074: every difference is exact, every product is not.
static Query subnormal(PairKind kind, Random& random) {
  return scaled(grid_query(kind, random, integer(random, 1, 12)), 0x1p-1074);
}
static Query half_subnormal(PairKind kind, Random& random) {
  const double size = power_of_ten(random, -310, -300);
  return scaled(mixed_query(kind, random), size);
}

// As large as is allowed.
static Query largest(PairKind kind, Random& random) {
  const Query query = mixed_query(kind, random);
  return scaled(query, 0x1p1016);  // mixed coordinates stay below 16
}

std::vector<Family> scale_families() {
  return {{"unit", mixed_query},
          {"milli", at_scale_of_ten<-3>},
          {"tiny", at_scale_of_ten<-12>},
          {"minute", at_scale_of_ten<-200>},
          {"kilo", at_scale_of_ten<3>},
          {"huge", at_scale_of_ten<12>},
          {"enormous", at_scale_of_ten<200>},
          {"largest", largest},
          {"offset_1e6_features_1e-6", offset_1e6},
          {"offset_1e8_features_1e-6", offset_1e8},
          {"displacement_1e6", fast},
          {"mixed_magnitudes", mixed_magnitudes},
          {"two_scale", two_scale},
          {"subnormal", subnormal},
          {"half_subnormal", half_subnormal},
          {"random_full_mantissa", random_query},
          {"interior_full_mantissa", interior_query}};
}

}  // namespace onset::scenes
