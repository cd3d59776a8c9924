// Single queries: one vertex against one face, one edge against another.
#pragma once

#include <array>
#include <onset/export.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <onset/views.hpp>

namespace onset {

using Point = std::array<double, 3>;

// The two ends of a linear motion, each four points (model length).
struct VertexFaceQuery {
  std::array<Point, 4> t0, t1;  // vertex, face corner 0, 1, 2
};
struct EdgeEdgeQuery {
  std::array<Point, 4> t0, t1;  // edge a: 0, 1; edge b: 2, 3
};

// Touching counts as contact. An unset Options::tolerance is relative to this query's own extent. Threads,
// broad phase are ignored. Throws std::invalid_argument for options out of range; NaN, infinities, |x| >
// 2^1020 are outcomes.
ONSET_API QueryResult vertex_face_ccd(const VertexFaceQuery& query, const Options& options = {});
ONSET_API QueryResult edge_edge_ccd(const EdgeEdgeQuery& query, const Options& options = {});

}  // namespace onset
