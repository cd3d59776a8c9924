// The options that say what a scene is made of.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "files/scene/scene.hpp"

namespace app {

struct BodyArguments {
  std::string bodies = "one";
  std::vector<int> fixed, rigid;
  bool all_rigid = false, weld = false;
};

// --weld, alone; one of the body options.
void add_weld(CLI::App& command, bool& weld);

void add_body_options(CLI::App& command, BodyArguments& arguments);

// Throws UsageError for a body that the mesh has not.
void set_bodies(const BodyArguments& arguments, Scene& scene);

}  // namespace app
