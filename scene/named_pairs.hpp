// Particular pairs of primitives that a caller names, checked row by row.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "scene/primitive.hpp"

namespace onset {

class NamedPairs {
 public:
  NamedPairs(const char* what, const MeshData& mesh, std::vector<PairKind> kinds)
      : what_(what), mesh_(mesh), kinds_(std::move(kinds)) {}

  // The next row. Throws std::invalid_argument naming it for another kind, an id out of range, or an edge and
  // itself.
  void add(PairKind kind, int a, int b);
  // Sorted, each once; two edges with the smaller id first.
  std::vector<std::array<int, 2>> of(PairKind kind) const;

 private:
  void check_id(Primitive kind, int id) const;
  [[noreturn]] void reject(const std::string& why) const;

  const char* what_;
  const MeshData& mesh_;
  std::vector<PairKind> kinds_;
  std::size_t row_ = 0;
  std::array<std::vector<std::array<int, 2>>, 3> pairs_;
};

}  // namespace onset
