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

onset::BodySeparation separation_of(const std::string& text, int count) {
  const std::size_t first = text.find(','), second = text.find(',', first + 1);
  if (first == std::string::npos || second == std::string::npos)
    throw UsageError("--body-separation " + text + ": two bodies and a length expected, such as 0,1,0.01");
  const auto body = [&](const std::string& id) {
    return int(parse_whole("--body-separation", id, 0, INT32_MAX));
  };
  onset::BodySeparation s{body(text.substr(0, first)), body(text.substr(first + 1, second - first - 1)), 0};
  flags("--body-separation", {s.body_a, s.body_b}, count);
  s.separation = parse_real("--body-separation", text.substr(second + 1), Zero::allowed);
  return s;
}

// Throws InputError for a vertex that is not in the plane z = 0; `when` says of which positions.
void require_in_plane(const std::string& path, const Points& x, const char* when) {
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    if (x(v, 2) != 0)
      throw InputError(path + " with --dim 2: vertex " + std::to_string(v) +
                       " has z = " + std::to_string(x(v, 2)) + when + ", not 0");
}

void set_rest(const BodyArguments& a, const Scene& scene, onset::CollisionRules& rules) {
  if (a.rest.empty() && a.rest_share) throw UsageError("--rest-share needs --rest");
  if (a.rest.empty()) return;
  const Points rest = read_scene(scene.path, a.rest).x_t1;
  if (a.dimension == 2) require_in_plane(a.rest, rest, "");
  rules.rest_positions = rest.leftCols(a.dimension);
  if (a.rest_share) rules.rest_share = *a.rest_share;
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

// The same edges and points, in the plane.
void lay_in_plane(Scene& scene) {
  if (scene.mesh.num_faces() > 0)
    throw InputError(scene.path + " with --dim 2: there are " + std::to_string(scene.mesh.num_faces()) +
                     " faces, and lines alone lie in the plane");
  require_in_plane(scene.path, scene.x_t0, "");
  require_in_plane(scene.path, scene.x_t1, " at the end");
  Eigen::MatrixXi edges(scene.mesh.num_edges() - scene.mesh.num_points(), 2);
  for (Eigen::Index e = 0; e < edges.rows(); ++e) {
    const std::array<int, 2> ends = scene.mesh.edge(e);
    edges.row(e) << ends[0], ends[1];
  }
  scene.mesh = onset::Mesh::in_plane(scene.mesh.num_vertices(), edges, scene.mesh.rules());
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
  command
      .add_option(
          "--dim", a.dimension,
          "2: lines in the plane z = 0, whose vertices meet edges; no faces, and z may be missing in OBJ")
      ->check(CLI::IsMember({2, 3}))
      ->type_name("N")
      ->capture_default_str();
  add_weld(command, a.weld);
  add_whole(command, "--rings", a.rings, "N",
            "Pairs joined by at most N edges of the mesh never meet, as those that share a vertex", 0,
            INT32_MAX);
  command
      .add_option("--body-separation", a.separations,
                  "Bodies I and J (or I and itself) keep LENGTH in place of --min-separation (repeat)")
      ->type_name("I,J,LENGTH")
      ->expected(1)
      ->take_all();
  command
      .add_option(
          "--rest", a.rest,
          "The same mesh at rest: no pair keeps more than a share of its distance there, so that a mesh "
          "may be finer than its separation")
      ->check(path_fault)
      ->type_name("FILE");
  const auto take = [&a](const std::string& text) {
    a.rest_share = parse_real("--rest-share", text, Zero::refused);
    if (*a.rest_share >= 1) throw CLI::ValidationError("--rest-share", text + " is not below 1");
  };
  command.add_option_function<std::string>("--rest-share", take, "That share (default 0.5)")->type_name("S");
  add_planes(command, a.planes);
}

void set_bodies(const BodyArguments& a, Scene& scene) {
  if (a.dimension == 2) lay_in_plane(scene);
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
  rules.excluded_rings = a.rings;
  for (const std::string& text : a.separations) rules.body_separations.push_back(separation_of(text, count));
  set_rest(a, scene, rules);
  mesh.set_rules(rules);
}

}  // namespace app
