// Which primitives of a mesh take part, and which pairs may meet, by topology and rules; made once a mesh.
#pragma once

#include <array>
#include <vector>

#include "onset/export.hpp"
#include "onset/filter_counts.hpp"
#include "scene/primitive.hpp"

namespace onset {

// What decides whether a primitive may meet another; kernels compare eight at once.
struct PrimitiveKey {
  // ~id (< 0) of a body that does not meet itself, else 0.
  int body;
  // kStaticFlag and kExcludedFlag.
  int flags;
  std::uint32_t group, mask;
};
// All vertices are static. It is the sign bit.
inline constexpr int kStaticFlag = int(0x80000000u);
// The primitive, a vertex of it or its body is named in an excluded pair, or rings leave out neighbours.
inline constexpr int kExcludedFlag = 1;

struct PrimitiveFilter {
  FilterCounts counts;
  // By kind and id; empty where only shared vertices keep primitives apart.
  std::array<std::vector<PrimitiveKey>, 3> keys;
  // Whether every primitive takes part and moves; the lists, by kind in ascending order of ids, are then
  // empty.
  bool all = true;
  std::array<std::vector<int>, 3> moving, statics;
  // The vertices of the primitives that take part; one may be in both lists.
  std::vector<int> moving_vertices, static_vertices;
  // All vertices, by whether they are static; empty where none is.
  std::vector<int> free_ids, static_ids;

  // Whether rules beyond static vertices keep primitives apart.
  bool compares_keys = false;

  bool keeps_apart() const { return !keys[0].empty() || !keys[1].empty() || !keys[2].empty(); }
  bool has_static() const { return !static_vertices.empty(); }
};

// Makes mesh.filter from the rest, and empty stores for what is kept from call to call.
ONSET_API void finish_mesh(MeshData& mesh);

// Says whether static primitives take part, in this mesh or anywhere in the scene that it is a part of.
bool scene_has_static(const MeshData& mesh);

// Says whether keys let two primitives meet, excluded pairs apart.
inline bool keys_meet(const PrimitiveKey& a, const PrimitiveKey& b) {
  return (a.group & b.mask) != 0 && (b.group & a.mask) != 0 && (a.flags & b.flags) >= 0 &&
         (a.body != b.body || a.body == 0);
}

bool share_vertex(const MeshData& mesh, PairKind kind, int a, int b);

// Says whether an excluded pair names this pair, two of its vertices, or its bodies.
bool excluded_by_name(const MeshData& mesh, PairKind kind, int a, int b);
// Says whether that is so, or the two are neighbours on the mesh (CollisionRules::excluded_rings).
bool excluded(const MeshData& mesh, PairKind kind, int a, int b);

// Says whether a pair can be a candidate. This is the definition that every broad phase keeps to.
bool may_meet(const MeshData& mesh, PairKind kind, int a, int b);

// Says whether all vertices of a primitive are static.
inline bool is_static(const MeshData& mesh, Primitive kind, int id) {
  if (mesh.is_static.empty()) return false;
  for (int v : primitive_vertices(mesh, kind, id))
    if (!mesh.is_static[std::size_t(v)]) return false;
  return true;
}

}  // namespace onset
