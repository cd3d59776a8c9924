// What step, active-set and candidates have in common: two frames in, one result out.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "files/scene/scene.hpp"
#include "onset/command_line/commands.hpp"
#include "onset/results/outputs.hpp"

namespace app {

using SceneWork = std::function<void(const Scene& scene, const onset::Options& options, Outputs& outputs)>;

// Adds the subcommand with its arguments A and B. Its run reads the scene, looks at where the outputs go,
// then calls `work`. Returns the subcommand, and its arguments in `arguments` where that is not null.
CLI::App* add_scene_command(CLI::App& app, Run& run, const std::string& name, const std::string& help,
                            const std::string& csv_columns, SceneWork work,
                            std::shared_ptr<Arguments>* arguments = nullptr);

// One line where the start intersects or touches itself, which no step can mend. `in_contact`: the result
// says that a pair touches at t = 0, or is closer than the separation.
void note_start(const Scene& scene, const onset::Options& options, bool in_contact, Outputs& outputs);

}  // namespace app
