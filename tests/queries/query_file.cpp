#include "tests/queries/query_file.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace onset::scenes {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;

static std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> list;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    cell.erase(0, cell.find_first_not_of(" \t\r"));
    cell.erase(cell.find_last_not_of(" \t\r") + 1);
    list.push_back(cell);
  }
  return list;
}

static double quotient(const std::string& numerator, const std::string& denominator) {
  const cpp_rational exact{cpp_int(numerator), cpp_int(denominator)};
  const double rounded = exact.convert_to<double>();
  if (cpp_rational(rounded) != exact) throw std::runtime_error("not a double");
  return rounded;
}

std::vector<LabelledQuery> read_queries(const std::string& path, PairKind kind) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::vector<LabelledQuery> queries;
  int row = 0, line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    const std::vector<std::string> cell = cells(line);
    if (cell.empty()) continue;
    try {
      if (cell.size() != 6 && cell.size() != 7) throw std::runtime_error("not 6 or 7 cells");
      if (row % 8 == 0) queries.push_back({{kind, {}, {}}, cell.size() == 7 && std::stoi(cell[6]) != 0});
      Query& query = queries.back().query;
      Point& point = (row % 8 < 4 ? query.t0 : query.t1)[row % 4];
      for (int k = 0; k < 3; ++k) point[k] = quotient(cell[2 * k], cell[2 * k + 1]);
    } catch (const std::exception& e) {
      throw std::runtime_error(path + ":" + std::to_string(line_number) + ": " + e.what());
    }
    ++row;
  }
  if (row % 8 != 0) throw std::runtime_error(path + ": not 8 rows a query");
  return queries;
}

std::vector<QueryFile> query_files(const std::string& data_folder) {
  std::vector<QueryFile> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data_folder + "/queries"))
    if (entry.path().extension() == ".csv") {
      const bool face = entry.path().parent_path().filename() == "vertex-face";
      files.push_back({entry.path().string(), face ? PairKind::vertex_face : PairKind::edge_edge});
    }
  std::sort(files.begin(), files.end(),
            [](const QueryFile& a, const QueryFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace onset::scenes
