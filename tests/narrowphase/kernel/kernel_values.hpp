// What the kernel text computes inside, for tests of its error bounds. Lengths of one pair are in units of
// `unit`.
#pragma once

#include "narrowphase/kernel/kernel.hpp"

namespace onset::tests {

struct ValuesWanted {
  double w[3], wb[3];  // directions of length 1 or less, at t and at tb
  double t, tb;        // 0 <= t <= tb <= 1
  double u, v;         // where F is evaluated: in [0, 1]^2, for a face u + v <= 1
};

struct KernelValues {
  double unit, rho;
  double g[2][4];  // w.c_k(0), w.c_k(1)
  double at_t[4];  // w.c_k(t)
  double b[3][4];  // Bernstein coefficients of w(s).c_k(s) on [t, tb], w turning from w to wb
  double f[4];     // of n(s).c(s) on [t, 1]
  double f_error, n_largest;
  double witness[3];  // F(t, u, v)
  double distance;    // upper bound of the distance at t, Euclidean
  // Single precision: the directions rounded to float, the coefficients on [0, 1] with wb at 1, and their
  // bound.
  float wf[3], wbf[3], bf[5][4], f_bound;
};

// Of pair `row`. Two copies of the same text: as the library compiles it, and with multiplications and
// additions contracted.
KernelValues kernel_values_plain(bool edge_edge, const KernelPairs& pairs, int row,
                                 const ValuesWanted& wanted);
KernelValues kernel_values_contracted(bool edge_edge, const KernelPairs& pairs, int row,
                                      const ValuesWanted& wanted);

// The times until which the certificates vouch for the pair from state (t, w, previous t and w) on: fixed
// direction, moving direction, normal. They demand `wanted_distance` (scaled). -1: nothing.
struct CertificateState {
  double t, w[3];
  double t_prev, w_prev[3];
  double separation, delta;  // scaled
};
struct Certificates {
  double fixed, moving, normal, wanted_distance, unit;
};
Certificates certificates_plain(bool edge_edge, const KernelPairs& pairs, int row,
                                const CertificateState& state);
Certificates certificates_contracted(bool edge_edge, const KernelPairs& pairs, int row,
                                     const CertificateState& state);

// The certificate of a contact: its cubic at a time, its inside functions there, scaled.
struct ContactValues {
  double scale;  // of q, a, b
  double cubic, cubic_error;
  double n[3], u, v, big_n;
  double eu, ev, en;  // at any time within `width`
};
ContactValues contact_values_plain(bool edge_edge, const KernelPairs& pairs, int row, double time,
                                   double width);
ContactValues contact_values_contracted(bool edge_edge, const KernelPairs& pairs, int row, double time,
                                        double width);

}  // namespace onset::tests
