#include "src/truncate/vertex_groups.hpp"

#include <algorithm>
#include <numeric>

#include "src/start/places.hpp"

namespace onset {

VertexGroups::VertexGroups(const MeshData& mesh, const Motion& motion, const Positions& x_t0,
                           const Stop& stop)
    : group_(std::size_t(mesh.num_vertices)) {
  join_all(
      mesh, x_t0, [&](int v, int w) { return at_one_place(motion.t1(v), motion.t1(w)); }, stop);
}

VertexGroups::VertexGroups(const MeshData& mesh, const Positions& x_t0, const Positions& x_t1,
                           const Stop& stop)
    : group_(std::size_t(mesh.num_vertices)) {
  const auto end_alike = [&](int v, int w) {
    return x_t1(v, 0) == x_t1(w, 0) && x_t1(v, 1) == x_t1(w, 1) && x_t1(v, 2) == x_t1(w, 2);
  };
  join_all(mesh, x_t0, end_alike, stop);
}

template <class Same>
void VertexGroups::join_all(const MeshData& mesh, const Positions& x_t0, Same&& end_alike, const Stop& stop) {
  std::iota(group_.begin(), group_.end(), 0);
  if (mesh.weld)
    for (const std::vector<int>& here : shared_places(x_t0, stop)) {
      for (std::size_t j = 1; j < here.size(); ++j) {  // copies that part are no copies
        const auto same = [&](int v) { return end_alike(v, here[j]); };
        const auto end = here.begin() + std::ptrdiff_t(j), first = std::find_if(here.begin(), end, same);
        if (first != end) join(*first, here[j]);
      }
      if (stop.requested()) break;
    }
  if (!mesh.rigid.empty()) {
    std::vector<int> first(mesh.rigid.size(), -1);
    for (int v = 0; v < mesh.num_vertices; ++v) {
      const int body = rigid_body(mesh, v);
      if (body < 0) continue;
      int& of_body = first[std::size_t(body)];
      if (of_body < 0) of_body = v;
      join(of_body, v);
    }
  }
  number();
}

int VertexGroups::root(int v) {
  while (group_[std::size_t(v)] != v) {
    int& above = group_[std::size_t(v)];
    v = above = group_[std::size_t(above)];
  }
  return v;
}

// The smaller id is the root.
void VertexGroups::join(int v, int w) {
  v = root(v), w = root(w);
  group_[std::size_t(std::max(v, w))] = std::min(v, w);
}

void VertexGroups::number() {
  std::vector<int> id(group_.size(), -1);
  int groups = 0;
  for (int v = 0; v < int(group_.size()); ++v) {
    int& of_root = id[std::size_t(root(v))];
    if (of_root < 0) of_root = groups++;
    id[std::size_t(v)] = of_root;
  }
  group_ = std::move(id);
  start_.assign(std::size_t(groups) + 1, 0);
  for (const int g : group_) ++start_[std::size_t(g) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  members_.resize(group_.size());
  std::vector<std::size_t> place(start_.begin(), start_.end());
  for (int v = 0; v < int(group_.size()); ++v) members_[place[std::size_t(of(v))]++] = v;
}

}  // namespace onset
