#include "scene/named_pairs.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace onset {

void NamedPairs::reject(const std::string& why) const {
  throw std::invalid_argument(std::string(what_) + " row " + std::to_string(row_) + ": " + why);
}

void NamedPairs::check_id(Primitive kind, int id) const {
  static constexpr const char* kNames[][2] = {
      {"vertex ", " vertices"}, {"edge ", " edges"}, {"face ", " faces"}};
  const char* const(&name)[2] = kNames[std::size_t(kind)];
  const std::size_t count = primitive_count(mesh_, kind);
  if (id < 0 || std::size_t(id) >= count)
    reject(name[0] + std::to_string(id) + " is out of range, there are " + std::to_string(count) + name[1]);
}

void NamedPairs::add(PairKind kind, int a, int b) {
  if (std::find(kinds_.begin(), kinds_.end(), kind) == kinds_.end())
    reject("kind " + std::to_string(int(kind)) + " is no kind of pair");
  check_id(kind == PairKind::vertex_plane ? Primitive::vertex : first_primitive(kind), a);
  if (kind != PairKind::vertex_plane)
    check_id(second_primitive(kind), b);
  else if (b < 0 || std::size_t(b) >= mesh_.planes.size())
    reject("plane " + std::to_string(b) + " is out of range, there are " +
           std::to_string(mesh_.planes.size()) + " planes");
  if (kind == PairKind::edge_edge && a == b) reject("edge " + std::to_string(a) + " is repeated");
  if (kind == PairKind::edge_edge && a > b) std::swap(a, b);
  pairs_[std::size_t(kind)].push_back({a, b});
  ++row_;
}

std::vector<std::array<int, 2>> NamedPairs::of(PairKind kind) const {
  std::vector<std::array<int, 2>> pairs = pairs_[std::size_t(kind)];
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace onset
