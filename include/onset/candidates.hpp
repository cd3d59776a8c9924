// The broad phase alone: which pairs may touch at all.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>
#include <vector>

namespace onset {

// The pairs whose swept boxes (of the motion, widened by half the largest separation each, and by half of
// what storing positions in doubles can change) overlap and share no vertex.
struct Candidates {
  // Vertex and face; two edges, the smaller id first; in the plane vertex and edge instead. Sorted.
  std::vector<std::array<int, 2>> vertex_face, edge_edge;
  std::vector<std::array<int, 2>> vertex_edge;
  // Vertex and row of CollisionRules::planes: those whose motion a cheap test does not keep beyond the
  // separation and what storing can change, the same for any number of threads. Sorted.
  std::vector<std::array<int, 2>> vertex_plane;
  PairCounts counts;
  // free: complete. Where a budget was spent the lists are empty.
  Outcome outcome = Outcome::free;
  // The offending vertex of non_finite and out_of_range, else -1.
  int vertex = -1;
  Stats stats;
};

// Lists the candidates of a step. Guarantee: every pair that touches, or comes within its separation, on the
// exact motion or as stored is among them.
//
// x_t0, x_t1: #V x 3, model length, the two ends of a linear motion.
// Throws std::invalid_argument for a wrong number of rows or columns, a static vertex that moves, options out
// of range.
// Safe to call concurrently on one Mesh.
//
// Source: docs/theory.md, section 13.
ONSET_API Candidates compute_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                        const Options& options = {});

// Counts them, in constant memory; the lists stay empty. Otherwise as compute_candidates.
ONSET_API Candidates count_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                      const Options& options = {});

// Gets candidates of one kind, as in Candidates; `pairs` is valid during the call only.
using CandidateVisitor =
    std::function<void(PairKind kind, const std::array<int, 2>* pairs, std::size_t count)>;

// Hands every candidate to `visit`, each once, in batches and in no particular order, in constant memory.
//
// visit: called from several threads at once unless Options::threads is 1, in the floating-point environment
// of the library; an exception that it throws leaves the call. Empty: throws std::invalid_argument.
// Returns counts, outcome and statistics; after a spent budget not all were visited. Otherwise as
// compute_candidates.
ONSET_API Candidates visit_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                      const CandidateVisitor& visit, const Options& options = {});

}  // namespace onset
