#include <algorithm>

#include "base/parallel.hpp"
#include "onset/mesh.hpp"

namespace onset {

// igl::edges walks the upper triangle of the adjacency matrix column by column: ordered by the larger vertex,
// then by the smaller; each row is (smaller, larger).
std::vector<std::array<int, 2>> edge_list(const Indices& faces) {
  std::vector<std::array<int, 2>> list;
  list.reserve(std::size_t(faces.rows()) * 3);
  for (std::ptrdiff_t f = 0; f < faces.rows(); ++f)
    for (int c = 0; c < faces.cols(); ++c) {
      const int v = int(faces(f, c)), w = int(faces(f, (c + 1) % faces.cols()));
      list.push_back({std::min(v, w), std::max(v, w)});
    }
  parallel_sort(list.begin(), list.end(),
                [](const auto& e, const auto& f) { return e[1] != f[1] ? e[1] < f[1] : e[0] < f[0]; });
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace onset
