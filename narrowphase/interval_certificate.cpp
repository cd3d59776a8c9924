#include "narrowphase/interval_certificate.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/vec.hpp"

namespace onset {
namespace {

Vec largest(Vec a, Vec b) {
  Vec r;
  for (int i = 0; i < 3; ++i) r[i] = std::max(std::fabs(a[i]), std::fabs(b[i]));
  return r;
}
Vec lerp(Vec a, Vec b, double t) { return (1 - t) * a + t * b; }
double dual_norm(Vec m, bool maximum_norm) {
  return maximum_norm ? std::fabs(m[0]) + std::fabs(m[1]) + std::fabs(m[2])
                      : std::sqrt(dot(m, m)) * (1 + 0x1p-50);
}

// An edge and the two classes of corners modulo it.
struct EdgeView {
  int edge;
  int first[2], second[2];  // corners that differ by the edge; equal where there is one
};
constexpr EdgeView kEdgeEdge[] = {{0, {0, 2}, {1, 3}}, {1, {0, 1}, {2, 3}}};
constexpr EdgeView kVertexFace[] = {{0, {0, 1}, {2, 2}}, {1, {1, 2}, {0, 0}}, {2, {2, 0}, {1, 1}}};

constexpr int kPoints = 6;

// Returns the direction with the largest smallest cosine to all points, by trying all bisectors and centres
// of triples. Any is safe.
Vec centre_of_cap(const Vec (&points)[kPoints]) {
  Vec direction[kPoints];
  for (int i = 0; i < kPoints; ++i) {
    direction[i] = unit(points[i]);
  }
  Vec best{};
  double best_cosine = -2;
  const auto consider = [&](Vec m) {
    const double n = std::sqrt(dot(m, m));
    if (!(n > 0x1p-100)) return;
    m = (1 / n) * m;
    double cosine = 2;
    for (const Vec& p : direction) cosine = std::min(cosine, dot(m, p));
    if (cosine > best_cosine) best_cosine = cosine, best = m;
  };
  for (int i = 0; i < kPoints; ++i)
    for (int j = i + 1; j < kPoints; ++j) {
      consider(direction[i] + direction[j]);
      for (int k = j + 1; k < kPoints; ++k) {
        const Vec n = cross(direction[j] - direction[i], direction[k] - direction[i]);
        consider(n);
        consider(-1.0 * n);
      }
    }
  return best;
}

class Interval {
 public:
  Interval(const Corners& corners, double ta, double tb, double wanted, bool maximum_norm)
      : corners_(corners), ta_(ta), tb_(tb), wanted_(wanted), maximum_norm_(maximum_norm) {}

  bool certified() const {
    if (corners_.count == 4) {
      for (const EdgeView& view : kEdgeEdge)
        if (along(view)) return true;
    } else {
      for (const EdgeView& view : kVertexFace)
        if (along(view)) return true;
    }
    return false;
  }

 private:
  Vec corner(int k, int end) const { return vec(corners_.c[end][k]); }
  Vec edge(int i, int end) const { return vec(corners_.e[end][i]); }

  // Returns the corner that stays nearer: its products carry the smaller error.
  int nearer(const int (&members)[2]) const {
    const auto size = [&](int k) {
      const Vec r = largest(corner(k, 0), corner(k, 1));
      return dot(r, r);
    };
    return size(members[1]) < size(members[0]) ? members[1] : members[0];
  }

  bool along(const EdgeView& view) const {
    const Vec e0 = edge(view.edge, 0), e1 = edge(view.edge, 1), span = largest(e0, e1);
    const Vec ea = lerp(e0, e1, ta_), eb = lerp(e0, e1, tb_);
    const int member[2] = {nearer(view.first), nearer(view.second)};
    Vec points[kPoints];
    for (int i = 0; i < 2; ++i) {
      const Vec c0 = corner(member[i], 0), c1 = corner(member[i], 1);
      const Vec ca = lerp(c0, c1, ta_), cb = lerp(c0, c1, tb_);
      points[3 * i] = cross(ea, ca);
      points[3 * i + 1] = 0.5 * (cross(ea, cb) + cross(eb, ca));
      points[3 * i + 2] = cross(eb, cb);
    }
    const Vec m = centre_of_cap(points);
    // |w(s)| <= |m| |e(s)|, and |m x e|_1 <= 2 |m|_2 |e|_2 for the dual of the maximum norm.
    const double reach = std::sqrt(std::max(dot(ea, ea), dot(eb, eb))) * (1 + 0x1p-48);
    const double separation = wanted_ * dual_norm(m, false) * reach * (maximum_norm_ ? 2 : 1);
    for (int i = 0; i < 2; ++i) {
      // In units of u sum |m_a| P_a a product carries 14 roundings; 16 covers second order (docs/theory.md,
      // L19).
      const Vec r = largest(corner(member[i], 0), corner(member[i], 1));
      double error = 0;
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        error += std::fabs(m[a]) * (span[b] * r[c] + span[c] * r[b]);
      }
      const double bound = (16 * kU * error + separation) * (1 + 0x1p-48) + 0x1p-900;
      for (int j = 0; j < 3; ++j)
        if (!(dot(m, points[3 * i + j]) > bound)) return false;
    }
    return true;
  }

  const Corners& corners_;
  const double ta_, tb_, wanted_;
  const bool maximum_norm_;
};

}  // namespace

double certify_interval(const Corners& corners, double t, double wanted, bool maximum_norm) {
  double length = 1 - t;
  for (int tries = 0; tries < 6; ++tries, length *= 0.25) {
    const double tb = tries == 0 ? 1 : t + length;
    if (tb > t && Interval(corners, t, tb, wanted, maximum_norm).certified()) return tb;
  }
  return t;
}

}  // namespace onset
