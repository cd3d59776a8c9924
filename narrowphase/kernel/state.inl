// Kernel text: the state of a lane, and how it is set up.

// Lengths are scaled so that the largest corner component is in [1, 2).
template <class V, int K>
struct State {
  V c[2][K][3];          // corners at both ends
  V f[4];                // Bernstein coefficients of n(s).c_k(s)
  V f_error, n_largest;  // error of f, subdivided twice; upper bound of |n(s)|
  V rho;                 // |R|, rounded up
  V d, delta;
  V unit;
  V t, t_prev, w_prev[3];
  V dist;  // upper bound of the distance at t
  V slow, checks;
};
template <int K>
constexpr int kFields = sizeof(State<Doubles, K>) / sizeof(Doubles);

template <class V>
inline V norm_factor(const V (&w)[3],
                     bool maximum_norm) {  // dual norm of a direction of Euclidean length <= 1 + 5u
  return maximum_norm ? (abs(w[0]) + abs(w[1])) + abs(w[2]) : one<V>();
}
template <class V, int K>
inline V separation_wanted(const State<V, K>& s) {
  return (s.d + V::all(0.5) * s.delta) * V::all(1 + 0x1p-49);
}

// Sets the cubic n(s).c_k(s), n = e1 x e2, the same for all corners (docs/theory.md, §7). The corner of the
// smallest bound keeps tiny gaps accurate.
//
// Subdivided twice, a coefficient carries 31 roundings of u sum_a P_a R_a, P and R the sizes of n and of the
// corner; 34 covers second order (L13). The 10u of the margin taken off in between, which count where d is
// large, are covered by its own factor 1 + 2^-48.
template <class V, int K>
inline void set_cubic(State<V, K>& s, const V (&e1)[2][3], const V (&e2)[2][3], bool maximum_norm) {
  V product[3], largest1[3], largest2[3];
  for (int a = 0; a < 3; ++a) {
    largest1[a] = max(abs(e1[0][a]), abs(e1[1][a]));
    largest2[a] = max(abs(e2[0][a]), abs(e2[1][a]));
  }
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    product[a] = largest1[b] * largest2[c] + largest1[c] * largest2[b];
  }
  V bound, corner[2][3];
  for (int k = 0; k < K; ++k) {
    V r[3];
    for (int a = 0; a < 3; ++a) r[a] = max(abs(s.c[0][k][a]), abs(s.c[1][k][a]));
    const V here = dot(product, r);
    const auto better = k == 0 ? here >= zero<V>() : here < bound;
    bound = k == 0 ? here : min(here, bound);
    for (int end = 0; end < 2; ++end)
      for (int a = 0; a < 3; ++a)
        corner[end][a] = k == 0 ? s.c[end][k][a] : select(better, s.c[end][k][a], corner[end][a]);
  }
  V n00[3], n01[3], n10[3], n11[3], mixed[3];
  cross(e1[0], e2[0], n00);
  cross(e1[0], e2[1], n01);
  cross(e1[1], e2[0], n10);
  cross(e1[1], e2[1], n11);
  for (int a = 0; a < 3; ++a) mixed[a] = n01[a] + n10[a];
  const V third = V::all(3);
  s.f[0] = dot(n00, corner[0]);
  s.f[1] = (dot(n00, corner[1]) + dot(mixed, corner[0])) / third;
  s.f[2] = (dot(n11, corner[0]) + dot(mixed, corner[1])) / third;
  s.f[3] = dot(n11, corner[1]);
  s.f_error = V::all(34 * kU) * bound + V::all(0x1p-900);
  const V half = V::all(0.5);
  const V middle[3] = {half * mixed[0], half * mixed[1], half * mixed[2]};
  const auto size = [&](const V(&n)[3]) {
    return maximum_norm ? (abs(n[0]) + abs(n[1])) + abs(n[2]) : sqrt(dot(n, n));
  };
  // Components of n00 err by 4u of `product`, of half the sum by 5u, even of nearly parallel edges; 6u covers
  // second order, 2^-46 the norms' own 2.5u (L14).
  s.n_largest = max(size(n00), max(size(middle), size(n11))) * V::all(1 + 0x1p-46) +
                V::all(6 * kU) * ((product[0] + product[1]) + product[2]) + V::all(0x1p-500);
}

template <int K>
inline void set_up(const KernelPairs& pairs, const int* rows, State<Doubles, K>& s) {
  using V = Doubles;
  Points<V> p;
  gather(pairs, rows, p);
  V e1[2][3], e2[2][3];
  for (int end = 0; end < 2; ++end) {
    corners_of(p.p[end], s.c[end]);
    edges_of<V, K>(p.p[end], e1[end], e2[end]);
  }
  const V scale = inverse_power_of_two(largest_component(s.c));
  for (int end = 0; end < 2; ++end)
    for (int a = 0; a < 3; ++a) {
      for (int k = 0; k < K; ++k) s.c[end][k][a] = s.c[end][k][a] * scale;
      e1[end][a] = e1[end][a] * scale;
      e2[end][a] = e2[end][a] * scale;
    }
  V R[3];
  for (int a = 0; a < 3; ++a) {
    R[a] = abs(s.c[0][0][a]);
    for (int end = 0; end < 2; ++end)
      for (int k = 0; k < K; ++k) R[a] = max(abs(s.c[end][k][a]), R[a]);
  }
  s.rho = sqrt(dot(R, R)) * V::all(1 + 0x1p-50);
  // In the plane both edges are one: with the plane's axis for the first the cubic is that of the direction
  // square to the edge, which has one product with all corners too.
  if (pairs.in_plane)
    for (V(&axis)[3] : e1) axis[0] = axis[1] = zero<V>(), axis[2] = one<V>();
  double d[Doubles::lanes];
  for (int l = 0; l < Doubles::lanes; ++l) d[l] = pairs.separation[rows[l]];
  s.d = V::load(d) * scale;
  s.delta = min(V::all(pairs.tolerance) * scale, V::all(pairs.sharpest));
  s.unit = one<V>() / scale;
  s.t = s.slow = s.checks = zero<V>();
  s.t_prev = V::all(-1);
  s.dist = V::all(0x1p1000);
  for (V& x : s.w_prev) x = zero<V>();
  set_cubic(s, e1, e2, pairs.maximum_norm);
}
