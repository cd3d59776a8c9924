// Boxes of a rank's primitives, few together, and which of them may meet those of another rank.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "mpi/scene/mesh_impl.hpp"
#include "scene/motion/motion.hpp"
#include "scene/primitive.hpp"

namespace onset::mpi {

// The boxes at both ends of the step, rounded outward: 48 bytes.
struct Box {
  float lo[2][3], hi[2][3];

  static Box none();
  void add(const Box& other);
  // False where an axis separates the boxes on one side at both ends. Then no two primitives in them are
  // candidates, by any test of boxes (docs/theory.md, L29).
  bool meets(const Box& other) const {
    for (int a = 0; a < 3; ++a) {
      if (hi[0][a] < other.lo[0][a] && hi[1][a] < other.lo[1][a]) return false;
      if (other.hi[0][a] < lo[0][a] && other.hi[1][a] < lo[1][a]) return false;
    }
    return true;
  }
};

// A tree over boxes in an order that keeps near ones together.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> leaves);

  const std::vector<Box>& leaves() const { return levels_.front(); }
  // The topmost boxes that are at least `least` in number, or the leaves.
  const std::vector<Box>& cut(std::size_t least) const;
  bool meets(const Box& box) const;
  // Calls f(leaf) for the leaves that meet one of another tree, in order.
  void each_meeting(const BoxTree& other, const std::function<void(std::size_t leaf)>& f) const;

  static constexpr std::size_t kChildren = 4;

 private:
  bool meets(const Box& box, std::size_t level, std::size_t node) const;
  void descend(const BoxTree& other, std::size_t level, std::size_t node,
               const std::function<void(std::size_t)>& f) const;

  std::vector<std::vector<Box>> levels_{1};  // leaves first
};

// What a call asks about in pairs: contacts and distances, or edges that go through faces.
enum class Meetings { contacts, intersections };

// Returns the kind of primitives that one of this kind meets; nothing where it meets none.
std::optional<Primitive> partner_of(Primitive kind, int dimension, Meetings meetings);

// What this rank owns of one kind, along a space curve, in groups with a box.
class OwnBoxes {
 public:
  // inflation: at least what the broad phase widens a primitive by, thickness apart.
  OwnBoxes(const Mesh::Impl& mesh, const Motion& motion, Primitive kind, double inflation);

  const BoxTree& tree() const { return tree_; }
  Box box_of(int row) const;
  // Calls f(row) for each primitive that meets a box of `other`: a row of the vertices, own_edges or
  // own_faces.
  template <class F>
  void each_meeting(const BoxTree& other, F&& f) const {
    tree_.each_meeting(other, [&](std::size_t group) {
      const std::size_t last = std::min(rows_.size(), (group + 1) * kGroup);
      for (std::size_t i = group * kGroup; i < last; ++i)
        if (other.meets(box_of(rows_[i]))) f(rows_[i]);
    });
  }

  static constexpr std::size_t kGroup = 8;

 private:
  template <std::size_t N>
  Box box_of(const std::array<int, N>& slots) const;

  const Mesh::Impl& mesh_;
  const Motion& motion_;
  const Primitive kind_;
  double inflation_;
  std::vector<int> rows_;
  BoxTree tree_;
};

}  // namespace onset::mpi
