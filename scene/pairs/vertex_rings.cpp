#include "scene/pairs/vertex_rings.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>

#include "base/parallel.hpp"
#include "scene/primitive.hpp"
#include "scene/primitive_filter.hpp"

namespace onset {
namespace {

int vertices_each(Primitive kind) { return kind == Primitive::vertex ? 1 : kind == Primitive::edge ? 2 : 3; }

std::size_t proper_edges(const MeshData& mesh) { return mesh.edges.size() - std::size_t(mesh.num_points); }

// The edges or faces at each vertex.
class Around {
 public:
  Around(const MeshData& mesh, Primitive kind) : first_(std::size_t(mesh.num_vertices) + 1, 0) {
    const std::size_t count = kind == Primitive::edge ? proper_edges(mesh) : mesh.faces.size();
    const int each = vertices_each(kind);
    const auto visit = [&](auto&& f) {
      for (std::size_t id = 0; id < count; ++id) {
        const std::array<int, 3> v = primitive_vertices(mesh, kind, int(id));
        for (int k = 0; k < each; ++k) f(std::size_t(v[std::size_t(k)]), int(id));
      }
    };
    visit([&](std::size_t v, int) { ++first_[v + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    ids_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    visit([&](std::size_t v, int id) { ids_[next[v]++] = id; });
  }
  const int* begin(int v) const { return ids_.data() + first_[std::size_t(v)]; }
  const int* end(int v) const { return ids_.data() + first_[std::size_t(v) + 1]; }

 private:
  std::vector<std::size_t> first_;
  std::vector<int> ids_;
};

}  // namespace

EdgeGraph::EdgeGraph(const MeshData& mesh) : first_(std::size_t(mesh.num_vertices) + 1, 0) {
  const auto begin = mesh.edges.begin(), end = begin + std::ptrdiff_t(proper_edges(mesh));
  for (auto e = begin; e != end; ++e)
    for (const int v : *e) ++first_[std::size_t(v) + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  neighbours_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (auto e = begin; e != end; ++e)
    for (const int side : {0, 1})
      neighbours_[next[std::size_t((*e)[std::size_t(side)])]++] = (*e)[std::size_t(1 - side)];
}

const std::vector<int>& RingSearch::around(int a, int b, int rings) {
  ++search_;
  met_.clear();
  const auto meet = [&](int v) {
    if (seen_[std::size_t(v)] == search_) return;
    seen_[std::size_t(v)] = search_;
    met_.push_back(v);
  };
  meet(a), meet(b);
  std::size_t done = 0;
  for (int ring = 0; ring < rings && done < met_.size(); ++ring)
    for (const std::size_t end = met_.size(); done < end; ++done) {
      const int v = met_[done];
      for (const int* w = graph_.begin(v); w != graph_.end(v); ++w) meet(*w);
    }
  return met_;
}

VertexRings::VertexRings(const MeshData& mesh, int rings, std::size_t most)
    : rings_(rings),
      first_(std::size_t(mesh.num_vertices) + 1, 0),
      joined_(std::size_t(mesh.num_vertices), false) {
  const EdgeGraph graph(mesh);
  RingSearch search(graph, mesh.num_vertices);
  for (int v = 0; v < mesh.num_vertices; ++v) {
    joined_[std::size_t(v)] = graph.begin(v) != graph.end(v);
    const std::size_t before = larger_.size();
    for (const int w : search.around(v, v, rings))
      if (w > v) larger_.push_back(w);
    if (larger_.size() > most)
      throw std::invalid_argument("excluded_rings is " + std::to_string(rings) + ": more than " +
                                  std::to_string(most) +
                                  " pairs of vertices are joined by at most so many edges; "
                                  "bodies_without_self_collision leaves out all pairs of a body");
    std::sort(larger_.begin() + std::ptrdiff_t(before), larger_.end());
    first_[std::size_t(v) + 1] = larger_.size();
  }
  larger_.shrink_to_fit();
}

VertexRings::VertexRings(int vertices, int rings, std::vector<std::array<int, 2>> near)
    : rings_(rings), first_(std::size_t(vertices) + 1, 0), joined_(std::size_t(vertices), false) {
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  for (const auto& [v, w] : near) {
    ++first_[std::size_t(v) + 1];
    larger_.push_back(w);
    joined_[std::size_t(v)] = joined_[std::size_t(w)] = true;
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
}

bool VertexRings::near(int v, int w) const {
  if (v > w) std::swap(v, w);
  const int* row = larger_.data();
  return std::binary_search(row + first_[std::size_t(v)], row + first_[std::size_t(v) + 1], w);
}

bool within_rings(const MeshData& mesh, PairKind kind, int a, int b) {
  if (!mesh.rings) return false;
  const auto first = primitive_vertices(mesh, first_primitive(kind), a);
  const auto second = primitive_vertices(mesh, second_primitive(kind), b);
  for (int i = 0; i < vertices_each(first_primitive(kind)); ++i)
    for (int j = 0; j < vertices_each(second_primitive(kind)); ++j)
      if (const int v = first[std::size_t(i)], w = second[std::size_t(j)]; v == w || mesh.rings->near(v, w))
        return true;
  return false;
}

std::int64_t count_within_rings(const MeshData& mesh, PairKind kind,
                                const std::function<bool(int a, int b)>& counts) {
  const EdgeGraph graph(mesh);
  const bool same = kind == PairKind::edge_edge;
  const Around around(mesh, second_primitive(kind));
  const std::size_t others =
      second_primitive(kind) == Primitive::face ? mesh.faces.size() : proper_edges(mesh);
  std::atomic<std::int64_t> total{0};
  const std::size_t firsts = same ? others : std::size_t(mesh.num_vertices);
  const auto count = [&](std::size_t from, std::size_t to) {
    RingSearch search(graph, mesh.num_vertices);
    std::vector<std::size_t> seen(others, firsts);
    std::int64_t n = 0;
    for (std::size_t a = from; a < to; ++a) {
      const auto ends = primitive_vertices(mesh, first_primitive(kind), int(a));
      for (const int w : search.around(ends[0], ends[1], mesh.rings->rings()))
        for (const int* b = around.begin(w); b != around.end(w); ++b) {
          if (seen[std::size_t(*b)] == a || (same && std::size_t(*b) <= a)) continue;
          seen[std::size_t(*b)] = a;
          n += counts(int(a), *b);
        }
    }
    total += n;
  };
  // A chunk clears what it needs of the whole mesh first.
  isolated([&] { parallel_ranges(firsts, std::max<std::size_t>(256, firsts / 64), count); });
  return total;
}

}  // namespace onset
