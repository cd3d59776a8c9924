// Kernel text: the culls, in single precision, eight pairs at a time.
//
// Corner differences are formed and scaled in double, so that their largest component is in [1, 2), and rounded to float once:
// relative error u(1 + 2^-28), u = 2^-24, as for a corner in the double certificates. Hence a dot product errs by 4u |w| rho
// and a Bernstein coefficient on [0, 1] by 5u; 5.5u covers second order, |w| <= 1 + 4u and underflow (below 2^-149, against
// u rho >= 2^-24). d is rounded up by 2^-22.

template <int K>
inline void float_corners(const KernelPairs& pairs, const int* rows, F8 (&c)[2][K][3], F8& d) {
  D4 lanes[2][2][K][3], separation[2];
  for (int half = 0; half < 2; ++half) {
    Points<D4> p;
    gather(pairs, rows + 4 * half, p);
    for (int end = 0; end < 2; ++end) corners_of(p.p[end], lanes[half][end]);
    const D4 scale = inverse_power_of_two(largest_component(lanes[half]));
    for (auto& end : lanes[half])
      for (auto& corner : end)
        for (D4& x : corner) x = x * scale;
    double of_pair[4];
    for (int l = 0; l < 4; ++l) of_pair[l] = pairs.separation[rows[4 * half + l]] + pairs.rounding;
    separation[half] = D4::load(of_pair) * scale;
  }
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < K; ++k)
      for (int a = 0; a < 3; ++a) c[end][k][a] = to_float(lanes[0][end][k][a], lanes[1][end][k][a]);
  d = to_float(separation[0], separation[1]) * F8::all(1 + 0x1p-22f);
}

// Whether the direction that turns linearly from w0 at t = 0 to w1 at t = 1 separates throughout: the Bernstein coefficients
// of each corner's quadratic, less error and separation, satisfy x0, x2 > 0 and x1 > -sqrt(x0 x2) (first_root's proof).
template <class V, int K>
inline typename V::Mask separates(const V (&c0)[K][3], const V (&c1)[K][3], const V (&w0)[3], const V (&w1)[3], V m0, V m2) {
  const V half = V::all(0.5f), m1 = half * (m0 + m2) * V::all(1 + 0x1p-20f);
  auto apart = m0 == m0;
  for (int k = 0; k < K; ++k) {
    const V x0 = dot(w0, c0[k]) - m0, x2 = dot(w1, c1[k]) - m2;
    const V x1 = half * (dot(w0, c1[k]) + dot(w1, c0[k])) - m1;
    const V q = x0 * x2;
    const auto bows_little =
        (x1 >= zero<V>()) | ((q >= V::all(0x1p-100f)) & (x1 * x1 < q * V::all(1 - 0x1p-10f)));
    apart = apart & (x0 > zero<V>()) & (x2 > zero<V>()) & bows_little;
  }
  return apart;
}

template <class V, int K>
inline void direction_at(const V (&c)[K][3], V (&w)[3]) {
  V e1[3], e2[3];
  spanning_edges(c, e1, e2);
  best_direction(c, nearest_on_boundary(c), e1, e2, w);
}

// An upper bound of the share of the initial gap that the advancement adds to d.
template <class V, int K>
inline V kept_at_most(const V (&c)[K][3], const KernelPairs& pairs) {
  // The point found errs by less than 10u rho < 2^-18.
  const V gap = sqrt(nearest_on_boundary(c).f2) * V::all(1 + 0x1p-20f) + V::all(0x1p-18f);
  return gap * V::all(static_cast<float>(pairs.keep) * (1 + 0x1p-20f));
}

template <int K>
inline int cull_eight(const KernelPairs& pairs, const int* rows) {
  using V = F8;
  V c[2][K][3], d, R[3];
  float_corners(pairs, rows, c, d);
  for (int a = 0; a < 3; ++a) {
    R[a] = abs(c[0][0][a]);
    for (int end = 0; end < 2; ++end)
      for (int k = 0; k < K; ++k) R[a] = max(abs(c[end][k][a]), R[a]);
  }
  const V error = V::all(5.5f * 0x1p-24f) * sqrt(dot(R, R)) * V::all(1 + 0x1p-20f);
  V w0[3], w1[3];
  direction_at(c[0], w0);
  direction_at(c[1], w1);
  const V up = V::all(1 + 0x1p-19f);
  if (pairs.keep > 0) d = d + kept_at_most(c[0], pairs);
  const V m0 = (error + d * norm_factor(w0, pairs.maximum_norm)) * up;
  const V m2 = (error + d * norm_factor(w1, pairs.maximum_norm)) * up;
  return bits(separates(c[0], c[1], w0, w1, m0, m2));
}

template <int K>
inline int cull_all(const KernelPairs& pairs, int* survivors) {
  int kept = 0;
  for (int first = 0; first < pairs.count; first += 8) {
    int rows[8];
    const int here = pairs.count - first < 8 ? pairs.count - first : 8;
    for (int l = 0; l < 8; ++l) rows[l] = first + (l < here ? l : here - 1);
    const int apart = cull_eight<K>(pairs, rows);
    for (int l = 0; l < here; ++l) {
      survivors[kept] = first + l;
      kept += !(apart >> l & 1);
    }
  }
  return kept;
}
