#include "onset/command_line/bodies.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "files/error.hpp"
#include "onset/command_line/values.hpp"

namespace app {
namespace {

std::vector<bool> flags(const char* option, const std::vector<int>& bodies, int count) {
  std::vector<bool> marks(static_cast<std::size_t>(count));
  for (const int b : bodies) {
    if (b < 0 || b >= count)
      throw UsageError(std::string(option) + " " + std::to_string(b) + ": there are " +
                       std::to_string(count) + " bodies, numbered from 0" +
                       (count == 1 ? " (see --bodies components)" : ""));
    marks[static_cast<std::size_t>(b)] = true;
  }
  return marks;
}

// nx,ny,nz,offset: four finite numbers, and a normal other than 0; none for another text.
std::optional<onset::Plane> to_plane(const std::string& text) {
  double x[4];
  const char* at = text.c_str();
  for (int i = 0; i < 4; ++i) {
    char* end = nullptr;
    x[i] = std::strtod(at, &end);
    if (end == at || !std::isfinite(x[i]) || *end != (i < 3 ? ',' : '\0')) return std::nullopt;
    at = end + 1;
  }
  if (x[0] == 0 && x[1] == 0 && x[2] == 0) return std::nullopt;
  onset::Plane plane;
  plane.normal = {x[0], x[1], x[2]}, plane.offset = x[3];
  return plane;
}

std::string plane_fault(const std::string& text) {
  if (to_plane(text)) return "";
  return "four finite numbers nx,ny,nz,offset and a normal other than 0 expected, not '" + text + "'";
}

}  // namespace

void add_planes(CLI::App& command, std::vector<std::string>& planes) {
  command
      .add_option(
          "--plane", planes,
          "A half-space that vertices stay out of: x is free where nx x + ny y + nz z > offset (repeat)")
      ->check(plane_fault)
      ->type_name("NX,NY,NZ,OFFSET")
      ->expected(1)
      ->take_all();
}

std::vector<onset::Plane> to_planes(const std::vector<std::string>& texts) {
  std::vector<onset::Plane> planes;
  for (const std::string& text : texts)
    if (const auto plane = to_plane(text)) planes.push_back(*plane);
  return planes;
}

void add_weld(CLI::App& command, bool& weld) {
  command.add_flag("--weld", weld,
                   "Vertices at one place at both ends of the step count as one, as the copies at a seam do");
}

void add_body_options(CLI::App& command, BodyArguments& a) {
  command.add_option("--bodies", a.bodies, "What a body is: all of the mesh, or each connected component")
      ->check(CLI::IsMember({"one", "components"}))
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--static-body", a.fixed,
                  "Body I stays where it is and never meets what is static (repeat)")
      ->check(whole_numbers(0, INT32_MAX))
      ->type_name("I")
      ->expected(1)
      ->take_all();
  command.add_option("--rigid-body", a.rigid, "Body I never meets itself (repeat)")
      ->check(whole_numbers(0, INT32_MAX))
      ->type_name("I")
      ->expected(1)
      ->take_all();
  command.add_flag("--rigid", a.all_rigid, "No body meets itself");
  add_weld(command, a.weld);
  add_planes(command, a.planes);
}

void set_bodies(const BodyArguments& a, Scene& scene) {
  onset::Mesh& mesh = scene.mesh;
  onset::CollisionRules rules = mesh.rules();
  if (a.bodies == "components") rules.bodies = mesh.components();
  rules.planes = to_planes(a.planes);
  mesh.set_rules(rules);
  const int count = mesh.num_bodies();
  const std::vector<bool> fixed = flags("--static-body", a.fixed, count);
  std::vector<bool> rigid = flags("--rigid-body", a.rigid, count);
  if (a.all_rigid) rigid.assign(rigid.size(), true);
  if (!a.fixed.empty()) rules.static_vertices = mesh.of_bodies(fixed);
  if (a.all_rigid || !a.rigid.empty()) rules.rigid_bodies = rigid;
  if (a.weld) rules.weld = scene.welded = true;
  mesh.set_rules(rules);
}

}  // namespace app
