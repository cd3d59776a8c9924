// Which primitives of a mesh take part, and which pairs of them may meet: from topology and filters, once a
// mesh.
#pragma once

#include <array>
#include <vector>

#include "onset/filter_counts.hpp"
#include "scene/primitive.hpp"

namespace onset {

// What of a primitive decides whether it may meet another: compared in bulk.
struct PrimitiveKey {
  int body;   // < 0: ~id of its body, which does not meet itself; 0: of no such body
  int flags;  // kStaticFlag, kExcludedFlag
  std::uint32_t group, mask;
};
inline constexpr int kStaticFlag = int(0x80000000u);  // all vertices static: the sign bit
inline constexpr int kExcludedFlag = 1;  // named in an excluded pair, itself, by a vertex or its body

struct PrimitiveFilter {
  FilterCounts counts;
  // By id; empty where no two primitives are kept apart but by a shared vertex.
  std::array<std::vector<PrimitiveKey>, 3> keys;
  // Ids in ascending order, by Primitive. `all`: every primitive takes part and moves (the lists are empty).
  bool all = true;
  std::array<std::vector<int>, 3> moving, statics;
  // Vertices of the primitives that take part; a vertex may be in both.
  std::vector<int> moving_vertices, static_vertices;
  // All vertices, by whether they are static; empty where none is.
  std::vector<int> free_ids, static_ids;

  // Whether anything but static vertices keeps primitives apart.
  bool compares_keys = false;

  bool keeps_apart() const { return !keys[0].empty() || !keys[1].empty() || !keys[2].empty(); }
  bool has_static() const { return !static_vertices.empty(); }
};

// Sets mesh.filter from the rest, and what is kept from call to call anew.
void finish_mesh(MeshData& mesh);

// Whether keys, apart from excluded pairs, let two primitives meet.
inline bool keys_meet(const PrimitiveKey& a, const PrimitiveKey& b) {
  return (a.group & b.mask) != 0 && (b.group & a.mask) != 0 && (a.flags & b.flags) >= 0 &&
         (a.body != b.body || a.body == 0);
}

bool share_vertex(const MeshData& mesh, PairKind kind, int a, int b);

// Whether the pair is named, itself, by its vertices or bodies, in an excluded pair.
bool excluded(const MeshData& mesh, PairKind kind, int a, int b);

// The definition that every broad phase keeps to: a pair that fails this is no candidate.
bool may_meet(const MeshData& mesh, PairKind kind, int a, int b);

// Whether all vertices of a primitive are static.
inline bool is_static(const MeshData& mesh, Primitive kind, int id) {
  if (mesh.is_static.empty()) return false;
  for (int v : primitive_vertices(mesh, kind, id))
    if (!mesh.is_static[std::size_t(v)]) return false;
  return true;
}

}  // namespace onset
