#include "narrowphase/exact/orientation.hpp"

#include <algorithm>
#include <cmath>

namespace onset {
namespace {

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

// A number as a sum of at most N doubles that do not overlap, smallest first (Shewchuk 1997).
template <int N>
struct Expansion {
  int size = 0;
  double x[N];

  void add(double b) {
    int kept = 0;
    double error;
    for (int i = 0; i < size; ++i) {
      two_sum(b, x[i], b, error);
      if (error != 0) x[kept++] = error;
    }
    if (b != 0) x[kept++] = b;
    size = kept;
  }
  template <int A, int B>
  void add_product(const Expansion<A>& a, const Expansion<B>& b, double sign) {
    static_assert(2 * A * B <= N);
    for (int i = 0; i < a.size; ++i)
      for (int j = 0; j < b.size; ++j) {
        double product, error;
        two_product(sign * a.x[i], b.x[j], product, error);
        add(error);
        add(product);
      }
  }
};

Expansion<2> difference(double a, double b) {
  double sum, error;
  two_sum(a, -b, sum, error);
  Expansion<2> r;
  r.add(error);
  r.add(sum);
  return r;
}

// a d - b c.
Expansion<16> minor(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c,
                    const Expansion<2>& d) {
  Expansion<16> r;
  r.add_product(a, d, 1);
  r.add_product(b, c, -1);
  return r;
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
  // Subnormal coordinates are multiples of 2^-51 then: exact, too. A greater power of two is no double.
  const double scale = std::ldexp(1.0, std::min(1023, -std::ilogb(largest)));
  Expansion<2> m[3][3];
  for (int r = 0; r < 3; ++r)
    for (int i = 0; i < 3; ++i) m[r][i] = difference(rows[r][i] * scale, d[i] * scale);
  Expansion<192> det;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    det.add_product(m[0][i], minor(m[1][j], m[1][k], m[2][j], m[2][k]), 1);
  }
  return det.size == 0 ? 0 : det.x[det.size - 1] > 0 ? 1 : -1;
}

}  // namespace onset
