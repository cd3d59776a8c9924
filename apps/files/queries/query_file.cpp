#include "files/queries/query_file.hpp"

#include <algorithm>
#include <string_view>

#include "files/error.hpp"
#include "files/input.hpp"
#include "files/queries/rational.hpp"
#include "files/text_lines.hpp"

namespace app {
namespace {

constexpr std::size_t kRows = 8, kFields = 7;

struct Row {
  onset::Point point;
  bool truth;
};

std::string_view trim(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\r"), last = s.find_last_not_of(" \t\r");
  return first == s.npos ? std::string_view() : s.substr(first, last - first + 1);
}

std::array<std::string_view, kFields> split(std::string_view line) {
  std::array<std::string_view, kFields> fields;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin <= line.size(); ++count) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    if (count < kFields) fields[count] = trim(line.substr(begin, end - begin));
    begin = end + 1;
  }
  if (count != kFields) throw InputError(std::to_string(count) + " fields, 7 expected");
  return fields;
}

Row parse_row(std::string_view line) {
  const auto f = split(line);
  if (f[6] != "0" && f[6] != "1") throw InputError("truth " + quoted(f[6]) + ", 0 or 1 expected");
  return {{exact_double(f[0], f[1]), exact_double(f[2], f[3]), exact_double(f[4], f[5])}, f[6] == "1"};
}

void add_row(std::vector<TruthQuery>& queries, std::size_t index, const Row& row) {
  const std::size_t corner = index % kRows;
  if (corner == 0) queries.push_back({{}, {}, row.truth});
  TruthQuery& query = queries.back();
  if (row.truth != query.collides) throw InputError("truth differs from that of the query's first row");
  (corner < 4 ? query.t0[corner] : query.t1[corner - 4]) = row.point;
}

}  // namespace

onset::QueryResult ask(onset::PairKind kind, const TruthQuery& query, const onset::Options& options) {
  return kind == onset::PairKind::vertex_face ? onset::vertex_face_ccd({query.t0, query.t1}, options)
                                              : onset::edge_edge_ccd({query.t0, query.t1}, options);
}

std::vector<TruthQuery> read_queries(const std::string& path) {
  InputLines lines(path);
  std::vector<TruthQuery> queries;
  std::size_t rows = 0;
  for (std::string_view line; lines.next(line);) {
    const bool blank = trim(line).empty();
    if (blank && lines.at_end()) break;  // a last empty line
    try {
      add_row(queries, rows++, parse_row(blank ? "" : line));
    } catch (const InputError& e) {
      lines.fail(e.what());
    }
  }
  if (rows == 0) throw InputError(path + ": no queries");
  if (rows % kRows != 0) throw InputError(path + ": " + std::to_string(rows) + " rows, not a multiple of 8");
  return queries;
}

}  // namespace app
