// Writes queries of every family with their exact truth, for any program to be asked.
//
//   onset_extreme_queries FOLDER [COUNT] [SEED]
//
// FOLDER/<family>/<vertex-face|edge-edge>/data.csv: COUNT queries in the form of Wang et al. 2021, appendix
// A: eight rows a query, numerator and denominator of x, y, z, and the truth. toi.csv beside it: one row a
// query, two hexadecimal doubles between which the exact time of impact lies, inf,inf without contact.
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/oracle/oracle.hpp"
#include "tests/scenes/families.hpp"

using namespace onset;

namespace {

std::string quotient(double x) {
  const boost::multiprecision::cpp_rational exact(x);
  return numerator(exact).str() + "," + denominator(exact).str();
}

std::string hexadecimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

void write(std::ofstream& data, std::ofstream& toi, const scenes::Query& query) {
  const oracle::Truth truth = oracle::exact_ccd(query);
  for (const auto& points : {query.t0, query.t1})
    for (const Point& p : points)
      data << quotient(p[0]) << "," << quotient(p[1]) << "," << quotient(p[2]) << "," << int(truth.collides)
           << "\n";
  toi << hexadecimal(truth.toi_lo) << "," << hexadecimal(truth.toi_hi) << "\n";
}

void write_family(const std::string& folder, const scenes::Family& family, PairKind kind, int count,
                  std::uint64_t seed) {
  const std::filesystem::path to = std::filesystem::path(folder) / family.name / scenes::name(kind);
  std::filesystem::create_directories(to);
  std::ofstream data(to / "data.csv"), toi(to / "toi.csv");
  scenes::Random random = scenes::seeded(family, kind, seed);
  for (int i = 0; i < count; ++i) write(data, toi, family.make(kind, random));
  data.close(), toi.close();
  if (!data || !toi) throw std::runtime_error(to.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2 || argc > 4) throw std::runtime_error("usage: onset_extreme_queries FOLDER [COUNT] [SEED]");
  const int count = argc > 2 ? std::atoi(argv[2]) : 50;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  for (const scenes::Family& family : scenes::families())
    for (PairKind kind : {PairKind::vertex_face, PairKind::edge_edge})
      write_family(argv[1], family, kind, count, seed);
} catch (const std::exception& e) {
  std::fprintf(stderr, "onset_extreme_queries: %s\n", e.what());
  return 1;
}
