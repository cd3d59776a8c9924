#include "mpi/scene/rings.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "scene/pairs/vertex_rings.hpp"

namespace onset::mpi {
namespace {

// An edge from a vertex whose edges are all known to a neighbour, by ids.
using Step = std::array<int, 2>;

void sort_once(std::vector<Step>& steps) {
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
}

template <class F>
void each_step(const std::vector<Step>& sorted, int from, const F& f) {
  for (auto s = std::lower_bound(sorted.begin(), sorted.end(), Step{from, 0});
       s != sorted.end() && (*s)[0] == from; ++s)
    f(*s);
}

// (c) Returns all edges of the vertices that are owned here.
std::vector<Step> steps_of_owned(const Mesh::Impl& m) {
  PerRank<Step> out;
  m.comm.agreed([&] {
    out.resize(std::size_t(m.comm.size()));
    for (const Element<2>& e : m.own_edges)
      for (const std::size_t k : {std::size_t(0), std::size_t(1)}) {
        const std::size_t v = std::size_t(e.vertices[k]), w = std::size_t(e.vertices[1 - k]);
        if (v != w) out[std::size_t(m.owner[v])].push_back({m.id[v], m.id[w]});  // else it is a point
      }
  });
  const PerRank<Step> in = m.comm.exchange(out);
  std::vector<Step> steps;
  m.comm.agreed([&] {
    for (const std::vector<Step>& of_rank : in) steps.insert(steps.end(), of_rank.begin(), of_rank.end());
    sort_once(steps);
  });
  return steps;
}

// (c) Returns all edges of some vertices, given those of what each rank owns.
std::vector<Step> steps_of(const VertexOwners& owners, const Mesh::Impl& m, const std::vector<Step>& owned,
                           const std::vector<int>& vertices) {
  const std::vector<int> ranks = owners.of(vertices);
  PerRank<int> asked;
  m.comm.agreed([&] {
    asked.resize(std::size_t(m.comm.size()));
    for (std::size_t i = 0; i < vertices.size(); ++i) asked[std::size_t(ranks[i])].push_back(vertices[i]);
  });
  const PerRank<int> asking = m.comm.exchange(asked);
  PerRank<Step> out;
  m.comm.agreed([&] {
    out.resize(asking.size());
    for (std::size_t r = 0; r < asking.size(); ++r)
      for (const int v : asking[r]) each_step(owned, v, [&](const Step& s) { out[r].push_back(s); });
  });
  const PerRank<Step> in = m.comm.exchange(out);
  std::vector<Step> steps;
  m.comm.agreed([&] {
    for (const std::vector<Step>& of_rank : in) steps.insert(steps.end(), of_rank.begin(), of_rank.end());
  });
  return steps;
}

// (c) Returns the edges of all vertices within rings - 1 edges of a slot: whatever is within `rings` edges of
// one is joined to it by these.
std::vector<Step> steps_around(const VertexOwners& owners, int rings, const Mesh::Impl& m) {
  const std::vector<Step> owned = steps_of_owned(m);
  std::vector<Step> steps;
  std::vector<int> met, last;  // all that was met, sorted, and what was met last
  m.comm.agreed([&] {
    for (const int slot : m.by_id) met.push_back(m.id[std::size_t(slot)]);
    last = met;
  });
  for (int ring = 0; ring < rings; ++ring) {
    std::int64_t any = !last.empty();
    m.comm.maximum(&any, 1);
    if (any == 0) break;
    const std::vector<Step> more = steps_of(owners, m, owned, last);
    m.comm.agreed([&] {
      steps.insert(steps.end(), more.begin(), more.end());
      last.clear();
      for (const Step& s : more)
        if (!std::binary_search(met.begin(), met.end(), s[1])) last.push_back(s[1]);
      std::sort(last.begin(), last.end());
      last.erase(std::unique(last.begin(), last.end()), last.end());
      met.insert(met.end(), last.begin(), last.end());
      std::sort(met.begin(), met.end());
    });
  }
  return steps;
}

// The vertices that a slot is near, in a mesh of the vertices around all slots.
class Neighbours {
 public:
  explicit Neighbours(const std::vector<Step>& steps) {
    for (const Step& s : steps) ids_.insert(ids_.end(), s.begin(), s.end());
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    mesh_.num_vertices = int(ids_.size());
    for (const auto& [v, w] : steps) mesh_.edges.push_back({place(std::min(v, w)), place(std::max(v, w))});
    std::sort(mesh_.edges.begin(), mesh_.edges.end());
    mesh_.edges.erase(std::unique(mesh_.edges.begin(), mesh_.edges.end()), mesh_.edges.end());
  }

  // Puts the ids near each slot into `near`, up to `most` of them. Returns how many of them are larger than
  // that of the slot, of those that are owned.
  std::int64_t list(const Mesh::Impl& m, int rings, std::size_t most, NearVertices& near) const {
    const EdgeGraph graph(mesh_);
    RingSearch search(graph, mesh_.num_vertices);
    std::int64_t pairs = 0;
    near.first.push_back(0);
    for (std::size_t slot = 0; slot < m.slots() && near.ids.size() <= most; ++slot) {
      const int id = m.id[slot];
      if (std::binary_search(ids_.begin(), ids_.end(), id))
        for (const int w : search.around(place(id), place(id), rings)) {
          const int other = ids_[std::size_t(w)];
          if (other != id) near.ids.push_back(other);
          pairs += other > id && slot < std::size_t(m.owned);
        }
      near.first.push_back(near.ids.size());
    }
    return near.ids.size() > most ? std::int64_t(most) + 1 : pairs;
  }

 private:
  int place(int id) const { return int(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()); }

  std::vector<int> ids_;
  MeshData mesh_;
};

}  // namespace

void find_rings(const VertexOwners& owners, int rings, Mesh::Impl& m) {
  m.comm.agreed([&] {
    if (rings < 0)
      throw std::invalid_argument("excluded_rings is " + std::to_string(rings) + "; it must be >= 0");
  });
  if (rings == 0) return;
  const std::vector<Step> steps = steps_around(owners, rings, m);
  std::int64_t pairs = 0;
  constexpr std::size_t kMost = VertexRings::kMostPairs;
  m.comm.agreed([&] {
    m.near.rings = rings;
    // A pair is listed with both of its vertices.
    pairs = Neighbours(steps).list(m, rings, 2 * kMost, m.near);
  });
  m.comm.sum(&pairs, 1);
  if (pairs > std::int64_t(kMost))
    throw std::invalid_argument("excluded_rings is " + std::to_string(rings) + ": more than " +
                                std::to_string(kMost) +
                                " pairs of vertices are joined by at most so many edges");
}

}  // namespace onset::mpi
