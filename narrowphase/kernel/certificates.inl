// Kernel text: how long a direction certifies separation. Every formula carries its error bound; u is the unit roundoff.
//
// Notation: R_a bounds |c_a| of every computed corner at both ends, rho = |R| rounded up, so |w_a| R_a summed is at most
// |w| rho. A computed corner has relative error u, so a dot product of it errs by (1 + 3) u |w| rho = 4u; a lerp in time adds
// 3u (E7); a Bernstein coefficient of a moving direction adds u more (E8); each with factor 1.0625 for second-order terms,
// for rho's own rounding and for |w| <= 1 + 5u. Corners are scaled so that the largest component is in [1, 2): a product that
// underflows errs by less than 2^-1074, far below u rho, and is covered by the same factor.

template <class V>
inline V certified(typename V::Mask ok, V time) {
  return select(ok, time, V::all(-1));
}

// A direction constant on [t, t'], products g0 = w.c_k(0) and g1 = w.c_k(1) with threshold thr = E4 + (separation demanded).
// The exact product is within E4 of (1-s) g0 + s g1 for every s in [0,1], so where that line exceeds thr the pair is apart.
// x = g0 - thr and y = g1 - thr have exact signs and relative error u, x - y sums two non-negative numbers when the signs
// differ, so each root x / (x - y) is known within 4u. The extreme roots are picked by products across, which neither under- nor
// overflow (thr > 2^-52, so a non-zero x or y is above 2^-106), each choice within 2u: with the division and up to four
// choices within 14u; 2^-49 = 16u is taken off. Returns the time until which [t, .] is certified, 2 for the whole rest, or
// -1. NaN fails every comparison and certifies nothing.
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

// The first root of the quadratic with Bernstein coefficients x0, x1, x2 on L in [0,1], rounded down so that the quadratic is
// positive on the closed interval [0, L]; 1 when it is positive throughout; 0 when nothing is certain.
//
// Positive on [0,1] iff x0, x2 > 0 and x1 > -sqrt(x0 x2). s = x1^2 and q = x0 x2 are computed within 6u relative, so demanding
// s < q (1 - 2^-10) covers it in float and double; q >= tiny excludes underflow. The root, with r = L/(1-L), solves
// x0 + 2 x1 r + x2 r^2 = 0: 16u s under the square root makes it an over-estimate where x1 < 0; where x1 >= 0 all terms
// are sums of non-negative numbers. 2^-48 covers the remaining 8 roundings.
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

// How far, as a fraction of its interval, a cubic with Bernstein coefficients x certainly stays positive: it is above the
// steepest chord from x_0 to a point (i/3, x_i), since its value at s is the sum of B_i(s) x_i with the sum of B_i(s) i/3 = s.
// 6 roundings: 2^-49 is taken off. 1 for the whole, 0 for nothing.
template <class V>
inline V chord_step(const V (&x)[4]) {
  const V steepest = max(max(x[0] - x[1], V::all(0.5) * (x[0] - x[2])), V::all(1.0 / 3) * (x[0] - x[3]));
  const auto whole = (x[1] > zero<V>()) & (x[2] > zero<V>()) & (x[3] > zero<V>());
  const V crossing = x[0] / select(whole, one<V>(), steepest) * V::all((1.0 / 3) * (1 - 0x1p-49));
  const auto finite = (x[0] == x[0]) & (x[1] == x[1]) & (x[2] == x[2]) & (x[3] == x[3]);
  return select(finite & (x[0] > zero<V>()), select(whole, one<V>(), crossing), zero<V>());
}

// Halley's method for the root of that cubic, from `start` on: any result is safe to use. Three steps do what five of Newton's
// do, and the chain of divisions is shorter.
constexpr int kHalleySteps = 3;
template <class V>
inline V root_near(const V (&x)[4], V start) {
  const V three = V::all(3), c1 = three * (x[1] - x[0]), c2 = three * ((x[0] - x[1]) + (x[2] - x[1]));
  const V c3 = (x[3] - x[0]) - three * (x[2] - x[1]);
  const V c2_twice = c2 + c2, c3_thrice = three * c3;
  V s = start;
  for (int i = 0; i < kHalleySteps; ++i) {
    const V f = ((c3 * s + c2) * s + c1) * s + x[0], slope = (c3_thrice * s + c2_twice) * s + c1, bend = c3_thrice * s + c2;
    s = s - f * slope / (slope * slope - f * bend);
  }
  return s;
}
