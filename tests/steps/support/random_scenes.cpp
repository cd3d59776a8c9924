#include "tests/steps/support/random_scenes.hpp"

#include <array>

#include "tests/queries/random_query.hpp"
#include "tests/scenes/families.hpp"

namespace onset::tests {

using scenes::integer;
using scenes::Random;

namespace {

// Collects vertices, faces and wires.
struct Builder {
  std::vector<Point> x_t0, x_t1;
  std::vector<std::array<int, 3>> faces;
  std::vector<std::array<int, 2>> wires;

  int add(const Point& from, const Point& to) {
    x_t0.push_back(from), x_t1.push_back(to);
    return int(x_t0.size()) - 1;
  }
  StepScene scene() const {
    StepScene s;
    for (const auto& [points, x] : {std::pair(&x_t0, &s.x_t0), std::pair(&x_t1, &s.x_t1)}) {
      x->resize(Eigen::Index(points->size()), 3);
      for (Eigen::Index v = 0; v < x->rows(); ++v)
        for (int a = 0; a < 3; ++a) (*x)(v, a) = (*points)[std::size_t(v)][std::size_t(a)];
    }
    s.faces.resize(Eigen::Index(faces.size()), 3);
    for (Eigen::Index f = 0; f < s.faces.rows(); ++f)
      for (int k = 0; k < 3; ++k) s.faces(f, k) = faces[std::size_t(f)][std::size_t(k)];
    const Eigen::MatrixXi sides = onset::edges(s.faces);
    s.edges.resize(sides.rows() + Eigen::Index(wires.size()), 2);
    if (sides.rows() > 0) s.edges.topRows(sides.rows()) = sides;
    for (std::size_t e = 0; e < wires.size(); ++e)
      s.edges.row(sides.rows() + Eigen::Index(e)) << wires[e][0], wires[e][1];
    return s;
  }
  // A triangle or a wire whose corners are the next that `point` gives.
  template <class F>
  void add_element(bool triangle, F&& point) {
    int v[3] = {0, 0, 0};
    for (int k = 0; k < (triangle ? 3 : 2); ++k) {
      const std::pair<Point, Point> p = point();
      v[k] = add(p.first, p.second);
    }
    if (triangle)
      faces.push_back({v[0], v[1], v[2]});
    else
      wires.push_back({v[0], v[1]});
  }
};

Point small_integers(Random& random, int most) {
  Point p;
  for (double& x : p) x = integer(random, -most, most);
  return p;
}

}  // namespace

StepScene grid_scene(Random& random) {
  Builder b;
  const int most = integer(random, 1, 4);
  const bool translate = integer(random, 0, 2) == 0;  // each element as a whole
  for (int i = integer(random, 2, 4); i > 0; --i) {
    const Point step = small_integers(random, most);
    b.add_element(integer(random, 0, 3) != 0, [&] {
      const Point p = small_integers(random, most);
      return std::pair(p, translate ? scenes::plus(p, step) : small_integers(random, most));
    });
  }
  StepScene s = b.scene();
  const double unit = std::ldexp(1.0, integer(random, 0, 3) ? 0 : integer(random, -60, 60));
  s.x_t0 *= unit, s.x_t1 *= unit;
  return s;
}

StepScene floor_scene(Random& random) {
  Builder b;
  const double size =
      integer(random, 0, 1) ? std::ldexp(1.0, integer(random, 1, 20)) : scenes::power_of_ten(random, 0, 6);
  int corner[4];
  for (int i = 0; i < 4; ++i) {
    const Point p{i & 1 ? size : -size, i & 2 ? size : -size, 0};
    corner[i] = b.add(p, p);
  }
  b.faces.push_back({corner[0], corner[1], corner[3]}), b.faces.push_back({corner[0], corner[3], corner[2]});
  const double unit = scenes::coin(random) ? 1 : scenes::power_of_ten(random, -9, 0);
  for (int i = integer(random, 1, 2); i > 0; --i) {
    const Point where = small_integers(random, 4);
    const double height = integer(random, 1, 4), falls = height * integer(random, 0, 4) * 0.5;
    const Point slides = scenes::coin(random) ? Point{} : small_integers(random, 1);
    const bool tilted = scenes::coin(random);
    b.add_element(scenes::coin(random), [&] {
      Point p = scenes::plus(where, small_integers(random, 2));
      p[2] = height + (tilted ? integer(random, 0, 2) : 0);
      const Point to = scenes::plus(scenes::plus(p, slides), {0, 0, -falls});
      return std::pair(scenes::times(unit, p), scenes::times(unit, to));
    });
  }
  StepScene s = b.scene();
  const int axis = integer(random, 0, 2);
  for (Eigen::MatrixXd* x : {&s.x_t0, &s.x_t1}) x->col(axis).swap(x->col(2));
  return s;
}

StepScene family_scene(Random& random) {
  Builder b;
  const auto& families = scenes::families();
  const scenes::Family& family = families[std::size_t(integer(random, 0, int(families.size()) - 1))];
  for (int i = integer(random, 1, 2); i > 0; --i) {
    const PairKind kind = scenes::coin(random) ? PairKind::vertex_face : PairKind::edge_edge;
    const scenes::Query query = family.make(kind, random);
    int v[4];
    for (std::size_t k = 0; k < 4; ++k) v[k] = b.add(query.t0[k], query.t1[k]);
    if (kind == PairKind::vertex_face)
      b.faces.push_back({v[1], v[2], v[3]});
    else
      b.wires.push_back({v[0], v[1]}), b.wires.push_back({v[2], v[3]});
  }
  return b.scene();
}

StepScene tetrahedra(Random& random) {
  Builder b;
  const double rough = scenes::coin(random) ? 0 : 0.2;
  for (double side : {-1.0, 1.0}) {
    int v[4];
    const Point centre{side * 2, side * scenes::uniform(random, 0, 0.5), 0},
        step = scenes::point(random, 0.5);
    for (int k = 0; k < 4; ++k) {
      const Point p =
          scenes::plus(centre, {k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k == 1 || k == 2 ? 1.0 : -1.0});
      const Point to = scenes::plus(scenes::plus(p, {-side * 2.0, 0, 0}),
                                    scenes::plus(scenes::times(rough, step), scenes::point(random, rough)));
      v[k] = b.add(p, to);
    }
    for (int k = 0; k < 4; ++k) b.faces.push_back({v[k], v[(k + 1) % 4], v[(k + 2) % 4]});
  }
  return b.scene();
}

StepScene crowded_scene(Random& random) {
  Builder b;
  const bool floor = scenes::coin(random), whole = scenes::coin(random);
  const int most = integer(random, 4, 8);
  const auto somewhere = [&](int size) {
    return whole ? small_integers(random, size) : scenes::point(random, size);
  };
  if (floor)
    b.add_element(true, [&, k = 0]() mutable {
      const Point corners[] = {{-64, -64, 0}, {64, -64, 0}, {0, 128, 0}};
      ++k;
      return std::pair(corners[k - 1], corners[k - 1]);
    });
  for (int i = integer(random, 20, 40); i > 0; --i) {
    Point where = somewhere(most), step = somewhere(2);
    if (floor) where[2] = std::abs(where[2]) + 3, step = {0, 0, -where[2] * integer(random, 0, 3) / 2};
    b.add_element(integer(random, 0, 4) != 0, [&] {
      const Point p = scenes::plus(where, somewhere(1));
      return std::pair(p, scenes::plus(p, step));
    });
  }
  return b.scene();
}

StepScene random_scene(Random& random) {
  switch (integer(random, 0, 9)) {
    case 0:
    case 1:
    case 2:
      return family_scene(random);
    case 3:
      return tetrahedra(random);
    case 4:
    case 5:
    case 6:
      return floor_scene(random);
    default:
      return grid_scene(random);
  }
}

static double size_of(const StepScene& scene) {
  return std::max((scene.x_t0.colwise().maxCoeff() - scene.x_t0.colwise().minCoeff()).maxCoeff(),
                  (scene.x_t1.colwise().maxCoeff() - scene.x_t1.colwise().minCoeff()).maxCoeff());
}

Options random_options(const StepScene& scene, Random& random) {
  Options o;
  const double size = size_of(scene);
  if (scenes::coin(random))
    o.relative_tolerance = scenes::power_of_ten(random, scenes::coin(random) ? -300 : -18, -2);
  if (integer(random, 0, 2) == 0)
    o.tolerance =
        std::max(0x1p-1074, size * scenes::power_of_ten(random, scenes::coin(random) ? -300 : -18, -2));
  o.exactness = Exactness(integer(random, 0, 2));
  o.norm = integer(random, 0, 3) ? Norm::euclidean : Norm::maximum;
  if (integer(random, 0, 4) == 0 && size > 0x1p-500 && size < 0x1p500)
    o.min_separation = scenes::coin(random) ? std::ldexp(std::round(size), -integer(random, 1, 10))
                                            : size * scenes::power_of_ten(random, -12, -1);
  const std::int64_t checks[] = {1, 2, 5, 20, 100, 1000, 10000};
  o.max_checks = checks[integer(random, 0, 6)];
  if (integer(random, 0, 4) == 0) {
    o.narrow_phase = NarrowPhaseMethod::inclusion;
    o.max_checks = std::min<std::int64_t>(o.max_checks, 1000);
  }
  o.broad_phase = BroadPhaseMethod(integer(random, 0, 3));
  o.instruction_set = scenes::coin(random) ? InstructionSet::scalar : InstructionSet::automatic;
  o.threads = 1;
  return o;
}

std::vector<double> random_thickness(const StepScene& scene, Random& random) {
  const double size = size_of(scene);
  std::vector<double> t(std::size_t(scene.x_t0.rows()));
  if (!(size > 0x1p-500 && size < 0x1p500)) return t;
  const int exponent = std::ilogb(size);
  for (double& x : t) x = scenes::coin(random) ? 0 : std::ldexp(1.0, exponent - integer(random, 3, 8));
  return t;
}

}  // namespace onset::tests
