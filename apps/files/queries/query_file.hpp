// Reads queries with truth: appendix A of Wang, Ferguson et al. 2021.
#pragma once

#include <onset/query.hpp>
#include <string>
#include <vector>

namespace app {

struct TruthQuery {
  std::array<onset::Point, 4> t0, t1;  // vertex-face: v, f0, f1, f2; edge-edge: a0, a1, b0, b1
  bool collides = false;
};

onset::QueryResult ask(onset::PairKind kind, const TruthQuery& query, const onset::Options& options);

// Eight rows a query, each xn,xd,yn,yd,zn,zd,truth. Throws InputError naming file and line.
std::vector<TruthQuery> read_queries(const std::string& path);

}  // namespace app
