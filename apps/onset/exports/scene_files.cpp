#include "onset/exports/scene_files.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "files/error.hpp"
#include "onset/command_line/values.hpp"
#include "onset/exports/geometry_files.hpp"
#include "onset/exports/query_dump.hpp"

namespace app {
namespace {

constexpr std::size_t kDumpedContacts = 64;

// A vertex and an edge are written as a vertex and a face of two corners, with z = 0: the same pair.
std::vector<DumpedPair> in_space(std::vector<DumpedPair> pairs) {
  for (DumpedPair& p : pairs)
    if (p.pair.kind == onset::PairKind::vertex_edge) p.pair.kind = onset::PairKind::vertex_face;
  return pairs;
}

void add_worst(std::vector<DumpedPair>& pairs, const onset::Stats& stats) {
  if (stats.worst) pairs.push_back({*stats.worst, "worst"});
}

}  // namespace

void add_scene_files(CLI::App& command, SceneFiles& files) {
  command
      .add_option("--dump", files.dump,
                  "Write the queries that matter, the limiting or earliest and the worst, to NAME-vf.csv and "
                  "NAME-ee.csv "
                  "(exact rationals) with their answers in .json beside them, for onset replay")
      ->check(path_fault)
      ->type_name("NAME");
  command
      .add_option(
          "--export", files.geometry,
          "Write NAME-contacts.ply, NAME-candidates.ply and NAME-swept.ply, coloured by time of impact: red "
          "first, blue last, grey never (for step: the earliest contacts)")
      ->check(path_fault)
      ->type_name("NAME");
}

void announce(const SceneFiles& files, const Scene& scene, Outputs& outputs) {
  const onset::CollisionRules& rules = scene.mesh.rules();
  if (!files.dump.empty() && (!rules.body_separations.empty() || rules.rest_positions.rows() > 0))
    throw UsageError(
        "--dump: the queries of a dump have one separation; without --rest and --body-separation");
  if (!files.dump.empty() && !rules.planes.empty())
    throw UsageError("--dump: a dump holds no pairs of a vertex and a plane; without --plane");
  for (const char* option : {"--dump", "--export"})
    if ((option[2] == 'd' ? files.dump : files.geometry) == "-")
      throw UsageError(std::string(option) + ": a name for several files expected, not -");
  if (!files.dump.empty())
    for (const std::string& path : dump_files(files.dump)) outputs.announce("--dump", path);
  if (!files.geometry.empty())
    for (const std::string& path : geometry_files(files.geometry)) outputs.announce("--export", path);
}

void write_files(const SceneFiles& files, const Scene& scene, const onset::Options& options,
                 const onset::StepResult& result, Outputs& outputs) {
  if (!files.dump.empty()) {
    std::vector<DumpedPair> pairs;
    if (result.limiting) pairs.push_back({*result.limiting, "limiting"});
    add_worst(pairs, result.stats);
    write_dump(files.dump, in_space(std::move(pairs)), scene.x_t0, scene.x_t1, options,
               result.stats.tolerance, outputs);
  }
  if (files.geometry.empty()) return;
  onset::Options earliest = options;
  earliest.window = 0;
  write_geometry(files.geometry, scene, options,
                 onset::construct_active_set(scene.mesh, scene.start(), scene.end(), earliest), outputs);
}

void write_files(const SceneFiles& files, const Scene& scene, const onset::Options& options,
                 const onset::ActiveSet& set, Outputs& outputs) {
  if (!files.dump.empty()) {
    std::vector<std::size_t> order(set.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return set[i].toi < set[j].toi; });
    std::vector<DumpedPair> pairs;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool gave_up = set[order[k]].outcome == onset::PairOutcome::max_checks;
      if (k < kDumpedContacts || gave_up) pairs.push_back({set[order[k]], gave_up ? "budget" : "contact"});
    }
    add_worst(pairs, set.stats);
    write_dump(files.dump, in_space(std::move(pairs)), scene.x_t0, scene.x_t1, options, set.stats.tolerance,
               outputs);
  }
  if (!files.geometry.empty()) write_geometry(files.geometry, scene, options, set, outputs);
}

}  // namespace app
