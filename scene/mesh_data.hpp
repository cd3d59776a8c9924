// The arrays behind a Mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/static_cache.hpp"

namespace onset {

struct CollisionRules;    // onset/collision_rules.hpp
struct PrimitiveFilter;  // scene/primitive_filter.hpp

std::shared_ptr<const PrimitiveFilter> all_primitives();

struct MeshData {
  int num_vertices = 0, num_points = 0;
  std::vector<std::array<int, 2>> edges;  // the last num_points: {v, v}, of vertices of no other
  std::vector<std::array<int, 3>> faces;
  std::vector<double> thickness;  // empty: none; else one value >= 0 a vertex
  bool weld = false;              // vertices at one place at both ends of a motion count as one

  // Who may meet whom; empty where nothing was set.
  std::vector<int> body;                                               // a vertex; empty: all in body 0
  std::vector<bool> is_static;                                           // a vertex: static
  std::vector<bool> rigid, no_self;                                    // a body
  std::vector<std::uint32_t> group, mask;                              // a vertex
  std::vector<std::array<int, 2>> excluded_bodies, excluded_vertices;  // smaller id first, sorted, each once
  std::array<std::vector<std::array<int, 2>>, 3> excluded_pairs;  // of a kind; ids as in IdPair, the same

  std::shared_ptr<const CollisionRules> rules;  // as they were given; null: of a single query

  std::vector<int> full_vertex;  // a vertex: its id in the full mesh; empty: its own
  int num_full_vertices = 0;

  // What follows from the above, made once (finish_mesh). Never null; at first every primitive takes part, moves, and may
  // meet all that it shares no vertex with.
  std::shared_ptr<const PrimitiveFilter> filter = all_primitives();
  std::shared_ptr<StaticCache> static_cache;  // not null where the filter has static primitives
  std::shared_ptr<BroadPhasePool> broad_phases;  // of earlier calls; not null once finished
};

// The largest thickness among the vertices [first, last).
inline double thickest(const MeshData& mesh, const int* first, const int* last) {
  double r = 0;
  for (; first != last && !mesh.thickness.empty(); ++first)
    r = std::max(r, mesh.thickness[std::size_t(*first)]);
  return r;
}

}  // namespace onset
