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
  int dimension = 3;
};

// --weld, alone; one of the body options.
void add_weld(CLI::App& command, bool& weld);

void add_body_options(CLI::App& command, BodyArguments& arguments);

// With --dim 2 makes the mesh one in the plane first. Throws UsageError for a body that the mesh has not, and
// InputError where a mesh has faces or leaves the plane z = 0.
void set_bodies(const BodyArguments& arguments, Scene& scene);

}  // namespace app
