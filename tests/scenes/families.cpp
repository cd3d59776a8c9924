#include "tests/scenes/families.hpp"

#include <cstdio>

namespace onset::scenes {

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
    for (const auto& part : {scale_families(), degenerate_families(), touching_families(), gap_families()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  return all;
}

Random seeded(const Family& family, PairKind kind, std::uint64_t seed) {
  std::uint64_t hash = 14695981039346656037ull ^ seed;  // FNV-1a over the name
  for (const char* c = family.name; *c; ++c) hash = (hash ^ std::uint64_t(*c)) * 1099511628211ull;
  return Random(hash * 2 + (kind == PairKind::edge_edge));
}

std::string to_text(const Query& query) {
  std::string text = name(query.kind);
  for (const auto& points : {query.t0, query.t1})
    for (const Point& p : points)
      for (double x : p) {
        char number[32];
        std::snprintf(number, sizeof number, " %a", x);
        text += number;
      }
  return text;
}

}  // namespace onset::scenes
