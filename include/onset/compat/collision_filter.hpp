// Who may collide with whom, as a function of two vertices: filters that combine with & | and !.
//
// Source: ipc::CollisionFilter of ipc-toolkit (https://github.com/ipc-sim/ipc-toolkit), whose names it has.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <onset/compat/arguments.hpp>
#include <onset/mesh.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace onset::ipc {

// A value: a copy calls a copy of the function that it was made of. Safe to call concurrently where that is.
class CollisionFilter {
 public:
  using Function = std::function<bool(std::size_t, std::size_t)>;

  // Accepts all.
  CollisionFilter() = default;
  CollisionFilter(std::nullptr_t) {}  // NOLINT: implicit by design
  // An empty std::function accepts all.
  template <class F, class = std::enable_if_t<std::is_invocable_r_v<bool, F, std::size_t, std::size_t> &&
                                              !std::is_same_v<std::decay_t<F>, CollisionFilter>>>
  CollisionFilter(F&& f) : function_(std::forward<F>(f)) {}  // NOLINT: implicit by design

  bool operator()(std::size_t i, std::size_t j) const { return !function_ || function_(i, j); }
  // Whether no function is asked at all: the calls of this adapter then need no list of pairs.
  bool accepts_all() const noexcept { return !function_; }
  operator Function() const {  // NOLINT: implicit by design
    if (function_) return function_;
    return [](std::size_t, std::size_t) { return true; };
  }

  // Accepts what either accepts, what both accept, what this one rejects.
  friend CollisionFilter operator|(CollisionFilter a, CollisionFilter b) {
    if (a.accepts_all() || b.accepts_all()) return {};
    return Function([a = std::move(a), b = std::move(b)](std::size_t i, std::size_t j) {
      return a.function_(i, j) || b.function_(i, j);
    });
  }
  friend CollisionFilter operator&(CollisionFilter a, CollisionFilter b) {
    if (a.accepts_all()) return b;
    if (b.accepts_all()) return a;
    return Function([a = std::move(a), b = std::move(b)](std::size_t i, std::size_t j) {
      return a.function_(i, j) && b.function_(i, j);
    });
  }
  CollisionFilter operator!() const {
    return Function([f = *this](std::size_t i, std::size_t j) { return !f(i, j); });
  }
  CollisionFilter& operator|=(CollisionFilter other) { return *this = std::move(*this) | std::move(other); }
  CollisionFilter& operator&=(CollisionFilter other) { return *this = std::move(*this) & std::move(other); }

 private:
  Function function_;
};

// Of vertices of different patches (one id a vertex).
inline CollisionFilter make_vertex_patches_filter(const Eigen::VectorXi& patch_ids) {
  std::vector<int> ids(patch_ids.data(), patch_ids.data() + patch_ids.size());
  return CollisionFilter(
      [ids = std::move(ids)](std::size_t i, std::size_t j) { return ids.at(i) != ids.at(j); });
}
// Of pairs with at least one of the first n_dynamic vertices.
inline CollisionFilter make_static_obstacle_filter(std::size_t n_dynamic) {
  return CollisionFilter(
      [n_dynamic](std::size_t i, std::size_t j) { return i < n_dynamic || j < n_dynamic; });
}
// Of pairs with exactly one of the first n_codim_vertices vertices.
inline CollisionFilter make_codim_cross_filter(std::size_t n_codim_vertices) {
  return CollisionFilter([n_codim_vertices](std::size_t i, std::size_t j) {
    return (i < n_codim_vertices) != (j < n_codim_vertices);
  });
}
// Of vertices of different connected parts of the faces. Throws std::invalid_argument for a negative id, and
// what it returns throws std::out_of_range for a vertex beyond the largest id of a face.
inline CollisionFilter make_connected_components_filter(const Ids& faces) {
  const int vertices = faces->size() > 0 ? faces->maxCoeff() + 1 : 0;
  const std::vector<int> parts = onset::Mesh(vertices, onset::Indices(*faces)).components();
  return make_vertex_patches_filter(
      Eigen::Map<const Eigen::VectorXi>(parts.data(), Eigen::Index(parts.size())));
}

}  // namespace onset::ipc
