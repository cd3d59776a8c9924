#include "tests/steps/support/pair_separations.hpp"

#include <map>

#include "scene/pairs/separation.hpp"
#include "scene/primitive_filter.hpp"
#include "src/shared/rest/rest_limits.hpp"
#include "tests/oracle/walk.hpp"
#include "tests/scenes/families.hpp"
#include "tests/scenes/rule_filter.hpp"

namespace onset::tests {
namespace {

using scenes::Random;

double size_of(const StepScene& scene) {
  return (scene.x_t0.colwise().maxCoeff() - scene.x_t0.colwise().minCoeff()).maxCoeff();
}

double part_of(double size, Random& random) {
  return std::ldexp(1.0, std::ilogb(size) - scenes::integer(random, 2, 8));
}

void add_rest(const StepScene& scene, double size, Random& random, CollisionRules& rules) {
  rules.rest_positions = scene.x_t0;
  rules.rest_share = scenes::coin(random) ? 0.5 : scenes::uniform(random, 0.05, 0.95);
  const int how = scenes::integer(random, 0, 3);
  if (how == 1) rules.rest_positions = scene.x_t1;
  if (how == 2) rules.rest_positions = 0.5 * scene.x_t0;
  if (how != 3) return;
  Eigen::MatrixXd shaken = scene.x_t0;
  for (double& x : shaken.reshaped()) x += scenes::uniform(random, -0.1, 0.1) * size;
  rules.rest_positions = shaken;
}

// What the documentation says, but for rounding; lo and hi: of the distance at rest.
std::string wrong_limit(double found, double whole, double share, const scenes::Query& rest, Norm norm) {
  const oracle::Bracket d = oracle::distance(rest, 0, norm);
  const double most = std::nextafter(share * d.lo, INFINITY),
               slack = 0x1p-44 * oracle::extent(rest) + 0x1p-1060;
  if (found > std::min(whole * (1 + 0x1p-49), most)) return "a pair keeps more than its share";
  return found < std::min(whole, most) - slack ? "a pair keeps less than its share" : "";
}

}  // namespace

void add_pair_rules(const StepScene& scene, Random& random, Options& options, CollisionRules& rules) {
  const double size = size_of(scene);
  if (scenes::integer(random, 0, 2) == 0) rules.excluded_rings = scenes::integer(random, 1, 2);
  if (!(size > 0x1p-300 && size < 0x1p300)) return;
  if (scenes::coin(random)) options.min_separation = part_of(size, random);
  if (scenes::integer(random, 0, 2) != 0) add_rest(scene, size, random, rules);
  if (scenes::coin(random)) return;
  CollisionRules none;
  none.points = rules.points;
  rules.bodies = Mesh(scene.x_t0, scene.edges, scene.faces, none).components();
  const int bodies = *std::max_element(rules.bodies.begin(), rules.bodies.end()) + 1;
  for (int a = 0; a < bodies; ++a)
    for (int b = a; b < bodies; ++b)
      if (scenes::coin(random))
        rules.body_separations.push_back(
            {b, a, scenes::integer(random, 0, 3) == 0 ? 0 : part_of(size, random)});
}

std::function<double(PairKind, const std::array<int, 4>&)> separations_of(const Mesh& mesh,
                                                                          const Options& options,
                                                                          std::string& wrong) {
  const CollisionRules& rules = mesh.rules();
  const auto body = [&](int vertex) { return rules.bodies.empty() ? 0 : rules.bodies[std::size_t(vertex)]; };
  Options plenty;
  plenty.min_separation = options.min_separation, plenty.norm = options.norm;
  Budget budget(plenty);
  const auto limits = rest_limits(mesh.data(), plenty, budget);
  std::map<std::pair<PairKind, std::array<int, 4>>, double> all;
  for_all_pairs(mesh, [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    const double found = separation_of_pair(mesh.data(), plenty, limits.get(), kind, {a, b}, v.data());
    all[{kind, v}] = found;
    const int side = scenes::first_body(kind);
    double whole = options.min_separation;
    for (const BodySeparation& s : rules.body_separations) {
      const int first = body(v[0]), second = body(v[std::size_t(side)]);
      if ((s.body_a == first && s.body_b == second) || (s.body_a == second && s.body_b == first))
        whole = s.separation;
    }
    if (!rules.thickness.empty())
      whole += thickest(rules.thickness, v, 0, side) + thickest(rules.thickness, v, side, 4);
    if (rules.rest_positions.rows() == 0) {
      if (found < whole || found > whole * (1 + 0x1p-49)) wrong = "a pair keeps another separation";
    } else if (wrong.empty()) {
      // Pairs that never meet have no limit.
      const bool meets = may_meet(mesh.data(), kind, a, b);
      const scenes::Query rest = query_of(kind, v, rules.rest_positions, rules.rest_positions);
      if (meets) wrong = wrong_limit(found, whole, rules.rest_share, rest, options.norm);
    }
  });
  return [all](PairKind kind, const std::array<int, 4>& v) { return all.at({kind, v}); };
}

std::function<bool(PairKind, int, int, const std::array<int, 4>&)> beyond_rings(const Mesh& mesh) {
  const int rings = mesh.rules().excluded_rings;
  std::vector<std::array<int, 2>> edges;
  for (int e = 0; e < mesh.num_edges(); ++e) edges.push_back(mesh.edge(e));
  const scenes::EdgeDistances distances(int(mesh.num_vertices()), edges);
  return [=](PairKind kind, int, int, const std::array<int, 4>& v) {
    const int side = scenes::first_body(kind);
    return !distances.within(rings, {v.begin(), v.begin() + side}, {v.begin() + side, v.end()});
  };
}

}  // namespace onset::tests
