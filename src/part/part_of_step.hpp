// What one part of a scene finds on a step, before all parts are known.
#pragma once

#include <memory>
#include <vector>

#include "onset/active_set.hpp"
#include "onset/export.hpp"
#include "onset/mesh.hpp"
#include "onset/step_size.hpp"
#include "src/shared/pair_traversal.hpp"
#include "src/shared/step_setup.hpp"

namespace onset {

// The phases of a call on a mesh with MeshData::whole. In between, whoever divided the scene reduces what the
// parts have found: the answers then are those of the whole scene.
class ONSET_API PartOfStep {
 public:
  // Sets up the motion and the broad phase. The options must outlive this, not the positions. Throws as the
  // call does.
  PartOfStep(const Mesh& mesh, const Positions& x_t0, const Positions& x_t1, const Options& options,
             Collect collect);
  ~PartOfStep();
  PartOfStep(const PartOfStep&) = delete;
  PartOfStep& operator=(const PartOfStep&) = delete;

  // Decides the pairs of this part; to be called once.
  void find();

  // Why it ended early; free where it did not.
  Outcome outcome() const;
  // With Collect::first and any.
  const Limits& limits() const;
  const Stats& stats() const;
  // rounding_of_distances, where the step is stored.
  double rounding() const;

  // With Collect::all, in this order: the least toi_hi of this part; sharpens the times of what may be the
  // earliest, given the least toi_hi of all; the least toi of this part; makes the contacts of this part,
  // given the least toi of all.
  double least_toi_hi() const;
  void sharpen(double least_toi_hi);
  double earliest() const;
  ActiveSet contacts(double earliest);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A bound of how far the boxes of a step reach, thickness apart, for the numbers of `mesh.whole`.
ONSET_API double largest_inflation(const MeshData& mesh, const Options& options, StepSetup::Use use,
                                   double d_hat);

}  // namespace onset
