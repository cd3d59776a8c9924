#include "narrowphase/at_rest/edge_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/at_rest/edge_face_exact.hpp"
#include "narrowphase/exact/grid.hpp"
#include "narrowphase/vec.hpp"

namespace onset {
namespace {

Vec point(const double* p) { return {{p[0], p[1], p[2]}}; }

// Returns the sign of a number within `bound` of x; 0: open, also where one is not finite.
int certain_sign(double x, double bound) {
  if (!(std::fabs(x) > bound && std::fabs(x) <= std::numeric_limits<double>::max())) return 0;
  return x > 0 ? 1 : -1;
}

// Bounds the error of fl((a x b).c), 49u A B C and underflow, for rounded differences a, b, c of points with
// components up to A, B, C (docs/theory.md, §19). It is not finite where anything overflows.
double volume_bound(double A, double B, double C) { return 0x1p-46 * ((A * B + 0x1p-1000) * C) + 0x1p-1070; }

// Tells whether a plane of normal m, any doubles, has the points p on one side and q on the other. m.(p_i -
// q_j) errs by 13u |m| |p - q| in the largest coordinates.
bool separates(const Vec& m, const Vec* p, int p_count, const Vec* q, int q_count) {
  const double size = largest_component(m);
  int side = 0;
  for (int i = 0; i < p_count; ++i)
    for (int j = 0; j < q_count; ++j) {
      const Vec d = p[i] - q[j];
      const int s = certain_sign(dot(m, d), 0x1p-48 * (size * largest_component(d)) + 0x1p-1070);
      if (s == 0 || s == -side) return false;
      side = s;
    }
  return true;
}

struct Quick {
  bool decided;
  EdgeFace answer;
};
constexpr Quick kOpen{false, EdgeFace::apart}, kApart{true, EdgeFace::apart};

// The ends are on different sides of the plane: the line meets the face iff it passes all sides on one side.
Quick through(const Vec (&e)[2], const Vec (&f)[3]) {
  const Vec d = e[1] - e[0], r[3] = {f[0] - e[0], f[1] - e[0], f[2] - e[0]};
  const double R =
      std::max(std::max(largest_component(r[0]), largest_component(r[1])), largest_component(r[2]));
  const double bound = volume_bound(R, R, largest_component(d));
  int positive = 0, negative = 0;
  for (int i = 0; i < 3; ++i) {
    const int s = certain_sign(dot(cross(r[i], r[(i + 1) % 3]), d), bound);
    positive += s > 0, negative += s < 0;
  }
  if (positive > 0 && negative > 0) return kApart;
  return positive == 3 || negative == 3 ? Quick{true, EdgeFace::crossing} : kOpen;
}

// Tells whether an edge is beyond a side of the face within its plane, or the face beyond its line.
bool apart_in_plane(const Vec& n, const Vec (&e)[2], const Vec (&f)[3]) {
  for (int i = 0; i < 3; ++i)
    if (separates(cross(n, f[(i + 1) % 3] - f[i]), e, 2, f, 3)) return true;
  return separates(cross(n, e[1] - e[0]), e, 2, f, 3);
}

Quick quick_answer(const EdgeAndFace& pair) {
  const Vec e[2] = {point(pair.e[0]), point(pair.e[1])};
  const Vec f[3] = {point(pair.f[0]), point(pair.f[1]), point(pair.f[2])};
  const Vec a = f[1] - f[0], b = f[2] - f[0], c0 = e[0] - f[0], c1 = e[1] - f[0];
  const Vec n = cross(a, b);
  const double bound = volume_bound(largest_component(a), largest_component(b),
                                    std::max(largest_component(c0), largest_component(c1)));
  const int s0 = certain_sign(dot(n, c0), bound), s1 = certain_sign(dot(n, c1), bound);
  if (s0 * s1 > 0) return kApart;
  if (s0 * s1 < 0) return through(e, f);
  return apart_in_plane(n, e, f) ? kApart : kOpen;
}

bool before(const double* p, const double* q) { return std::lexicographical_compare(p, p + 3, q, q + 3); }

// Along the line points are in the order of their coordinates.
EdgeFace on_one_line(const double* e0, const double* e1, const double* first, const double* last) {
  if (before(e1, e0)) std::swap(e0, e1);
  const double *from = before(e0, first) ? first : e0, *to = before(last, e1) ? last : e1;
  return before(from, to) ? EdgeFace::overlapping : before(to, from) ? EdgeFace::apart : EdgeFace::touching;
}

template <class C, class M, class T>
EdgeFace exact_answer(const EdgeAndFace& pair, int last) {
  using Exact = ExactEdgeFace<C, M, T>;
  const typename Exact::Point e[2] = {on_grid<C>(pair.e[0], last), on_grid<C>(pair.e[1], last)};
  const typename Exact::Point f[3] = {on_grid<C>(pair.f[0], last), on_grid<C>(pair.f[1], last),
                                      on_grid<C>(pair.f[2], last)};
  const Exact exact(e, f);
  const std::array<M, 3> n = exact.normal();
  if (sign_of(n[0]) != 0 || sign_of(n[1]) != 0 || sign_of(n[2]) != 0) return exact.decide(n);
  const auto ends = std::minmax({0, 1, 2}, [&](int i, int j) { return before(pair.f[i], pair.f[j]); });
  const EdgeFace found = Exact::of_segments(e[0], e[1], f[ends.first], f[ends.second]);
  if (found != EdgeFace::overlapping) return found;
  return on_one_line(pair.e[0], pair.e[1], pair.f[ends.first], pair.f[ends.second]);
}

EdgeFace exact_answer(const EdgeAndFace& pair) {
  Grid grid;
  for (const double* p : {pair.e[0], pair.e[1], pair.f[0], pair.f[1], pair.f[2]}) grid.add(p);
  static_assert(ExactEdgeFace<std::int64_t, Int128, Wide<4>>::fits(61, 64, 128, 256), "");
  if (grid.bits() <= 61) return exact_answer<std::int64_t, Int128, Wide<4>>(pair, grid.last);
  static_assert(ExactEdgeFace<Wide<2>, Wide<4>, Wide<8>>::fits(120, 128, 256, 512), "");
  if (grid.bits() <= 120) return exact_answer<Wide<2>, Wide<4>, Wide<8>>(pair, grid.last);
  return exact_answer<Integer, Integer, Integer>(pair, grid.last);
}

template <class C, class M>
bool on_one_line(const double* p, const double* q, const double* r, int last) {
  const auto from = on_grid<C>(p, last);
  const auto n = exact_cross<M>(difference(on_grid<C>(q, last), from), difference(on_grid<C>(r, last), from));
  return sign_of(n[0]) == 0 && sign_of(n[1]) == 0 && sign_of(n[2]) == 0;
}

}  // namespace

EdgeFace edge_face(const EdgeAndFace& pair) {
  const Quick quick = quick_answer(pair);
  return quick.decided ? quick.answer : exact_answer(pair);
}

bool exactly_collinear(const double* p, const double* q, const double* r) {
  const Vec a = point(q) - point(p), b = point(r) - point(p), n = cross(a, b);
  // A component errs by 8u |a| |b| in the largest coordinates.
  const double bound = 0x1p-49 * (largest_component(a) * largest_component(b)) + 0x1p-1070;
  for (int k = 0; k < 3; ++k)
    if (certain_sign(n[k], bound) != 0) return false;
  Grid grid;
  for (const double* x : {p, q, r}) grid.add(x);
  if (grid.bits() <= 61) return on_one_line<std::int64_t, Int128>(p, q, r, grid.last);
  if (grid.bits() <= 120) return on_one_line<Wide<2>, Wide<4>>(p, q, r, grid.last);
  return on_one_line<Integer, Integer>(p, q, r, grid.last);
}

}  // namespace onset
