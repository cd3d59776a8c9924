#include "tests/in_plane/support/plane_queries.hpp"

#include <cmath>

namespace onset::tests {
namespace {

using scenes::Random;

template <class F>
void for_all(VertexEdgeQuery& q, F&& f) {
  for (auto* points : {&q.t0, &q.t1})
    for (PlanePoint& p : *points) f(p);
}

VertexEdgeQuery uniform(Random& random) {
  VertexEdgeQuery q;
  for_all(q, [&](PlanePoint& p) { p = {scenes::uniform(random, -1, 1), scenes::uniform(random, -1, 1)}; });
  return q;
}

VertexEdgeQuery grid(Random& random) {
  VertexEdgeQuery q;
  const int size = scenes::integer(random, 1, 6);
  for_all(q, [&](PlanePoint& p) {
    p = {double(scenes::integer(random, -size, size)), double(scenes::integer(random, -size, size))};
  });
  return q;
}

double beside(double x, Random& random) {
  const int ulps = scenes::integer(random, -2, 2);
  for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, ulps > 0 ? INFINITY : -INFINITY);
  return x;
}

// The end of the vertex's motion is chosen so that it is at s of the edge at t.
VertexEdgeQuery aimed(Random& random, double s) {
  VertexEdgeQuery q = uniform(random);
  const double t = scenes::coin(random) ? scenes::unit(random) : scenes::power_of_ten(random, -12, 0);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto at = [&](std::size_t i) { return (1 - t) * q.t0[i][k] + t * q.t1[i][k]; };
    const double goal = (1 - s) * at(1) + s * at(2);
    q.t1[0][k] = beside((goal - (1 - t) * q.t0[0][k]) / t, random);
  }
  return q;
}

// The edge is y = -16 t x between x = -1 and 1, the vertex goes along y = 1 from -1/2 to 1/2: they touch at
// t = 1/4 without crossing.
VertexEdgeQuery grazing(Random& random) {
  VertexEdgeQuery q;
  const double y = scenes::coin(random) ? 1 : beside(1, random);
  q.t0 = {PlanePoint{-0.5, y}, PlanePoint{-1, 0}, PlanePoint{1, 0}};
  q.t1 = {PlanePoint{0.5, y}, PlanePoint{-1, 16}, PlanePoint{1, -16}};
  if (scenes::coin(random)) for_all(q, [](PlanePoint& p) { p = {p[1], p[0]}; });
  const double dx = scenes::integer(random, -3, 3), dy = scenes::integer(random, -3, 3);
  for_all(q, [&](PlanePoint& p) { p = {p[0] + dx, p[1] + dy}; });
  return q;
}

VertexEdgeQuery on_a_line(Random& random) {
  VertexEdgeQuery q = scenes::coin(random) ? grid(random) : uniform(random);
  const double slope = scenes::integer(random, -2, 2);
  for_all(q, [&](PlanePoint& p) { p[1] = slope * p[0]; });
  return q;
}

// Every coordinate is in the range of doubles that the library takes.
VertexEdgeQuery huge_and_tiny(Random& random) {
  VertexEdgeQuery q = plane_query(PlaneFamily(scenes::integer(random, 0, kPlaneFamilies - 2)), random);
  const double scale = std::ldexp(1.0, scenes::integer(random, -1060, 940));
  for_all(q, [&](PlanePoint& p) { p = {p[0] * scale, p[1] * scale}; });
  if (scenes::coin(random)) return q;
  const double offset = scale * std::ldexp(1.0, scenes::integer(random, 0, 15));
  for_all(q, [&](PlanePoint& p) { p = {p[0] + offset, p[1] - offset}; });
  return q;
}

}  // namespace

VertexEdgeQuery plane_query(PlaneFamily family, Random& random) {
  switch (family) {
    case PlaneFamily::uniform:
      return uniform(random);
    case PlaneFamily::grid:
      return grid(random);
    case PlaneFamily::aimed:
      return aimed(random, scenes::unit(random));
    case PlaneFamily::at_end:
      return aimed(random, scenes::coin(random) ? 0 : 1);
    case PlaneFamily::grazing:
      return grazing(random);
    case PlaneFamily::on_a_line:
      return on_a_line(random);
    case PlaneFamily::point_edge: {
      VertexEdgeQuery q = scenes::coin(random) ? grid(random) : aimed(random, 0);
      q.t0[2] = q.t0[1], q.t1[2] = q.t1[1];
      return q;
    }
    default:
      return huge_and_tiny(random);
  }
}

}  // namespace onset::tests
