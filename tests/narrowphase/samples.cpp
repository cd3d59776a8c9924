#include "tests/narrowphase/samples.hpp"

#include <algorithm>
#include <cmath>

#include "tests/queries/random_query.hpp"

namespace onset::tests {

using scenes::Query;
using scenes::Random;

static Query small_integers(PairKind kind, Random& random) {
  const int most = scenes::integer(random, 1, 3);
  Query query;
  query.kind = kind;
  for (auto* points : {&query.t0, &query.t1})
    for (Point& p : *points)
      for (double& x : p) x = scenes::integer(random, -most, most);
  return query;
}

// Column j equals column i, or its negative.
static Query equal_columns(PairKind kind, Random& random) {
  const int i = scenes::integer(random, 0, 2), j = (i + scenes::integer(random, 1, 2)) % 3;
  const double sign = scenes::coin(random) ? 1 : -1;
  return mapped(scenes::mixed_query(kind, random), [&](Point p) {
    p[j] = sign * p[i];
    return p;
  });
}

static Query all_columns_equal(PairKind kind, Random& random) {
  return mapped(scenes::mixed_query(kind, random), [](const Point& p) { return Point{p[0], -p[0], p[0]}; });
}

// The same width on all axes, different motion: one point at each end of [-1, 1] on every axis.
static Query equal_extents(PairKind kind, Random& random) {
  Query query = scenes::mixed_query(kind, random);
  for (int axis = 0; axis < 3; ++axis) {
    const int low = scenes::integer(random, 0, 7), high = (low + scenes::integer(random, 1, 7)) % 8;
    for (int i = 0; i < 8; ++i) {
      double& x = (i < 4 ? query.t0 : query.t1)[i % 4][axis];
      x = i == low ? -1 : i == high ? 1 : std::clamp(x, -1.0, 1.0);
    }
  }
  return query;
}

static Query planar(PairKind kind, Random& random) {
  const int axis = scenes::integer(random, 0, 2);
  return mapped(scenes::mixed_query(kind, random), [&](Point p) {
    p[axis] = 0;
    return p;
  });
}

// The first primitive is translated along one axis, the other is at rest.
static Query along_axis(PairKind kind, Random& random) {
  Query query = scenes::coin(random) ? small_integers(kind, random) : scenes::random_query(kind, random);
  query.t1 = query.t0;
  const int axis = scenes::integer(random, 0, 2);
  const double step = scenes::integer(random, -4, 4);
  for (int i = 0; i < scenes::first_body(kind); ++i) query.t1[i][axis] += step;
  return query;
}

// A column of small integers, which holds for sums of two others: ties in projections, not only in columns.
static Query integer_plane(PairKind kind, Random& random) {
  return mapped(small_integers(kind, random), [](const Point& p) { return Point{p[0], p[1], p[0] + p[1]}; });
}

std::vector<Source> tied_sources() {
  return {{"small integers", small_integers},
          {"equal columns", equal_columns},
          {"all columns equal", all_columns_equal},
          {"equal extents", equal_extents},
          {"planar", planar},
          {"along an axis", along_axis},
          {"integer plane", integer_plane}};
}

std::vector<Source> all_sources() {
  std::vector<Source> all;
  for (const scenes::Family& family : scenes::families()) all.push_back({family.name, family.make});
  for (const Source& source : tied_sources()) all.push_back(source);
  return all;
}

Random seeded(const Source& source, PairKind kind, std::uint64_t seed) {
  return scenes::seeded({source.name.c_str(), source.make}, kind, seed);
}

double extent(const Query& query) {
  Point largest{};
  const int first = scenes::first_body(query.kind);
  for (const auto* x : {&query.t0, &query.t1})
    for (int i = 0; i < first; ++i)
      for (int j = first; j < 4; ++j)
        for (int a = 0; a < 3; ++a) largest[a] = std::max(largest[a], std::fabs((*x)[i][a] - (*x)[j][a]));
  return std::hypot(largest[0], largest[1], largest[2]) * (1 + 0x1p-50);
}

}  // namespace onset::tests
