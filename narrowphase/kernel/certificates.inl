// Kernel text: how long a direction certifies separation.
//
// In units of u rho (docs/theory.md, §1.2) a product w.c_k errs by at most E4 = 4.25 for a fixed w at every
// time (4 roundings; L4), E7 = 7.25 where corners are mixed at t (7; L5), E8 = 8.25 max(|w_b|, 1) in a
// coefficient of a turning direction (8; L6). The factors 1.0625, 1.036 and 1.031 cover second order, |w| <=
// 1 + 5u, rho's rounding, and underflow, as the largest corner component is in [1, 2).

template <class V>
inline V certified(typename V::Mask ok, V time) {
  return select(ok, time, V::all(-1));
}

// Returns the time until which a direction held fixed certifies [t, .]: 2 for the whole rest, -1 for nothing
// or NaN. g0 = w.c_k(0), g1 = w.c_k(1), and thr = E4 + the separation demanded (docs/theory.md, L9).
//
// Roots are picked by products across, and 2^-49 = 16u covers their 13u. The products do not underflow: thr >
// 2^-52, so a non-zero x or y is above 2^-106; for pairs of subnormal size these are 2^-102 and 2^-157.
template <class V, int K>
inline V fixed_certificate(const V (&g0)[K], const V (&g1)[K], V thr, V t) {
  V exit = V::all(2), exit_over = one<V>(), enter = zero<V>(), enter_over = one<V>();
  auto valid = t >= zero<V>(), at_start = valid, leaves = t < zero<V>();
  for (int k = 0; k < K; ++k) {
    const V x = g0[k] - thr, y = g1[k] - thr, below = zero<V>() - x, fall = x - y, rise = y - x;
    const auto x_apart = x > zero<V>(), y_apart = y > zero<V>();
    const auto first_out = x_apart & (y <= zero<V>()) & (x * exit_over < exit * fall);
    leaves = leaves | first_out;
    exit = select(first_out, x, exit);
    exit_over = select(first_out, fall, exit_over);
    const auto last_in = (x <= zero<V>()) & y_apart & (below * enter_over > enter * rise);
    enter = select(last_in, below, enter);
    enter_over = select(last_in, rise, enter_over);
    at_start = at_start & x_apart;
    valid = valid & (x_apart | y_apart) & (fall == fall);
  }
  const V until = select(leaves, exit / exit_over * V::all(1 - 0x1p-49), V::all(2));
  const V since = enter / enter_over * V::all(1 + 0x1p-49) + V::all(0x1p-1000);
  return certified<V>(valid & (at_start | (since <= t)) & (t < until), until);
}

// Returns an L such that the quadratic with Bernstein coefficients x0, x1, x2 is positive on the closed
// interval [0, L]: 1 only where it is positive throughout, 0 where nothing is certain (docs/theory.md, L12).
//
// It is positive throughout iff x0, x2 > 0 and x1 > -sqrt(x0 x2); 2^-10 covers rounding in that, in float
// too. Where x1 < 0, 16u s makes the discriminant an over-estimate, so that L errs downwards. 2^-48 covers
// the other 11 roundings.
template <class V>
inline V first_root(V x0, V x1, V x2) {
  const V tiny = V::all(0x1p-960), s = x1 * x1, q = x0 * x2;
  const auto starts = x0 > zero<V>();
  const auto whole =
      starts & (x2 > zero<V>()) & ((x1 >= zero<V>()) | ((q >= tiny) & (s < q * V::all(1 - 0x1p-10))));
  const auto falling = x1 < zero<V>();
  const V slack = select(falling, s * V::all(16 * 0x1p-53), zero<V>());
  const V disc = sqrt(max((s - q) + slack, zero<V>()));
  const V numerator = select(falling, x0, x1 + disc);
  const V denominator = select(falling, (x0 - x1) + disc, (x1 + disc) - x2);
  V L = numerator / denominator * V::all(1 - 0x1p-48);
  const auto in_range = (s + abs(q) < V::all(0x1p960)) & ((s >= tiny) | (abs(q) >= tiny));
  L = select(starts & in_range & (L > zero<V>()), min(L, one<V>()), zero<V>());
  return select(whole, one<V>(), L);
}

// Subdivides the cubic with Bernstein coefficients f on [0,1] to [t,1], and to [0,t].
template <class V>
inline void right_part(V (&f)[4], V t) {
  for (int level = 3; level > 0; --level)
    for (int i = 0; i < level; ++i) f[i] = lerp(f[i], f[i + 1], t);
}
template <class V>
inline void left_part(V (&f)[4], V t) {
  for (int level = 1; level < 4; ++level)
    for (int i = 3; i >= level; --i) f[i] = lerp(f[i - 1], f[i], t);
}

// Returns the fraction of its interval on which a cubic is certainly positive: it is above its steepest chord
// (docs/theory.md, L3(g)). 2^-49 covers 6 roundings.
template <class V>
inline V chord_step(const V (&x)[4]) {
  const V steepest = max(max(x[0] - x[1], V::all(0.5) * (x[0] - x[2])), V::all(1.0 / 3) * (x[0] - x[3]));
  const auto whole = (x[1] > zero<V>()) & (x[2] > zero<V>()) & (x[3] > zero<V>());
  const V crossing = x[0] / select(whole, one<V>(), steepest) * V::all((1.0 / 3) * (1 - 0x1p-49));
  const auto finite = (x[0] == x[0]) & (x[1] == x[1]) & (x[2] == x[2]) & (x[3] == x[3]);
  return select(finite & (x[0] > zero<V>()), select(whole, one<V>(), crossing), zero<V>());
}

// Approximates the root of that cubic; any result is safe. Three Halley steps do what five of Newton's do, in
// a shorter chain of divisions.
constexpr int kHalleySteps = 3;
template <class V>
inline V root_near(const V (&x)[4], V start) {
  const V three = V::all(3), c1 = three * (x[1] - x[0]), c2 = three * ((x[0] - x[1]) + (x[2] - x[1]));
  const V c3 = (x[3] - x[0]) - three * (x[2] - x[1]);
  const V c2_twice = c2 + c2, c3_thrice = three * c3;
  V s = start;
  for (int i = 0; i < kHalleySteps; ++i) {
    const V f = ((c3 * s + c2) * s + c1) * s + x[0], slope = (c3_thrice * s + c2_twice) * s + c1,
            bend = c3_thrice * s + c2;
    s = s - f * slope / (slope * slope - f * bend);
  }
  return s;
}
