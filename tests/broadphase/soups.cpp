#include "tests/broadphase/soups.hpp"

#include <algorithm>
#include <cmath>

namespace onset::tests {

using scenes::Random;
using scenes::uniform;

Soup scattered(const std::string& name, int faces, double size, double speed, Random& random) {
  Soup soup = triangles(name, faces, random, [](Random&) { return 0.0; });
  for (int f = 0; f < faces; ++f)
    for (int a = 0; a < 3; ++a) {
      const double centre = uniform(random, -1, 1);
      for (int k = 0; k < 3; ++k) {
        const std::size_t i = std::size_t(9 * f + 3 * k + a);
        soup.x_t0[i] = centre + uniform(random, -size, size);
        soup.x_t1[i] = soup.x_t0[i] + uniform(random, -speed, speed);
      }
    }
  return soup;
}

Soup tangled(int vertices, int primitives, Random& random) {
  Soup soup;
  soup.name = "few vertices, many shared";
  soup.mesh.num_vertices = vertices;
  while (int(soup.mesh.faces.size()) < primitives) {
    const int a = scenes::integer(random, 0, vertices - 1), b = scenes::integer(random, 0, vertices - 1),
              c = scenes::integer(random, 0, vertices - 1);
    if (a == b || b == c || a == c) continue;
    soup.mesh.faces.push_back({a, b, c});
    soup.mesh.edges.push_back({b, a});
  }
  for (int i = 0; i < 3 * vertices; ++i) {
    soup.x_t0.push_back(uniform(random, -1, 1));
    soup.x_t1.push_back(uniform(random, -1, 1));
  }
  return soup;
}

Soup scaled(Soup soup, const std::string& name, double factor) {
  soup.name = name;
  for (auto* x : {&soup.x_t0, &soup.x_t1})
    for (double& value : *x) value *= factor;
  return soup;
}

Soup moved(Soup soup, const std::string& name, double x, double y, double z) {
  soup.name = name;
  const double by[3] = {x, y, z};
  for (auto* values : {&soup.x_t0, &soup.x_t1})
    for (std::size_t i = 0; i < values->size(); ++i) (*values)[i] += by[i % 3];
  return soup;
}

namespace {

Soup at_rest(Soup soup, const std::string& name) {
  soup.name = name;
  soup.x_t1 = soup.x_t0;
  return soup;
}

Soup flat(Soup soup, const std::string& name) {
  soup.name = name;
  for (std::size_t i = 2; i < soup.x_t0.size(); i += 3) soup.x_t0[i] = soup.x_t1[i] = 0.1;
  return soup;
}

// Each primitive shrinks to one point at both ends.
Soup points_only(Soup soup, const std::string& name) {
  soup.name = name;
  for (auto* x : {&soup.x_t0, &soup.x_t1})
    for (std::size_t i = 0; i < x->size(); ++i) (*x)[i] = (*x)[i / 9 * 9 + i % 3];
  return soup;
}

Soup flown_off(Soup soup, const std::string& name, double where) {
  soup.name = name;
  soup.x_t1[0] = where, soup.x_t1[4] = -where;
  return soup;
}

Soup stretched(Soup soup, const std::string& name, double factor) {
  soup.name = name;
  for (auto* x : {&soup.x_t0, &soup.x_t1})
    for (std::size_t i = 0; i < x->size(); i += 3) (*x)[i] *= factor;
  return soup;
}

// Half of the triangles far away: no single precision grid resolves both halves.
Soup two_places(Soup soup, const std::string& name, double apart) {
  soup.name = name;
  for (auto* x : {&soup.x_t0, &soup.x_t1})
    for (std::size_t i = x->size() / 2; i < x->size(); ++i) (*x)[i] += apart;
  return soup;
}

}  // namespace

std::vector<Soup> hard_soups() {
  Random random(7);
  const auto whole = [](Random& r) { return double(scenes::integer(r, -6, 6)); };
  const auto tenths = [](Random& r) { return scenes::integer(r, -30, 30) / 10.0; };
  const Soup base = scattered("scattered", 150, 0.1, 0.1, random);
  std::vector<Soup> all{
      base,
      scattered("small and fast", 150, 0.01, 1, random),
      scattered("large", 100, 1, 0.2, random),
      tangled(40, 150, random),
      triangles("whole coordinates, boxes that touch", 120, random, whole),
      triangles("tenths, inexact in single precision", 120, random, tenths),
      triangles("all vertices in one point", 40, random, [](Random&) { return 1 / 3.0; }),
      triangles("all vertices in the origin", 40, random, [](Random&) { return 0.0; }),
      triangles("two values and signed zeros", 40, random,
                [](Random& r) { return scenes::coin(r) ? 0.0 : -0.0; }),
      at_rest(base, "at rest"),
      flat(base, "flat"),
      points_only(base, "no extent"),
      stretched(base, "stretched by 1e6", 1e6),
      flown_off(base, "one vertex at 1e12", 1e12),
      flown_off(base, "one vertex at 1e300", 1e300),
      two_places(base, "two places 1e6 apart", 1e6),
      two_places(base, "two places 1e100 apart", 1e100),
      moved(base, "offset by 1e6", 1e6, -2e6, 3e6),
      moved(base, "offset by 1e15", 1e15, 1e15, -1e15),
      moved(base, "offset far beyond its size", 1e30, 1e30, 1e30),
  };
  for (int exponent : {-1060, -900, -100, 100, 900, 1015})
    all.push_back(scaled(base, "scaled by 2^" + std::to_string(exponent), std::ldexp(1.0, exponent)));
  Soup edges = base, faces = base, empty;
  edges.name = "no faces", edges.mesh.faces.clear();
  faces.name = "no edges", faces.mesh.edges.clear();
  empty.name = "nothing";
  all.insert(all.end(), {edges, faces, empty});
  return all;
}

}  // namespace onset::tests
