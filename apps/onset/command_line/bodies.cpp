#include "onset/command_line/bodies.hpp"

#include <cstdint>

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

// The same edges and points, in the plane.
void lay_in_plane(Scene& scene) {
  const std::string from = scene.path + " with --dim 2: ";
  if (scene.mesh.num_faces() > 0)
    throw InputError(from + "there are " + std::to_string(scene.mesh.num_faces()) +
                     " faces, and lines alone lie in the plane");
  for (const Points* x : {&scene.x_t0, &scene.x_t1})
    for (Eigen::Index v = 0; v < x->rows(); ++v)
      if ((*x)(v, 2) != 0)
        throw InputError(from + "vertex " + std::to_string(v) + " has z = " + std::to_string((*x)(v, 2)) +
                         (x == &scene.x_t1 ? " at the end" : "") + ", not 0");
  Eigen::MatrixXi edges(scene.mesh.num_edges() - scene.mesh.num_points(), 2);
  for (Eigen::Index e = 0; e < edges.rows(); ++e) {
    const std::array<int, 2> ends = scene.mesh.edge(e);
    edges.row(e) << ends[0], ends[1];
  }
  scene.mesh = onset::Mesh::in_plane(scene.mesh.num_vertices(), edges, scene.mesh.rules());
}

}  // namespace

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
  command
      .add_option(
          "--dim", a.dimension,
          "2: lines in the plane z = 0, whose vertices meet edges; no faces, and z may be missing in OBJ")
      ->check(CLI::IsMember({2, 3}))
      ->type_name("N")
      ->capture_default_str();
  add_weld(command, a.weld);
}

void set_bodies(const BodyArguments& a, Scene& scene) {
  if (a.dimension == 2) lay_in_plane(scene);
  onset::Mesh& mesh = scene.mesh;
  onset::CollisionRules rules = mesh.rules();
  if (a.bodies == "components") rules.bodies = mesh.components();
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
