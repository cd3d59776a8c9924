#include "tests/accuracy/query_folder.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace onset::accuracy {
namespace {

std::string quotient(double x) {
  const boost::multiprecision::cpp_rational exact(x);
  return numerator(exact).str() + "," + denominator(exact).str();
}

}  // namespace

std::string hexadecimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

QueryFolder::QueryFolder(const std::string& folder, PairKind kind) {
  const std::filesystem::path to = std::filesystem::path(folder) / scenes::name(kind);
  std::filesystem::create_directories(to);
  path_ = to.string();
  data_.open(to / "data.csv");
  toi_.open(to / "toi.csv");
}

oracle::Truth QueryFolder::add(const scenes::Query& query) {
  const oracle::Truth truth = oracle::exact_ccd(query);
  for (const auto& points : {query.t0, query.t1})
    for (const Point& p : points)
      data_ << quotient(p[0]) << "," << quotient(p[1]) << "," << quotient(p[2]) << "," << int(truth.collides)
            << "\n";
  toi_ << hexadecimal(truth.toi_lo) << "," << hexadecimal(truth.toi_hi) << "\n";
  return truth;
}

void QueryFolder::close() {
  data_.close(), toi_.close();
  if (!data_ || !toi_) throw std::runtime_error(path_ + ": cannot be written");
}

}  // namespace onset::accuracy
