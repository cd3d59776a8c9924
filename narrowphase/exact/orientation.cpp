#include "narrowphase/exact/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace onset {
namespace {

// A number as a sum of doubles that do not overlap, smallest first (Shewchuk 1997).
using Expansion = std::vector<double>;

void two_sum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double b_part = sum - a;
  error = (a - (sum - b_part)) + (b - b_part);
}

void split(double a, double& high, double& low) {
  const double t = 134217729.0 * a;  // 2^27 + 1
  high = t - (t - a);
  low = a - high;
}

void two_product(double a, double b, double& product, double& error) {
  product = a * b;
  double ah, al, bh, bl;
  split(a, ah, al);
  split(b, bh, bl);
  error = al * bl - (((product - ah * bh) - al * bh) - ah * bl);
}

Expansion grown(const Expansion& e, double b) {
  Expansion r;
  double q = b, error;
  for (double x : e) {
    two_sum(q, x, q, error);
    if (error != 0) r.push_back(error);
  }
  if (q != 0) r.push_back(q);
  return r;
}

Expansion operator+(Expansion a, const Expansion& b) {
  for (double x : b) a = grown(a, x);
  return a;
}
Expansion operator-(const Expansion& a, Expansion b) {
  for (double& x : b) x = -x;
  return a + b;
}
Expansion operator*(const Expansion& a, const Expansion& b) {
  Expansion r;
  for (double x : a)
    for (double y : b) {
      double product, error;
      two_product(x, y, product, error);
      r = grown(grown(r, error), product);
    }
  return r;
}
Expansion difference(double a, double b) {
  double sum, error;
  two_sum(a, -b, sum, error);
  return grown(grown({}, error), sum);
}

}  // namespace

int orientation(const double* a, const double* b, const double* c, const double* d) {
  const double* rows[3] = {a, b, c};
  double largest = 0, smallest = INFINITY;
  for (const double* p : {a, b, c, d})
    for (int i = 0; i < 3; ++i) {
      largest = std::max(largest, std::fabs(p[i]));
      if (p[i] != 0) smallest = std::min(smallest, std::fabs(p[i]));
    }
  if (largest == 0) return 0;
  // The determinant's terms have bits down to (smallest * 2^-52)^3, above 2^-1022 (docs/theory.md, §19).
  if (smallest < largest * 0x1p-280) return kUnknownSide;
  const double scale = std::ldexp(1.0, -std::ilogb(largest));
  Expansion m[3][3];
  for (int r = 0; r < 3; ++r)
    for (int i = 0; i < 3; ++i) m[r][i] = difference(rows[r][i] * scale, d[i] * scale);
  const Expansion det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                        m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                        m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det.empty() ? 0 : det.back() > 0 ? 1 : -1;
}

}  // namespace onset
