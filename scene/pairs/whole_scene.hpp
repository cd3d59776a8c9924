// What a mesh that holds a part of a scene is told of the whole, so that its pairs get the answers that they
// have there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/primitive.hpp"

namespace onset {

// Whose the primitives of one kind are, of a part that owns nearly all that it has.
class PartOwners {
 public:
  // Says that the next primitive, in the order of ids, is this part's or another's.
  void add(int owner, int here) {
    if (owner != here) others_.push_back({int(elsewhere_.size()), owner});
    elsewhere_.push_back(owner != here);
  }
  void reserve(std::size_t count) { elsewhere_.reserve(count); }
  std::size_t size() const { return elsewhere_.size(); }
  std::size_t elsewhere() const { return others_.size(); }
  int of(int id, int here) const {
    if (!elsewhere_[std::size_t(id)]) return here;
    return (*std::lower_bound(others_.begin(), others_.end(), std::array<int, 2>{id, 0}))[1];
  }

 private:
  std::vector<bool> elsewhere_;
  std::vector<std::array<int, 2>> others_;  // ids, in order, and their owners, which are >= 0
};

// Set by whoever divides a scene. Lengths are the largest over all parts: what a part measures itself is no
// more, so that every part goes on with the same.
struct WholeScene {
  // Whether there are such primitives, and static ones that take part.
  bool has_edges = false, has_faces = false, has_static = false;

  // Of the motion. Its axes, and by stored axis what primitives that take part move and span
  // (largest_swept).
  std::array<int, 3> axes{0, 1, 2};
  std::array<double, 3> moved{}, widest_edge{}, widest_face{};
  // The largest magnitude of a coordinate at both ends.
  double largest_coordinate = 0;
  // Whether BoxTest::moving is the cheaper test.
  bool tests_moving_boxes = false;
  // The middle of the scene, by stored axis, about which positions are rounded to single precision, and
  // whether all are (NarrowPhaseInput::for_many).
  std::array<double, 3> middle{};
  bool rounds_all = true;

  // Which part this is, and by kind and id whose a primitive is, and its id in the whole.
  int here = 0;
  std::array<PartOwners, 3> owners;
  std::array<std::vector<int>, 3> id;

  int owner(Primitive kind, int of) const { return owners[std::size_t(kind)].of(of, here); }
};

// Says whether rounding all vertices in every call is worth it: unless most of them are static.
inline bool rounds_all(std::size_t static_vertices, std::ptrdiff_t vertices) {
  return 2 * static_vertices <= std::size_t(vertices);
}

// Says whether this part decides a pair: each is decided by exactly one of the owners of its two primitives,
// by the sum of their ids, so that two parts share the pairs between them about evenly.
inline bool is_decided_here(const WholeScene& whole, PairKind kind, int a, int b) {
  const Primitive first = first_primitive(kind), second = second_primitive(kind);
  const int p = whole.owner(first, a), q = whole.owner(second, b);
  if (p == q) return p == whole.here;
  const std::vector<int>&first_ids = whole.id[std::size_t(first)],
        &second_ids = whole.id[std::size_t(second)];
  const bool odd = ((first_ids[std::size_t(a)] ^ second_ids[std::size_t(b)]) & 1) != 0;
  return (odd ? std::min(p, q) : std::max(p, q)) == whole.here;
}

}  // namespace onset
