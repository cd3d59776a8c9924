#include "scene/rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/float_environment.hpp"
#include "scene/motion/motion.hpp"
#include "scene/named_pairs.hpp"
#include "scene/pairs/rest_limits.hpp"
#include "scene/pairs/vertex_rings.hpp"

namespace onset {

void reject_row(const char* what, std::ptrdiff_t row, const std::string& why) {
  throw std::invalid_argument(std::string(what) + " row " + std::to_string(row) + ": " + why);
}

void check_size(const char* what, std::size_t size, std::ptrdiff_t wanted, const char* of) {
  if (std::ptrdiff_t(size) != wanted)
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(size) + " values for " +
                                std::to_string(wanted) + " " + of);
}

namespace {

std::vector<std::array<int, 2>> checked_pairs(const char* what, std::vector<std::array<int, 2>> pairs,
                                              std::ptrdiff_t count) {
  for (std::size_t r = 0; r < pairs.size(); ++r) {
    auto& [a, b] = pairs[r];
    for (const int i : {a, b})
      if (i < 0 || i >= count)
        reject_row(what, std::ptrdiff_t(r),
                   "id " + std::to_string(i) + " is out of range, there are " + std::to_string(count));
    if (a == b) reject_row(what, std::ptrdiff_t(r), "id " + std::to_string(a) + " is repeated");
    if (a > b) std::swap(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

template <std::size_t N>
void check_one_body(const char* what, const std::vector<std::array<int, N>>& elements,
                    const std::vector<int>& body) {
  for (std::size_t r = 0; r < elements.size(); ++r)
    for (const int v : elements[r])
      if (const int first = elements[r][0]; body[std::size_t(v)] != body[std::size_t(first)])
        reject_row(what, std::ptrdiff_t(r),
                   "vertex " + std::to_string(first) + " is in body " +
                       std::to_string(body[std::size_t(first)]) + ", vertex " + std::to_string(v) +
                       " in body " + std::to_string(body[std::size_t(v)]));
}

// Appends the points as edges {v, v} after all others.
void apply_points(const std::vector<int>& ids, MeshData& data) {
  data.edges.resize(data.edges.size() - std::size_t(data.num_points));
  enum : char { none, element, point };
  std::vector<char> part(std::size_t(data.num_vertices), none);
  for (const auto& e : data.edges)
    for (const int v : e) part[std::size_t(v)] = element;
  for (const auto& f : data.faces)
    for (const int v : f) part[std::size_t(v)] = element;
  for (std::size_t r = 0; r < ids.size(); ++r) {
    const auto bad = [&](const std::string& why) {
      reject_row("points", std::ptrdiff_t(r), "vertex " + std::to_string(ids[r]) + why);
    };
    if (ids[r] < 0 || ids[r] >= data.num_vertices)
      bad(" is out of range, there are " + std::to_string(data.num_vertices));
    char& used = part[std::size_t(ids[r])];
    if (used == element) bad(" belongs to an edge or a face");
    if (used == point) bad(" is repeated");
    used = point;
  }
  for (const int v : ids) data.edges.push_back({v, v});
  data.num_points = int(ids.size());
}

void apply_thickness(const std::vector<double>& thickness, MeshData& data) {
  if (!thickness.empty()) check_size("thickness", thickness.size(), data.num_vertices, "vertices");
  for (std::size_t v = 0; v < thickness.size(); ++v)
    if (!(thickness[v] >= 0 && thickness[v] <= kMaxCoordinate))
      reject_row("thickness", std::ptrdiff_t(v),
                 std::to_string(thickness[v]) + " is not a number >= 0, at most 2^1020");
  // No thickness at all is cheaper than one of 0 everywhere.
  const bool any = std::any_of(thickness.begin(), thickness.end(), [](double t) { return t > 0; });
  data.thickness = any ? thickness : std::vector<double>();
}

std::vector<bool> flags_of_bodies(const char* what, const std::vector<bool>& flags, const MeshData& data) {
  if (!flags.empty()) check_size(what, flags.size(), count_bodies(data), "bodies");
  return flags;
}

void apply_bodies(const CollisionRules& rules, MeshData& data) {
  const std::vector<int>& body = rules.bodies;
  if (!body.empty()) check_size("bodies", body.size(), data.num_vertices, "vertices");
  for (std::size_t v = 0; v < body.size(); ++v)
    if (body[v] < 0 || body[v] == std::numeric_limits<int>::max())
      reject_row("bodies", std::ptrdiff_t(v), "id " + std::to_string(body[v]) + " is not in [0, 2^31 - 1)");
  if (!body.empty()) {
    check_one_body("edge", data.edges, body);
    check_one_body("face", data.faces, body);
  }
  data.body = body;
  data.rigid = flags_of_bodies("rigid_bodies", rules.rigid_bodies, data);
  data.no_self = flags_of_bodies("bodies_without_self_collision", rules.bodies_without_self_collision, data);
  data.excluded_bodies = checked_pairs("excluded_bodies", rules.excluded_bodies, count_bodies(data));
}

void apply_groups(const CollisionRules& rules, MeshData& data) {
  if (!rules.groups.empty() || !rules.masks.empty()) {
    check_size("groups", rules.groups.size(), data.num_vertices, "vertices");
    check_size("masks", rules.masks.size(), data.num_vertices, "vertices");
  }
  data.group = rules.groups, data.mask = rules.masks;
}

void apply_planes(const std::vector<Plane>& planes, MeshData& data) {
  for (std::size_t r = 0; r < planes.size(); ++r) {
    const auto& n = planes[r].normal;
    for (const double x : n)
      if (!std::isfinite(x)) reject_row("planes", std::ptrdiff_t(r), "its normal is not finite");
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) reject_row("planes", std::ptrdiff_t(r), "its normal is 0");
    if (data.dimension == 2 && n[2] != 0)
      reject_row("planes", std::ptrdiff_t(r), "its normal leaves the plane of the mesh");
    if (!std::isfinite(planes[r].offset)) reject_row("planes", std::ptrdiff_t(r), "its offset is not finite");
  }
  data.planes = planes;
}

void apply_pairs(const CollisionRules& rules, MeshData& data) {
  const std::vector<PairKind> kinds =
      data.dimension == 2 ? std::vector{PairKind::vertex_edge, PairKind::vertex_plane}
                          : std::vector{PairKind::vertex_face, PairKind::edge_edge, PairKind::vertex_plane};
  NamedPairs pairs("excluded_pairs", data, kinds);
  for (const Pair& p : rules.excluded_pairs) pairs.add(p.kind, p.a, p.b);
  for (const PairKind kind : kinds) data.excluded_pairs[std::size_t(kind)] = pairs.of(kind);
  const PairKind kind = intersection_kind(data);
  NamedPairs intersections("excluded_intersections", data, {kind});
  for (const Intersection& p : rules.excluded_intersections) intersections.add(kind, p.edge, p.face);
  data.excluded_pairs[std::size_t(kind)] = intersections.of(kind);
}

std::string out_of_range(const std::string& what, const char* range) {
  return what + " is not a number " + range + ", at most 2^1020";
}

void apply_body_separations(const std::vector<BodySeparation>& list, MeshData& data) {
  constexpr const char* kName = "body_separations";
  const int bodies = count_bodies(data);
  std::vector<std::pair<std::array<int, 2>, std::ptrdiff_t>> rows;
  data.body_separations.clear();
  for (std::size_t r = 0; r < list.size(); ++r) {
    const BodySeparation& s = list[r];
    for (const int b : {s.body_a, s.body_b})
      if (b < 0 || b >= bodies)
        reject_row(kName, std::ptrdiff_t(r),
                   "id " + std::to_string(b) + " is out of range, there are " + std::to_string(bodies));
    if (!(s.separation >= 0 && s.separation <= kMaxCoordinate))
      reject_row(kName, std::ptrdiff_t(r), out_of_range(std::to_string(s.separation), ">= 0"));
    rows.push_back({{std::min(s.body_a, s.body_b), std::max(s.body_a, s.body_b)}, std::ptrdiff_t(r)});
  }
  std::sort(rows.begin(), rows.end());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [bodies_of_row, r] = rows[i];
    if (i > 0 && rows[i - 1].first == bodies_of_row)
      reject_row(kName, r,
                 "bodies " + std::to_string(bodies_of_row[0]) + " and " + std::to_string(bodies_of_row[1]) +
                     " are repeated");
    data.body_separations.push_back({bodies_of_row[0], bodies_of_row[1], list[std::size_t(r)].separation});
  }
}

void apply_rest(const CollisionRules& rules, MeshData& data) {
  data.rest = nullptr;
  if (!(rules.rest_share > 0 && rules.rest_share < 1))
    throw std::invalid_argument("rest_share is " + std::to_string(rules.rest_share) +
                                "; it must be in (0, 1)");
  const StoredPositions& x = rules.rest_positions;
  if (x.size() == 0 && (x.rows() == 0 || data.num_vertices == 0)) return;
  if (x.rows() != data.num_vertices || x.cols() != data.dimension)
    throw std::invalid_argument("rest_positions has " + std::to_string(x.rows()) + " rows of " +
                                std::to_string(x.cols()) + " coordinates for " +
                                std::to_string(data.num_vertices) + " vertices, not rows of " +
                                std::to_string(data.dimension));
  auto rest = std::make_shared<RestShape>();
  rest->share = rules.rest_share;
  for (std::ptrdiff_t v = 0; v < x.rows(); ++v)
    for (int a = 0; a < 3; ++a) {
      const double at = a < data.dimension ? x(v, a) : 0;
      if (!(std::fabs(at) <= kMaxCoordinate))
        reject_row("rest_positions", v, out_of_range(std::to_string(at), "of magnitude"));
      rest->x.push_back(at);
    }
  data.rest = std::move(rest);
}

void apply_rings(int rings, MeshData& data) {
  data.rings = nullptr;
  if (rings < 0)
    throw std::invalid_argument("excluded_rings is " + std::to_string(rings) + "; it must be >= 0");
  if (rings > 0) data.rings = std::make_shared<const VertexRings>(data, rings, VertexRings::kMostPairs);
}

}  // namespace

void apply_rules(const CollisionRules& rules, MeshData& data) {
  const FloatEnvironment environment;
  apply_points(rules.points, data);
  apply_thickness(rules.thickness, data);
  apply_bodies(rules, data);
  if (!rules.static_vertices.empty())
    check_size("static_vertices", rules.static_vertices.size(), data.num_vertices, "vertices");
  data.is_static = rules.static_vertices;
  apply_body_separations(rules.body_separations, data);
  apply_rest(rules, data);
  apply_groups(rules, data);
  data.weld = rules.weld;
  data.excluded_vertices = checked_pairs("excluded_vertices", rules.excluded_vertices, data.num_vertices);
  apply_planes(rules.planes, data);
  apply_pairs(rules, data);
  apply_rings(rules.excluded_rings, data);
}

}  // namespace onset
