#include <algorithm>
#include <map>
#include <tuple>

#include "broadphase/box_test.hpp"
#include "mpi/messages/directory.hpp"
#include "mpi/scene/mesh_impl.hpp"

namespace onset::mpi {
namespace {

// What decides whom a primitive may meet (PrimitiveKey), but for the body of those that meet themselves.
struct Key {
  std::uint32_t group, mask;
  int still;
  int body;  // of those that do not meet themselves, else -1
  bool operator<(const Key& o) const {
    return std::tie(group, mask, still, body) < std::tie(o.group, o.mask, o.still, o.body);
  }
};
// How many primitives of each kind have a key.
struct KeyCount {
  Key key;
  std::int64_t count[3];
};

// Beyond so many combinations of group and mask rules are not told apart (scene/filter_counts.cpp).
constexpr std::size_t kMostClasses = 1024;

template <std::size_t N>
Key key_of(const Mesh::Impl& m, const std::array<int, N>& slots) {
  Key key{~0u, ~0u, m.is_still(slots), -1};
  if (!m.group.empty()) {
    key.group = key.mask = 0;
    for (const int s : slots) key.group |= m.group[std::size_t(s)], key.mask |= m.mask[std::size_t(s)];
  }
  const std::size_t body = m.body.empty() ? 0 : std::size_t(m.body[std::size_t(slots[0])]);
  const auto is_set = [&](const std::vector<bool>& flags) { return body < flags.size() && flags[body]; };
  if (is_set(m.checked.rigid) || is_set(m.checked.no_self)) key.body = int(body);
  return key;
}

bool meet(const Key& a, const Key& b) {
  return (a.group & b.mask) != 0 && (b.group & a.mask) != 0 && !(a.still && b.still);
}

// Counts of all that the rules treat alike, in the scene and in each body that does not meet itself.
class Partners {
 public:
  explicit Partners(std::vector<KeyCount> all) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> classes;
    for (const KeyCount& k : all) classes.push_back({k.key.group, k.key.mask});
    std::sort(classes.begin(), classes.end());
    classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
    blind_ = classes.size() > kMostClasses;
    for (const KeyCount& k : all)
      for (int kind = 0; kind < 3; ++kind) {
        scene_[seen(k.key)][std::size_t(kind)] += k.count[kind];
        if (k.key.body >= 0) bodies_[k.key.body][seen(k.key)][std::size_t(kind)] += k.count[kind];
      }
  }
  // Says whether a primitive of kind p has a partner of kind `other`.
  bool any(const Key& key, int p, int other) const {
    const Key own = seen(key);
    const std::int64_t in_scene = count(own, other, scene_);
    const std::int64_t alone =
        key.body >= 0 ? count(own, other, bodies_.at(key.body)) : p == other && meet(own, own);
    return in_scene != alone;
  }

 private:
  using Counts = std::map<Key, std::array<std::int64_t, 3>>;
  Key seen(Key key) const {
    if (blind_) key.group = key.mask = ~0u;
    key.body = -1;
    return key;
  }
  static std::int64_t count(const Key& key, int kind, const Counts& counts) {
    std::int64_t n = 0;
    for (const auto& [other, of_kind] : counts)
      if (meet(key, other)) n += of_kind[std::size_t(kind)];
    return n;
  }
  bool blind_ = false;
  Counts scene_;
  std::map<int, Counts> bodies_;
};

// The kinds that a kind meets, those of positions at rest too.
std::vector<int> others(int dimension, int kind) {
  if (dimension == 2) return kind == 0 ? std::vector<int>{1} : std::vector<int>{0, 1};
  if (kind == 0) return {2};
  return {1, kind == 1 ? 2 : 0};
}

// The keys of what is owned here, by kind and row.
std::array<std::vector<Key>, 3> own_keys(const Mesh::Impl& m) {
  std::array<std::vector<Key>, 3> keys;
  for (std::ptrdiff_t v = 0; v < m.owned; ++v) keys[0].push_back(key_of(m, std::array<int, 1>{int(v)}));
  for (const Element<2>& e : m.own_edges) keys[1].push_back(key_of(m, e.vertices));
  for (const Element<3>& f : m.own_faces) keys[2].push_back(key_of(m, f.vertices));
  return keys;
}

}  // namespace

void find_partners(Mesh::Impl& m) {
  std::array<std::vector<Key>, 3> keys;
  std::vector<KeyCount> mine;
  m.comm.agreed([&] {
    keys = own_keys(m);
    std::map<Key, KeyCount> counts;
    for (std::size_t kind = 0; kind < 3; ++kind)
      for (const Key& key : keys[kind]) ++counts.insert({key, {key, {}}}).first->second.count[kind];
    for (const auto& [key, count] : counts) mine.push_back(count);
  });
  const std::vector<KeyCount> all = m.comm.gather(mine);
  std::int64_t has_static = 0;
  m.comm.agreed([&] {
    const Partners partners(all);
    std::map<Key, std::array<bool, 3>> known;
    for (const KeyCount& k : mine)
      for (int kind = 0; kind < 3; ++kind) {
        bool& any = known[k.key][std::size_t(kind)];
        for (const int other : others(m.dimension, kind)) any = any || partners.any(k.key, kind, other);
      }
    for (std::size_t kind = 0; kind < 3; ++kind) m.takes_part[kind].reserve(keys[kind].size());
    for (std::size_t kind = 0; kind < 3; ++kind)
      for (const Key& key : keys[kind]) {
        const bool any = known.at(key)[kind];
        m.takes_part[kind].push_back(!any ? TakesPart::no : key.still ? TakesPart::still : TakesPart::moving);
        has_static = has_static || (any && key.still);
      }
  });
  m.comm.maximum(&has_static, 1);
  m.has_static = has_static != 0;
  for (std::size_t v = 0; !m.is_static.empty() && v < std::size_t(m.owned); ++v)
    m.static_vertices += m.is_static[v] != 0;
  m.comm.sum(&m.static_vertices, 1);
}

void choose_samples(Mesh::Impl& m) {
  const Directory directory(m.comm, m.edges);
  PerRank<int> out;
  m.comm.agreed([&] {
    out.resize(std::size_t(m.comm.size()));
    for (std::size_t i = 0; i < m.own_edges.size(); ++i)
      if (m.takes_part[1][i] == TakesPart::moving)
        out[directory.rank_of(m.own_edges[i].id)].push_back(m.own_edges[i].id);
  });
  const PerRank<int> in = m.comm.exchange(out);
  std::vector<std::pair<int, int>> moving;  // id, rank
  std::int64_t count = 0;
  m.comm.agreed([&] {
    for (std::size_t r = 0; r < in.size(); ++r)
      for (const int id : in[r]) moving.push_back({id, int(r)});
    std::sort(moving.begin(), moving.end());
    count = std::int64_t(moving.size());
  });
  const std::int64_t first = m.comm.sum_before(count);
  m.comm.sum(&count, 1);
  using Sample = std::array<std::int64_t, 2>;  // place among the moving edges, id
  PerRank<Sample> chosen;
  m.comm.agreed([&] {
    const std::int64_t stride = std::int64_t(sampled_edge_stride(std::size_t(count)));
    chosen.resize(in.size());
    for (std::size_t i = 0; i < moving.size(); ++i)
      if ((first + std::int64_t(i)) % stride == 0)
        chosen[std::size_t(moving[i].second)].push_back({first + std::int64_t(i), moving[i].first});
  });
  const PerRank<Sample> mine = m.comm.exchange(chosen);
  m.comm.agreed([&] {
    for (const std::vector<Sample>& of_rank : mine)
      for (const Sample& s : of_rank) {
        const auto at = std::lower_bound(m.own_edges.begin(), m.own_edges.end(), int(s[1]),
                                         [](const Element<2>& e, int id) { return e.id < id; });
        m.samples.push_back({s[0], int(at - m.own_edges.begin())});
      }
  });
}

}  // namespace onset::mpi
