// Pairs of primitives that a caller names one by one, checked row by row.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "scene/primitive.hpp"

namespace onset {

// Collects the rows of a list. `what` names the list in messages; `kinds` are those that it may hold.
class NamedPairs {
 public:
  NamedPairs(const char* what, const MeshData& mesh, std::vector<PairKind> kinds)
      : what_(what), mesh_(mesh), kinds_(std::move(kinds)) {}

  // Adds the next row. Throws std::invalid_argument naming the row for another kind, an id out of range, or
  // an edge paired with itself.
  void add(PairKind kind, int a, int b);
  // Returns the pairs of a kind, sorted, each once; of two edges the smaller id comes first.
  std::vector<std::array<int, 2>> of(PairKind kind) const;

 private:
  void check_id(Primitive kind, int id) const;
  [[noreturn]] void reject(const std::string& why) const;

  const char* what_;
  const MeshData& mesh_;
  std::vector<PairKind> kinds_;
  std::size_t row_ = 0;
  std::array<std::vector<std::array<int, 2>>, kPairKinds> pairs_;
};

}  // namespace onset
