// Primitives of other ranks that may meet one here.
#pragma once

#include <array>
#include <vector>

#include "mpi/exchange/box_groups.hpp"
#include "mpi/scene/motion_of_parts.hpp"

namespace onset::mpi {

// A vertex on its way: 56 bytes, and 24 of rules where there are any.
struct GhostVertex {
  int id, owner;
  // At the start and at the end, or the direction.
  double x[6];
};
struct GhostRules {
  double thickness;
  int body;
  std::uint32_t group, mask;
  char is_static;
};
// Vertices are places in the list of vertices of the same message.
struct GhostEdge {
  int id, vertices[2];
};
struct GhostFace {
  int id, vertices[3];
};

// By the rank that they come from. `rules` is empty where no vertex has any.
struct Ghosts {
  PerRank<GhostVertex> vertices;
  PerRank<GhostRules> rules;
  PerRank<GhostEdge> edges;
  PerRank<GhostFace> faces;
};

// (c) Gathers a few boxes of each rank, sends finer ones to those that they may concern, and then what meets
// these. What another rank owns and may be in a candidate with something owned here is among the result.
Ghosts exchange_ghosts(const Mesh::Impl& mesh, const OwnMotion& own, double inflation, Meetings meetings);

}  // namespace onset::mpi
