// A generated query as the exact decision takes it.
#pragma once

#include "narrowphase/exact/exact.hpp"
#include "tests/queries/query.hpp"

namespace onset::scenes {

// Points into the query, which must outlive it.
inline ExactPair exact_pair(const Query& query) {
  ExactPair r{query.kind, {}, {}};
  for (int i = 0; i < 4; ++i) r.t0[i] = query.t0[i].data(), r.t1[i] = query.t1[i].data();
  return r;
}

}  // namespace onset::scenes
