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

// Compares bits. Zeros of different sign differ, so that a reused row is exactly what was passed in.
bool same_bits(const double* a, const double* b, std::size_t count);

// What steps have in common as long as static vertices stay where they are. It is immutable, but for memory
// to use again, and any thread may use it.
class StaticMotion {
 public:
  // x y z of each static vertex, in the order of ids, and the same by column. All columns are the caller's.
  std::vector<double> x;
  std::array<std::vector<double>, 3> column;
  // Whether the ids of static vertices have no gaps.
  bool contiguous = true;
  std::array<double, 3> lo{}, hi{};
  // Extents of the static primitives that take part, rounded up.
  std::array<double, 3> widest_edge{}, widest_face{};

  // Says whether the static vertices, with these ids, have the same positions at one end of a motion.
  bool stands_at(const std::vector<int>& ids, const Positions& positions) const;

  // Takes Motion::x of an earlier motion with these axes, whose rows of static vertices still hold; it is
  // empty if none is kept. At most two are kept.
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

// Makes the static part of a motion.
std::shared_ptr<const StaticMotion> make_static_motion(const MeshData& mesh, const Motion& m);

}  // namespace onset
