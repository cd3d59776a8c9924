// The part of a motion that stays where it is, kept from call to call.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "base/aligned.hpp"
#include "onset/views.hpp"
#include "scene/mesh_data.hpp"

namespace onset {

struct Motion;

// By their bits: zeros of different sign are told apart, so that a reused row is what was passed in.
bool same_bits(const double* a, const double* b, std::size_t count);

// What the steps have in common as long as static vertices stay where they are: immutable but for memory
// to use again, safe to share.
class StaticMotion {
 public:
  std::vector<double> x;                               // x y z of each static vertex, in the order of ids
  std::array<std::vector<double>, 3> column;           // the same by column
  bool contiguous = true;                              // the ids are
  std::array<double, 3> lo{}, hi{};                    // per column
  std::array<double, 3> widest_edge{}, widest_face{};  // of the static primitives that take part, rounded up

  // Whether static vertices are there, at one end of a motion.
  bool stands_at(const std::vector<int>& ids, const Positions& positions) const;

  // Motion::x of an earlier motion with these axes, whose rows of static vertices still hold; empty if none
  // is kept. At most two are.
  AlignedArray<double> take(const std::array<int, 3>& axes) const;
  void give_back(const std::array<int, 3>& axes, AlignedArray<double> rows) const;

 private:
  struct Rows {
    std::array<int, 3> axes;
    AlignedArray<double> x;
  };
  mutable std::mutex mutex_;
  mutable std::array<Rows, 2> kept_;
};

// The static part of a motion just made.
std::shared_ptr<const StaticMotion> make_static_motion(const MeshData& mesh, const Motion& m);

}  // namespace onset
