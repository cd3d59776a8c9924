#include "src/trajectory/turning_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "scene/pair_source.hpp"
#include "scene/static_cache.hpp"
#include "src/trajectory/bounds.hpp"

namespace onset {
namespace {

constexpr int kMostBodies = 1 << 24;

using Lists = std::array<std::vector<int>, 3>;

std::vector<int> merged(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> r;
  r.reserve(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(r));
  return r;
}

// The primitives of one kind that take part.
std::vector<int> listed(const MeshData& mesh, Primitive kind) {
  const PrimitiveFilter& filter = *mesh.filter;
  if (!filter.all) return merged(filter.moving[std::size_t(kind)], filter.statics[std::size_t(kind)]);
  std::vector<int> all(primitive_count(mesh, kind));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> vertices_of(const MeshData& mesh, const Lists& lists) {
  std::vector<bool> used(std::size_t(mesh.num_vertices));
  for (const Primitive kind : kPrimitives)
    for (const int id : lists[std::size_t(kind)])
      for (const int v : primitive_vertices(mesh, kind, id)) used[std::size_t(v)] = true;
  std::vector<int> ids;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) ids.push_back(int(v));
  return ids;
}

// The body of a primitive all of whose vertices are in one; kLinear where all are linear, else kFree.
int body_of(const MeshData& mesh, const std::vector<int>& body, Primitive kind, int id) {
  const std::array<int, 3> v = primitive_vertices(mesh, kind, id);
  const int first = body[std::size_t(v[0])];
  for (const int w : v)
    if (body[std::size_t(w)] != first) return Trajectory::kFree;
  return first;
}

// Whether the keys of these primitives may keep two of them apart, static ones aside.
bool keys_matter(const PrimitiveFilter& filter, const Lists& taking_part) {
  for (const Primitive kind : kPrimitives)
    for (const int id : taking_part[std::size_t(kind)]) {
      const PrimitiveKey& key = filter.keys[std::size_t(kind)][std::size_t(id)];
      if (key.body < 0 || (key.flags & kExcludedFlag) != 0 || (key.group & key.mask) != ~0u) return true;
    }
  return false;
}

// A mesh of the same rules in which only these primitives take part, static ones apart from the others.
std::shared_ptr<MeshData> with_lists(const MeshData& mesh, const Lists& taking_part) {
  auto data = std::make_shared<MeshData>(mesh);
  auto filter = std::make_shared<PrimitiveFilter>(*mesh.filter);
  filter->all = false;
  filter->compares_keys = filter->compares_keys && keys_matter(*filter, taking_part);
  for (const Primitive kind : kPrimitives) {
    const std::size_t k = std::size_t(kind);
    filter->moving[k].clear(), filter->statics[k].clear();
    for (const int id : taking_part[k])
      (is_static(mesh, kind, id) ? filter->statics : filter->moving)[k].push_back(id);
  }
  filter->moving_vertices = vertices_of(mesh, filter->moving);
  filter->static_vertices = vertices_of(mesh, filter->statics);
  data->static_cache = filter->has_static() ? std::make_shared<StaticCache>() : nullptr;
  data->broad_phases = std::make_shared<BroadPhasePool>();
  data->turning_scenes = nullptr;
  data->filter = std::move(filter);
  return data;
}

// Bodies that do not meet themselves have keys of their own: each rigid body is one, and so are all linear
// primitives together, but those of a body of the mesh that does not meet itself and has a part that turns.
class PieceKeys {
 public:
  PieceKeys(const MeshData& mesh, const std::vector<int>& body)
      : mesh_(mesh), body_(body), bodies_(count_bodies(mesh)), turns_(std::size_t(bodies_)) {
    for (std::size_t v = 0; v < body.size(); ++v)
      if (body[v] != Trajectory::kLinear) turns_[std::size_t(mesh.body.empty() ? 0 : mesh.body[v])] = true;
  }

  std::vector<PrimitiveKey> of(Primitive kind) const {
    std::vector<PrimitiveKey> keys = mesh_.filter->keys[std::size_t(kind)];
    if (keys.empty()) keys.assign(primitive_count(mesh_, kind), PrimitiveKey{0, 0, ~0u, ~0u});
    const bool fits = bodies_ < std::numeric_limits<int>::max() - kMostBodies - 2;
    for (std::size_t id = 0; fits && id < keys.size(); ++id) {
      const int body = body_of(mesh_, body_, kind, int(id));
      int& key = keys[id].body;
      if (body == Trajectory::kLinear && (key == 0 || !turns_[std::size_t(~key)]))
        key = ~bodies_;
      else if (body >= 0 && key == 0)
        key = ~(bodies_ + 1 + body);
    }
    return keys;
  }

 private:
  const MeshData& mesh_;
  const std::vector<int>& body_;
  const int bodies_;
  std::vector<bool> turns_;
};

// Which rigid bodies of a trajectory the mesh lets meet themselves: all, but those whose primitives are all
// of one body of the mesh that does not.
class MeetsItself {
 public:
  MeetsItself(const MeshData& mesh, const std::vector<int>& body) {
    if (!mesh.filter->keeps_apart()) return;
    for (const Primitive kind : kPrimitives)
      for (const int id : listed(mesh, kind)) {
        const int of = body_of(mesh, body, kind, id);
        if (of < 0) continue;
        const int key = mesh.filter->keys[std::size_t(kind)][std::size_t(id)].body;
        const auto [at, is_first] = key_of_.try_emplace(of, key);
        if (!is_first && at->second != key) at->second = 0;
      }
  }
  bool operator()(int body) const {
    const auto at = key_of_.find(body);
    return at == key_of_.end() || at->second == 0;
  }

 private:
  std::unordered_map<int, int> key_of_;  // of all primitives of a body, 0: several, or one that meets itself
};

}  // namespace

std::vector<int> bodies_of(const Mesh& mesh, const Trajectory& trajectory) {
  if (trajectory.num_vertices() != mesh.num_vertices())
    throw std::invalid_argument("the trajectory is of " + std::to_string(trajectory.num_vertices()) +
                                " vertices, the mesh has " + std::to_string(mesh.num_vertices()));
  std::vector<int> body(std::size_t(mesh.num_vertices()));
  for (std::size_t v = 0; v < body.size(); ++v) {
    body[v] = trajectory.body(std::ptrdiff_t(v));
    if (body[v] < Trajectory::kFree || body[v] > kMostBodies)
      throw std::invalid_argument("the trajectory puts vertex " + std::to_string(v) + " in body " +
                                  std::to_string(body[v]) + "; at most 2^24 is supported");
  }
  return body;
}

TurningScene::TurningScene(const Mesh& mesh, std::vector<int> bodies) : body(std::move(bodies)) {
  const MeshData& data = mesh.data();
  for (std::size_t v = 0; v < body.size(); ++v) {
    if (body[v] == Trajectory::kLinear) continue;
    if (!data.is_static.empty() && data.is_static[v])
      throw std::invalid_argument("vertex " + std::to_string(v) +
                                  " is static, but the trajectory is not linear there");
    turning_vertices.push_back(int(v));
  }
  Lists within;  // one rigid body
  const MeetsItself meets_itself(data, body);
  const int first_body = turning_vertices.empty() ? 0 : body[std::size_t(turning_vertices[0])];
  for (const Primitive kind : kPrimitives)
    for (const int id : listed(data, kind)) {
      const int of = body_of(data, body, kind, id);
      (of == Trajectory::kLinear ? others : turning)[std::size_t(kind)].push_back(id);
      if (of != Trajectory::kLinear && (of < 0 || of != first_body)) is_one_body = false;
      if (of >= 0 && meets_itself(of)) within[std::size_t(kind)].push_back(id), has_rest = true;
    }
  linear = Mesh(with_lists(data, others));
  rest_data = with_lists(data, within);
  rest = Mesh(rest_data);
  pieces = with_lists(data, turning);
  filter = std::make_shared<PrimitiveFilter>(*pieces->filter);
  const PieceKeys keys(data, body);
  for (const Primitive kind : kPrimitives) filter->keys[std::size_t(kind)] = keys.of(kind);
  filter->compares_keys = true;
  pieces->filter = filter;
  pieces->weld = false;
  pieces->is_static.clear();
  thickness = data.thickness;
}

void TurningScene::list(const Lists& near) {
  filter->static_vertices.clear();
  for (const Primitive kind : kPrimitives) {
    const std::size_t k = std::size_t(kind);
    filter->statics[k].clear();
    filter->moving[k] = merged(turning[k], near[k]);
  }
  filter->moving_vertices = vertices_of(*pieces, filter->moving);
}

std::optional<std::vector<double>> TurningScene::widened_at_rest(const Trajectory& trajectory) const {
  std::vector<int> rigid;
  for (const int v : turning_vertices)
    if (body[std::size_t(v)] >= 0) rigid.push_back(v);
  std::vector<double> strays(rigid.size()), widened = thickness;
  const Fault fault = ask_straying(trajectory, 1, 1, rigid.data(), rigid.size(), strays.data());
  if (fault.outcome != Outcome::free) return std::nullopt;
  widened.resize(body.size());
  const double most = strays.empty() ? 0 : *std::max_element(strays.begin(), strays.end());
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    double& of = widened[std::size_t(rigid[i])];
    of = thickness.empty() ? strays[i] : (of + most) * (1 + 0x1p-51);
  }
  return widened;
}

bool TurningScene::is_of_pieces(PairKind kind, IdPair pair) const {
  for (const int v : pair_vertices(*pieces, kind, pair))
    if (body[std::size_t(v)] != Trajectory::kLinear) return true;
  return false;
}

bool TurningScene::is_of_one_body(PairKind kind, IdPair pair) const {
  const std::array<int, 4> v = pair_vertices(*pieces, kind, pair);
  const int first = body[std::size_t(v[0])];
  return first >= 0 && std::all_of(v.begin(), v.end(), [&](int w) { return body[std::size_t(w)] == first; });
}

std::shared_ptr<TurningScene> take_turning_scene(const Mesh& mesh, std::vector<int> bodies) {
  const auto& pool = mesh.data().turning_scenes;
  if (pool)
    if (auto kept = pool->take(0); kept && kept->body == bodies) return kept;
  return std::make_shared<TurningScene>(mesh, std::move(bodies));
}

void give_back(const Mesh& mesh, std::shared_ptr<TurningScene> scene) {
  if (mesh.data().turning_scenes) mesh.data().turning_scenes->put(std::move(scene));
}

}  // namespace onset
