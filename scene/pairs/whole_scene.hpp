// What a mesh that holds a part of a scene is told of the whole, so that its pairs get the answers that they
// have there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "scene/primitive.hpp"

namespace onset {

// The primitives of one kind of a part, which owns nearly all that it has: whose each is, and its id in the
// whole, in the order of which they are added.
class PartPrimitives {
 public:
  void reserve(std::size_t count) { elsewhere_.reserve(count); }
  // The id of the i-th that is owned here is at `first`, i times `stride` bytes on. It is not copied.
  void own_ids_at(const int* first, std::size_t stride) {
    first_ = reinterpret_cast<const char*>(first), stride_ = stride;
  }
  void add_own() { elsewhere_.push_back(false); }
  void add(int id, int owner) {
    others_.push_back({int(elsewhere_.size()), owner, id});
    elsewhere_.push_back(true);
  }

  std::size_t size() const { return elsewhere_.size(); }
  std::size_t elsewhere() const { return others_.size(); }
  int owner(int i, int here) const { return elsewhere_[std::size_t(i)] ? first_not_before(i)->owner : here; }
  int id(int i) const {
    const auto at = first_not_before(i);
    if (elsewhere_[std::size_t(i)]) return at->id;
    int id;
    std::memcpy(&id, first_ + (std::size_t(i) - std::size_t(at - others_.begin())) * stride_, sizeof id);
    return id;
  }
  // Sets i to the place of an id and returns true, if it is here.
  bool find(int wanted, int& i) const {
    int last = int(size());
    for (i = 0; i < last;) {
      const int middle = i + (last - i) / 2;
      if (id(middle) < wanted)
        i = middle + 1;
      else
        last = middle;
    }
    return i < int(size()) && id(i) == wanted;
  }

 private:
  struct Other {
    int place, owner, id;
  };
  std::vector<Other>::const_iterator first_not_before(int i) const {
    return std::lower_bound(others_.begin(), others_.end(), i,
                            [](const Other& other, int place) { return other.place < place; });
  }
  std::vector<bool> elsewhere_;
  std::vector<Other> others_;
  const char* first_ = nullptr;
  std::size_t stride_ = 0;
};

// Set by whoever divides a scene. Lengths are the largest of all primitives that have a partner somewhere in
// the scene, so that every part goes on with the same; a part cannot tell which these are.
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

  // Which part this is, and its primitives, by kind.
  int here = 0;
  std::array<PartPrimitives, 3> primitives;
  // The ids of the vertices that are owned here, in order.
  std::vector<int> own_vertices;

  int owner(Primitive kind, int i) const { return primitives[std::size_t(kind)].owner(i, here); }
  int id(Primitive kind, int i) const { return primitives[std::size_t(kind)].id(i); }
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
  const bool odd = ((whole.id(first, a) ^ whole.id(second, b)) & 1) != 0;
  return (odd ? std::min(p, q) : std::max(p, q)) == whole.here;
}

}  // namespace onset
