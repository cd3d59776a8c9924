// Single queries: one vertex against one face, one edge against another.
#pragma once

#include <array>
#include <cstdint>
#include <onset/export.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>

namespace onset {

using Point = std::array<double, 3>;

// The two ends of a linear motion, each four points (model length).
struct VertexFaceQuery {
  // Vertex, face corner 0, 1, 2.
  std::array<Point, 4> t0, t1;
};
struct EdgeEdgeQuery {
  // Edge a: 0, 1; edge b: 2, 3.
  std::array<Point, 4> t0, t1;
};

using PlanePoint = std::array<double, 2>;
struct VertexEdgeQuery {
  // Vertex, edge end 0, 1, in the plane.
  std::array<PlanePoint, 3> t0, t1;
};

// A contact of `vertices` 0 to 3 in the query's order (vertex and edge: 0, 1, 2, 2); ids a and b are 0 (two
// edges: 0 and 1). Where it is free, toi is infinite, and there is no point or normal. Positions that are not
// usable: toi 0.
struct QueryResult : Contact {
  std::int64_t checks = 0;
  bool collides() const noexcept { return outcome != PairOutcome::free; }
};

// Decides one pair on its own: when does it touch, where, with which normal. Touching counts as contact.
//
// Guarantee: as construct_active_set (onset/active_set.hpp). Exactness::exact, separation 0: toi and toi_hi
// are adjacent doubles or the same.
//
// options: an unset tolerance is relative to this query's own extent; threads, broad phase and budgets of a
// call are not used.
// Throws std::invalid_argument for options out of range; NaN, infinities, |x| > 2^1020 are outcomes.
// Safe to call concurrently.
//
// Source: as construct_active_set; docs/theory.md, section 9.
ONSET_API QueryResult vertex_face_ccd(const VertexFaceQuery& query, const Options& options = {});
ONSET_API QueryResult edge_edge_ccd(const EdgeEdgeQuery& query, const Options& options = {});
ONSET_API QueryResult vertex_edge_ccd(const VertexEdgeQuery& query, const Options& options = {});

}  // namespace onset
