// Queries with truth as text: the benchmark of Wang, Ferguson et al. 2021 (paper, appendix A).
#pragma once

#include <string>
#include <vector>

#include "tests/queries/query.hpp"

namespace onset::scenes {

struct LabelledQuery {
  Query query;
  bool collides = false;
};

// 8 rows a query: numerator and denominator of x, y, z, and the truth (left out in some files: false). Throws
// std::runtime_error naming the line where a quotient is not exactly a double.
std::vector<LabelledQuery> read_queries(const std::string& path, PairKind kind);

// The path and kind of every file below $ONSET_DATA/queries, sorted.
struct QueryFile {
  std::string path;
  PairKind kind;
};
std::vector<QueryFile> query_files(const std::string& data_folder);

}  // namespace onset::scenes
