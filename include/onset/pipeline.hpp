// The calls of a time step: how far can it go, what touches.
#pragma once

#include <onset/export.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/result.hpp>

namespace onset {

// All calls: x_t0, x_t1 are #V x 3 positions at the two ends of a linear motion, t in [0, 1]. x_t0 is assumed to be
// free of intersections: has_intersections (onset/intersections.hpp) and check (onset/check.hpp) tell. Wrong row
// counts and options out of range throw std::invalid_argument; everything else is an outcome. Safe to call
// concurrently on one Mesh.

// The largest step that is certainly free of contact (paper, section 7.2) along the exact motion, and at the positions that
// it is stored as: see StepResult. x_t0 must be free of intersections (onset/check.hpp); a pair that touches there blocks the
// step.
ONSET_API StepResult compute_collision_free_stepsize(const Mesh& mesh, const Positions& x_t0,
                                                     const Positions& x_t1, const Options& options = {});

// Whether the whole exact motion, both ends included, is certified free of contact. Stops at the first pair that is not.
// Pairs that start within the separation and part do not count.
ONSET_API bool is_step_collision_free(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                      const Options& options = {});

// Every pair that is not certified free on the whole step, with its time of impact (paper, Algorithm 3).
ONSET_API ActiveSet construct_active_set(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                         const Options& options = {});

// The broad phase alone. With `list` false only the counts are filled, in constant memory.
ONSET_API Candidates compute_candidates(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1,
                                        const Options& options = {}, bool list = true);

}  // namespace onset
