#include "tests/fuzz/mesh_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/steps/support/random_scenes.hpp"

namespace onset::fuzz {
namespace {

template <class Row>
Eigen::MatrixXi matrix(const std::vector<Row>& rows) {
  Eigen::MatrixXi m(Eigen::Index(rows.size()), Eigen::Index(Row().size()));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < Row().size(); ++c) m(Eigen::Index(r), Eigen::Index(c)) = rows[r][c];
  return m;
}

// What repeats a vertex is no element.
template <std::size_t N>
void describe_rows(Bytes& bytes, int vertices, std::vector<std::array<int, N>>& rows) {
  int count = int(rows.size());
  bytes.whole(count, 0, kMostElements);
  if (!bytes.reads()) count = std::min(count, int(rows.size()));
  std::vector<std::array<int, N>> kept;
  for (int i = 0; i < count; ++i) {
    std::array<int, N> row{};
    if (!bytes.reads()) row = rows[std::size_t(i)];
    for (int& v : row) bytes.whole(v, 0, std::max(vertices - 1, 0));
    bool differ = vertices >= int(N);
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t l = 0; l < k; ++l) differ = differ && row[k] != row[l];
    if (differ) kept.push_back(row);
  }
  rows = kept;
}

double largest(const Eigen::MatrixXd& x) {
  double size = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    size = std::isnan(x.data()[i]) ? INFINITY : std::max(size, std::fabs(x.data()[i]));
  return size;
}

// A length of 2^-steps of the mesh's size, of any size where there is none.
double part_of_size(const MeshInput& input, int steps) {
  const double size = std::max(largest(input.x_t0), largest(input.x_t1));
  const double most = std::isfinite(size) && size > 0 ? std::min(size, 0x1p1000) : 1;
  return std::max(std::ldexp(most, -steps), 0x1p-1074);
}

// Integers of magnitudes far apart are long, a hundred times as slow, so most inputs keep to these.
constexpr int kCommonExponent = 12;
bool is_common(double x) {
  return x == 0 || (std::isfinite(x) && std::abs(std::ilogb(x)) <= kCommonExponent);
}
double as_common(double x) {
  if (is_common(x)) return x;
  if (!std::isfinite(x)) return std::signbit(x) ? -1 : 1;
  return std::ldexp(x, std::ilogb(x) % kCommonExponent - std::ilogb(x));
}

bool has_common_positions(const MeshInput& input) {
  return input.x_t0.unaryExpr(&is_common).all() && input.x_t1.unaryExpr(&is_common).all();
}

// One coordinate by itself; `known`: those before it.
void describe_coordinate(Bytes& bytes, double& x, const std::vector<double>& known, bool extreme) {
  const double largest_finite = std::numeric_limits<double>::max();
  const double extremes[] = {0,
                             -0.0,
                             0x1p-1074,
                             -0x1p-1074,
                             0x1p-1022,
                             0x1p1020,
                             -0x1p1020,
                             std::nextafter(0x1p1020, INFINITY),
                             largest_finite,
                             INFINITY,
                             NAN,
                             1,
                             -1,
                             0.1,
                             1e-9,
                             1e9};
  const double plain[] = {0, -0.0, 0, 1, -1, 0.1, 1 / 3.0, 1e-9, 1e9, 1e-5, 1e5, 2, -2, 0.5, 100, 0x1p-20};
  int how = 0, which = 0;
  bytes.whole(how, 0, 15);
  switch (how) {
    case 0:
      bytes.real(x);
      if (!extreme) x = as_common(x);
      break;
    case 1:
      bytes.whole(which, 0, 15);
      x = (extreme ? extremes : plain)[which];
      break;
    case 2:
    case 3:
    case 4:
    case 5:
    case 6: {
      bytes.whole(which, 0, 255);
      const double at = known.empty() ? 0 : known[known.size() - 1 - std::size_t(which) % known.size()];
      x = how == 2 ? std::nextafter(at, 1e300) : how == 3 ? std::nextafter(at, -1e300) : how == 4 ? -at : at;
      break;
    }
    default:
      bytes.whole(which, -128, 127);
      x = which / 8.0;
  }
}

// Each pair of bodies at most once.
void read_body_separations(Bytes& bytes, MeshInput& input, int bodies) {
  auto& list = input.rules.body_separations;
  int rows = 0;
  bytes.whole(rows, 0, 4);
  for (int i = 0; i < rows; ++i) {
    int a = 0, b = 0, steps = 0;
    bytes.whole(a, 0, bodies - 1), bytes.whole(b, 0, bodies - 1), bytes.whole(steps, 0, 31);
    const bool known = std::any_of(list.begin(), list.end(), [&](const BodySeparation& s) {
      return std::minmax(s.body_a, s.body_b) == std::minmax(a, b);
    });
    if (!known) list.push_back({a, b, steps < 4 ? 0 : part_of_size(input, steps - 3)});
  }
}

// The start, the end, either of another size, or other places; what is not in range is 0.
void read_rest(Bytes& bytes, MeshInput& input) {
  const double shares[] = {0.5, 0.25, 0.9, 0x1p-20, 1 - 0x1p-53, 0.1, 1 / 3.0};
  bytes.one_of(input.rules.rest_share, shares);
  int how = 0;
  bytes.whole(how, 0, 7);
  Eigen::MatrixXd x = how % 2 == 0 ? input.x_t0 : input.x_t1;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    double& c = x.data()[i];
    int steps = 0;
    if (how >= 6) bytes.whole(steps, -6, 6), c = steps;
    if (how == 4 || how == 5) c /= 8;
    if (!(std::fabs(c) <= 0x1p1020)) c = 0;
  }
  input.rules.rest_positions = x;
}

void set_exponent(double& length, int exponent) { length = std::ldexp(1.0, exponent); }

}  // namespace

Mesh MeshInput::mesh_without_rules() const { return Mesh(vertices, matrix(edges), matrix(faces)); }
Mesh MeshInput::mesh() const { return Mesh(vertices, matrix(edges), matrix(faces), rules); }
bool MeshInput::is_usable() const { return std::max(largest(x_t0), largest(x_t1)) <= 0x1p1020; }

void describe_elements(Bytes& bytes, MeshInput& input) {
  bytes.whole(input.vertices, 0, kMostVertices);
  describe_rows(bytes, input.vertices, input.faces);
  describe_rows(bytes, input.vertices, input.edges);
  input.edges = complete_edge_list(matrix(input.edges), matrix(input.faces));
}

void describe_positions(Bytes& bytes, MeshInput& input) {
  int mode = 1, exponent = 0, how = 1;  // as seeds are written: all bits
  if (!bytes.reads() && !has_common_positions(input)) how = 0;
  bytes.whole(how, 0, 31);
  const bool extreme = how == 0;
  bytes.whole(mode, 0, 3);
  if (mode == 3) bytes.whole(exponent, extreme ? -1074 : -40, extreme ? 1010 : 40);
  std::vector<double> known;
  for (Eigen::MatrixXd* x : {&input.x_t0, &input.x_t1}) {
    if (bytes.reads()) x->resize(input.vertices, 3);
    for (Eigen::Index v = 0; v < x->rows(); ++v)
      for (Eigen::Index a = 0; a < 3; ++a) {
        double& c = (*x)(v, a);
        int steps = 0;
        if (mode == 1)
          bytes.real(c), c = extreme ? c : as_common(c);
        else if (mode == 2)
          describe_coordinate(bytes, c, known, extreme);
        else
          bytes.whole(steps, -6, 6), c = std::ldexp(double(steps), exponent);
        known.push_back(c);
      }
  }
}

void describe_options(Bytes& bytes, MeshInput& input) {
  Options& o = input.options;
  int kind = 0, steps = 20;
  bytes.whole(kind, 0, 7);  // of the tolerance
  bytes.whole(steps, 1, 60);
  if (kind == 1) bytes.whole(steps, 1, 1074);
  set_exponent(o.relative_tolerance, -steps);
  if (kind == 2) o.tolerance = part_of_size(input, steps);
  bytes.whole(kind, 0, 7);
  bytes.whole(steps, 1, 60);
  if (kind == 1) o.min_separation = part_of_size(input, steps);
  if (kind == 2) o.min_separation = part_of_size(input, steps % 8);
  bytes.whole(steps, -2, 30);
  input.d_hat = part_of_size(input, steps);
  const double shares[] = {0.2, 0, 0.5, 0.9, 0.999};
  bytes.one_of(input.gap_share, shares);
  const std::int64_t checks[] = {10000, 1000, 100, 20, 5, 2, 1};
  bytes.one_of(o.max_checks, checks);
  bytes.whole(o.exactness, 0, 2);
  const double windows[] = {INFINITY, INFINITY, 0, 0.1, 0.5};
  bytes.one_of(o.window, windows);
  bytes.whole(kind, 0, 3);
  o.norm = kind == 1 ? Norm::maximum : Norm::euclidean;
  bytes.whole(kind, 0, 7);
  o.touching_may_pass_through = kind == 1;
  bytes.whole(kind, 0, 15);
  if (kind == 1)
    o.narrow_phase = NarrowPhaseMethod::inclusion, o.max_checks = std::min<std::int64_t>(o.max_checks, 1000);
}

void read_rules(Bytes& bytes, MeshInput& input) {
  CollisionRules& r = input.rules;
  const Mesh plain = input.mesh_without_rules();
  const std::size_t n = std::size_t(input.vertices);
  std::uint32_t which = 0;
  bytes.whole(which, 0, 0xffff);
  const auto has = [&](int bit) { return (which >> bit & 1) != 0 && n > 0; };
  std::vector<bool> used(n);
  for (const auto& e : input.edges) used[std::size_t(e[0])] = used[std::size_t(e[1])] = true;
  const auto flags = [&](std::size_t count) {
    std::vector<bool> all(count);
    std::uint32_t bits = 0;
    bytes.whole(bits, 0, 0xffff);
    for (std::size_t i = 0; i < count; ++i) all[i] = bits >> i % 16 & 1;
    return all;
  };
  const auto pairs = [&](int count) {
    std::vector<std::array<int, 2>> all;
    int rows = 0;
    bytes.whole(rows, 0, 3);
    for (int i = 0; i < rows && count > 1; ++i) {
      std::array<int, 2> p{};
      for (int& id : p) bytes.whole(id, 0, count - 1);
      if (p[0] != p[1]) all.push_back(p);
    }
    return all;
  };
  if (has(0)) {
    const std::vector<bool> wanted = flags(n);
    for (std::size_t v = 0; v < n; ++v)
      if (!used[v] && wanted[v]) r.points.push_back(int(v));
  }
  if (has(1))
    for (std::size_t v = 0; v < n; ++v) {
      int steps = 0;
      bytes.whole(steps, 0, 31);
      r.thickness.push_back(steps < 8 ? 0 : part_of_size(input, steps - 4));
    }
  int bodies = 1;
  if (has(2)) {
    int merged = 1;
    bytes.whole(merged, 1, 6);
    r.bodies = plain.components();
    for (int& b : r.bodies) b %= merged, bodies = std::max(bodies, b + 1);
  }
  if (has(3)) r.rigid_bodies = flags(std::size_t(bodies));
  if (has(4)) r.bodies_without_self_collision = flags(std::size_t(bodies));
  if (has(5)) r.excluded_bodies = pairs(bodies);
  if (has(6)) r.static_vertices = flags(n);
  if (has(7))
    for (std::size_t v = 0; v < n; ++v)
      for (auto* list : {&r.groups, &r.masks}) {
        std::uint32_t bits = 0;
        bytes.whole(bits, 0, 7);
        list->push_back(bits);
      }
  r.weld = has(8);
  if (has(9)) r.excluded_vertices = pairs(input.vertices);
  const int E = int(input.edges.size() + r.points.size()), F = int(input.faces.size());
  int rows = 0;
  if (has(10)) bytes.whole(rows, 0, 3);
  for (int i = 0; i < rows; ++i) {
    Pair p;
    bytes.whole(p.kind, 0, 1);
    const bool faced = p.kind == PairKind::vertex_face;
    bytes.whole(p.a, 0, faced ? input.vertices - 1 : std::max(E - 1, 0));
    bytes.whole(p.b, 0, std::max((faced ? F : E) - 1, 0));
    if (faced ? F > 0 : E > 1 && p.a != p.b) r.excluded_pairs.push_back(p);
  }
  rows = 0;
  if (has(11)) bytes.whole(rows, 0, 3);
  for (int i = 0; i < rows; ++i) {
    Intersection p;
    bytes.whole(p.edge, 0, std::max(E - 1, 0));
    bytes.whole(p.face, 0, std::max(F - 1, 0));
    if (E > 0 && F > 0) r.excluded_intersections.push_back(p);
  }
  if (has(12)) bytes.whole(r.excluded_rings, 0, 3);
  if (has(13)) read_body_separations(bytes, input, bodies);
  if (has(14)) read_rest(bytes, input);
  hold_statics(input);
}

void hold_statics(MeshInput& input) {
  for (std::size_t v = 0; v < input.rules.static_vertices.size(); ++v)
    if (input.rules.static_vertices[v]) input.x_t1.row(Eigen::Index(v)) = input.x_t0.row(Eigen::Index(v));
}

MeshInput read_mesh_input(Bytes& bytes) {
  MeshInput input;
  describe_elements(bytes, input);
  describe_positions(bytes, input);
  describe_options(bytes, input);
  read_rules(bytes, input);
  return input;
}

std::string seed_of_scene(scenes::Random& random) {
  for (;;) {
    const tests::StepScene scene = tests::random_scene(random);
    MeshInput input;
    input.vertices = int(scene.x_t0.rows());
    if (input.vertices > kMostVertices || scene.faces.rows() > kMostElements) continue;
    input.x_t0 = scene.x_t0, input.x_t1 = scene.x_t1;
    if (!has_common_positions(input) && scenes::integer(random, 0, 7) != 0) continue;
    for (Eigen::Index f = 0; f < scene.faces.rows(); ++f)
      input.faces.push_back({scene.faces(f, 0), scene.faces(f, 1), scene.faces(f, 2)});
    const auto of_faces = edge_list(matrix(input.faces));
    for (Eigen::Index e = Eigen::Index(of_faces.size()); e < scene.edges.rows(); ++e)
      input.edges.push_back({scene.edges(e, 0), scene.edges(e, 1)});
    if (input.edges.size() > std::size_t(kMostElements)) continue;
    Bytes bytes;
    describe_elements(bytes, input);
    describe_positions(bytes, input);
    return bytes.written();
  }
}

std::string to_text(const MeshInput& input) {
  std::string text;
  char line[400];
  const auto add = [&](const char* pattern, auto... values) {
    std::snprintf(line, sizeof line, pattern, values...);
    text += line;
  };
  for (const auto* x : {&input.x_t0, &input.x_t1})
    for (Eigen::Index v = 0; v < x->rows(); ++v)
      add("  x_t%d %d: {%a, %a, %a}\n", int(x == &input.x_t1), int(v), (*x)(v, 0), (*x)(v, 1), (*x)(v, 2));
  for (const auto& f : input.faces) add("  face {%d, %d, %d}\n", f[0], f[1], f[2]);
  for (const auto& e : input.edges) add("  edge {%d, %d}\n", e[0], e[1]);
  const Options& o = input.options;
  add("  relative_tolerance %a tolerance %a min_separation %a norm %d max_checks %lld window %g exactness %d "
      "pass %d inclusion %d "
      "gap_share %g d_hat %a\n",
      o.relative_tolerance, o.tolerance.value_or(-1), o.min_separation, int(o.norm),
      static_cast<long long>(o.max_checks), o.window, int(o.exactness), int(o.touching_may_pass_through),
      int(o.narrow_phase), input.gap_share, input.d_hat);
  const CollisionRules& r = input.rules;
  const auto list = [&](const char* name, const auto& values, auto&& print) {
    if (values.empty()) return;
    text += std::string("  ") + name;
    for (const auto& x : values) print(x);
    text += "\n";
  };
  const auto number = [&](auto x) { add(" %g", double(x)); };
  const auto two = [&](const std::array<int, 2>& p) { add(" {%d, %d}", p[0], p[1]); };
  list("points", r.points, number);
  list("thickness", r.thickness, [&](double x) { add(" %a", x); });
  list("bodies", r.bodies, number), list("rigid", r.rigid_bodies, number);
  list("without_self_collision", r.bodies_without_self_collision, number);
  list("excluded_bodies", r.excluded_bodies, two), list("static", r.static_vertices, number);
  list("groups", r.groups, number), list("masks", r.masks, number);
  if (r.weld) text += "  weld\n";
  list("excluded_vertices", r.excluded_vertices, two);
  if (r.excluded_rings > 0) add("  excluded_rings %d\n", r.excluded_rings);
  list("body_separations", r.body_separations,
       [&](const BodySeparation& s) { add(" {%d, %d, %a}", s.body_a, s.body_b, s.separation); });
  if (r.rest_positions.rows() > 0) add("  rest_share %a\n", r.rest_share);
  for (Eigen::Index v = 0; v < r.rest_positions.rows(); ++v)
    add("  rest %d: {%a, %a, %a}\n", int(v), r.rest_positions(v, 0), r.rest_positions(v, 1),
        r.rest_positions(v, 2));
  list("excluded_pairs", r.excluded_pairs,
       [&](const Pair& p) { add(" {%d, %d, %d}", int(p.kind), p.a, p.b); });
  list("excluded_intersections", r.excluded_intersections,
       [&](const Intersection& p) { add(" {%d, %d}", p.edge, p.face); });
  return text;
}

}  // namespace onset::fuzz
