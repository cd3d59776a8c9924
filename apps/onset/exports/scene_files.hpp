// What step and active-set leave behind for other programs: dumps of queries, and geometry to look at.
#pragma once

#include <onset/onset.hpp>
#include <string>

#include "files/scene/scene.hpp"
#include "onset/command_line/arguments.hpp"
#include "onset/results/outputs.hpp"

namespace app {

struct SceneFiles {
  std::string dump, geometry;  // names, empty for none
};

// --dump and --export.
void add_scene_files(CLI::App& command, SceneFiles& files);

// Before the work starts. Throws UsageError where pairs have separations of their own, for a dump has one for
// all.
void announce(const SceneFiles& files, const Scene& scene, Outputs& outputs);

// The pairs that matter: a step's limiting and worst pair; of an active set the earliest contacts, those that
// spent their budget, and the worst pair.
void write_files(const SceneFiles& files, const Scene& scene, const onset::Options& options,
                 const onset::StepResult& result, Outputs& outputs);
void write_files(const SceneFiles& files, const Scene& scene, const onset::Options& options,
                 const onset::ActiveSet& set, Outputs& outputs);

}  // namespace app
