// Root finders that other codes use, to be asked the same queries as the library.
#pragma once

#include <onset/query.hpp>
#include <onset/result.hpp>

#include "files/queries/query_file.hpp"

namespace app {

struct FinderAnswer {
  bool collides = false;
  double toi = 1;
  bool cut = false;  // gave up at the limit of boxes, and said "collides" at the time it had reached
};

struct FinderLimits {
  double width = 1e-6;  // delta: boxes of the parameters narrower than this are accepted as roots
  int boxes = 100'000;  // of one query
};

// Interval root finder on F(t, u, v) (paper, eq. 1 and 2; Snyder 1992): natural interval extension with
// Boost.Interval, earliest box first, the widest parameter bisected.
FinderAnswer interval_multivariate(onset::PairKind kind, const TruthQuery& query, const FinderLimits& limits);

// The same on the cubic of coplanarity (paper, eq. 3); an interval of t that may hold a root is tested for
// contact by interval arithmetic on the barycentric coordinates.
FinderAnswer interval_univariate(onset::PairKind kind, const TruthQuery& query, const FinderLimits& limits);

// What most codes do: the cubic's real roots in floating point, each kept if the barycentric coordinates
// there are inside up to `tolerance`. Nothing is found where the cubic vanishes or the normal is zero.
FinderAnswer floating_point_cubic(onset::PairKind kind, const TruthQuery& query, double tolerance = 1e-6);

}  // namespace app
