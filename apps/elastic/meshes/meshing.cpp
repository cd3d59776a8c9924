#include "elastic/meshes/meshing.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace elastic {
namespace {

namespace P = CGAL::parameters;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr double kPi = 3.14159265358979323846;

void add(TetMesh& mesh, Tetrahedron t) {
  const auto& p = mesh.points;
  const Vec3 a = p[std::size_t(t[0])];
  const Vec3 b = p[std::size_t(t[1])] - a, c = p[std::size_t(t[2])] - a, d = p[std::size_t(t[3])] - a;
  if (b.cross(c).dot(d) < 0) std::swap(t[2], t[3]);
  mesh.tetrahedra.push_back(t);
}

Complex mesh_of_size(const std::function<double(const Vec3&)>& f, double radius, double size) {
  CGAL::get_default_random() = CGAL::Random(0);
  const auto at_point = [&](const Kernel::Point_3& p) { return f(Vec3(p.x(), p.y(), p.z())); };
  const Domain domain = Domain::create_implicit_mesh_domain(
      at_point, Kernel::Sphere_3(CGAL::ORIGIN, radius * radius), P::relative_error_bound = 1e-5);
  const Criteria criteria(P::facet_angle = 25, P::facet_size = size, P::facet_distance = 0.15 * size,
                          P::cell_radius_edge_ratio = 2, P::cell_size = size);
  Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, P::no_perturb(), P::no_exude());
  // Slivers go by moving vertices, with no limit of time; exudation, which Mesh_3 would end with, depends on
  // where vertices lie in memory.
  CGAL::odt_optimize_mesh_3(complex, domain, P::max_iteration_number = 20, P::convergence = 0.0,
                            P::freeze_bound = 0.0, P::do_freeze = false);
  CGAL::perturb_mesh_3(complex, domain, P::sliver_bound = 12);
  return complex;
}

}  // namespace

TetMesh mesh_implicit(const std::function<double(const Vec3&)>& f, double radius, double volume, int count) {
  // Fine cells of a size s are about 4.8 volume / s^3; where the surface asks for more, a larger size is
  // tried.
  double size = std::cbrt(4.8 * volume / count);
  Complex complex = mesh_of_size(f, radius, size);
  for (int i = 0; i < 3 && double(complex.number_of_cells_in_complex()) > 1.1 * count; ++i) {
    size *= std::cbrt(double(complex.number_of_cells_in_complex()) / count);
    complex = mesh_of_size(f, radius, size);
  }
  TetMesh mesh;
  std::unordered_map<Triangulation::Vertex_handle, int> ids;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    Tetrahedron t;
    for (int i = 0; i < 4; ++i) {
      const auto v = cell->vertex(i);
      const auto [found, is_new] = ids.try_emplace(v, int(mesh.points.size()));
      if (is_new) mesh.points.emplace_back(v->point().x(), v->point().y(), v->point().z());
      t[std::size_t(i)] = found->second;
    }
    add(mesh, t);
  }
  return mesh;
}

TetMesh torus(double large, double small, int count) {
  const auto f = [=](const Vec3& p) {
    const double ring = std::hypot(p.x(), p.y()) - large;
    return ring * ring + p.z() * p.z() - small * small;
  };
  return mesh_implicit(f, 1.2 * (large + small), 2 * kPi * kPi * large * small * small, count);
}

TetMesh ball(double radius, int count) {
  return mesh_implicit([=](const Vec3& p) { return p.squaredNorm() - radius * radius; }, 1.2 * radius,
                       4.0 / 3 * kPi * std::pow(radius, 3), count);
}

TetMesh rounded_cube(double half, int count) {
  const auto f = [=](const Vec3& p) { return p.array().square().square().sum() - std::pow(half, 4); };
  return mesh_implicit(f, 1.6 * half, 6.48 * std::pow(half, 3), count);
}

TetMesh box(const Vec3& size, const std::array<int, 3>& n) {
  TetMesh mesh;
  for (int i = 0; i <= n[0]; ++i)
    for (int j = 0; j <= n[1]; ++j)
      for (int k = 0; k <= n[2]; ++k)
        mesh.points.push_back(
            size.cwiseProduct(Vec3(double(i) / n[0] - 0.5, double(j) / n[1] - 0.5, double(k) / n[2] - 0.5)));
  const auto id = [&](int i, int j, int k) { return (i * (n[1] + 1) + j) * (n[2] + 1) + k; };
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        // Along the axes in each of their orders, from one corner to the opposite one.
        std::array<int, 3> order{0, 1, 2};
        do {
          std::array<int, 3> corner{i, j, k};
          Tetrahedron t{id(i, j, k), 0, 0, 0};
          for (std::size_t a = 0; a < 3; ++a) {
            ++corner[std::size_t(order[a])];
            t[a + 1] = id(corner[0], corner[1], corner[2]);
          }
          add(mesh, t);
        } while (std::next_permutation(order.begin(), order.end()));
      }
  return mesh;
}

TetMesh cone(double radius, double height, int sides) {
  TetMesh mesh;
  mesh.points = {{0, 0, height}, {0, 0, 0}};
  for (int i = 0; i < sides; ++i)
    mesh.points.emplace_back(radius * std::cos(2 * kPi * i / sides), radius * std::sin(2 * kPi * i / sides),
                             0);
  for (int i = 0; i < sides; ++i) add(mesh, {0, 1, 2 + i, 2 + (i + 1) % sides});
  return mesh;
}

}  // namespace elastic
