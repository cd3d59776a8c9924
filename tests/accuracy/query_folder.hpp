// Queries with their exact truth as files that any program can be asked from.
#pragma once

#include <fstream>
#include <string>

#include "tests/oracle/oracle.hpp"
#include "tests/queries/query.hpp"

namespace onset::accuracy {

// FOLDER/<vertex-face|edge-edge>/data.csv: queries in the form of Wang et al. 2021, appendix A: eight rows a
// query, numerator and denominator of x, y, z, and the truth. toi.csv beside it: one row a query, two
// hexadecimal doubles between which the exact time of impact lies, inf,inf without contact.
class QueryFolder {
 public:
  QueryFolder(const std::string& folder, PairKind kind);
  oracle::Truth add(const scenes::Query& query);  // its truth
  void close();                                   // throws std::runtime_error where writing failed

 private:
  std::string path_;
  std::ofstream data_, toi_;
};

std::string hexadecimal(double x);

}  // namespace onset::accuracy
