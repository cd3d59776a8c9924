// The options that say what a scene is made of.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/scene/scene.hpp"

namespace app {

struct BodyArguments {
  std::string bodies = "one";
  std::vector<int> fixed, rigid;
  bool all_rigid = false, weld = false;
  int dimension = 3;
  int rings = 0;
  std::vector<std::string> separations;  // I,J,LENGTH each
  std::string rest;                      // a path; empty for none
  std::optional<double> rest_share;
  std::vector<std::string> planes;
};

// --weld and --plane, alone; they are among the body options.
void add_weld(CLI::App& command, bool& weld);
void add_planes(CLI::App& command, std::vector<std::string>& planes);
// Makes planes of their texts, which the option has checked.
std::vector<onset::Plane> to_planes(const std::vector<std::string>& texts);

void add_body_options(CLI::App& command, BodyArguments& arguments);

// With --dim 2 makes the mesh one in the plane first. Throws UsageError for a body that the mesh has not, and
// InputError where a mesh has faces or leaves the plane z = 0, and for a shape at rest of another mesh.
void set_bodies(const BodyArguments& arguments, Scene& scene);

}  // namespace app
