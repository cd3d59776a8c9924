// Kernel text: the closest point and the best direction in the maximum norm.
//
// The direction is an axis, the hull's normal, or an edge crossed with an axis (docs/theory.md, L8). The
// closest point is where a diagonal meets the plane, or an end of a side, or where one component is zero or
// two are equal up to sign.

// Keeps w, in the better sign, if its margin is the largest so far.
template <class V, int K>
inline void consider(const V (&c)[K][3], const V (&w)[3], V (&best)[3], V& margin) {
  V low = dot(w, c[0]), high = low;
  for (int k = 1; k < K; ++k) {
    const V here = dot(w, c[k]);
    low = min(here, low);
    high = max(here, high);
  }
  const V size = (abs(w[0]) + abs(w[1])) + abs(w[2]);
  const auto turned = zero<V>() - high > low;
  const V here = select(turned, zero<V>() - high, low) / size;
  const auto better = (size > V::all(0x1p-400)) & (here > margin);
  for (int a = 0; a < 3; ++a) best[a] = select(better, select(turned, zero<V>() - w[a], w[a]), best[a]);
  margin = select(better, here, margin);
}
template <class V, int K>
inline void consider_side(const V (&c)[K][3], const V (&p)[3], const V (&q)[3], V (&best)[3], V& margin) {
  for (int a = 0; a < 3; ++a) {
    const int i = (a + 1) % 3, j = (a + 2) % 3;
    V w[3];
    w[a] = zero<V>();
    w[i] = q[j] - p[j];
    w[j] = zero<V>() - (q[i] - p[i]);
    consider(c, w, best, margin);
  }
}

template <class V>
inline V largest_component_of(const V (&f)[3]) {
  return max(abs(f[0]), max(abs(f[1]), abs(f[2])));
}
template <class V>
inline V try_point(const V (&p)[3], const V (&q)[3], V numerator, V denominator) {
  const V s = min(max(numerator / denominator, zero<V>()), one<V>());  // 0 for NaN
  V f[3];
  for (int a = 0; a < 3; ++a) f[a] = lerp(p[a], q[a], s);
  return largest_component_of(f);
}
template <class V>
inline V least_on_side(const V (&p)[3], const V (&q)[3]) {
  V least = min(largest_component_of(p), largest_component_of(q));
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const V ea = q[a] - p[a], eb = q[b] - p[b];
    least = min(try_point(p, q, zero<V>() - p[a], ea), least);
    least = min(try_point(p, q, p[b] - p[a], ea - eb), least);
    least = min(try_point(p, q, zero<V>() - (p[b] + p[a]), ea + eb), least);
  }
  return least;
}

template <class V>
inline void sides(const V (&c)[4][3], V (&w)[3], V& margin, V& least) {
  const int ends[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
  for (int i = 0; i < 4; ++i) {
    if (i % 2 == 0) consider_side(c, c[ends[i][0]], c[ends[i][1]], w, margin);  // opposite sides are parallel
    least = min(least_on_side(c[ends[i][0]], c[ends[i][1]]), least);
  }
}
template <class V>
inline void sides(const V (&c)[3][3], V (&w)[3], V& margin, V& least) {
  for (int i = 0; i < 3; ++i) {
    consider_side(c, c[i], c[(i + 1) % 3], w, margin);
    least = min(least_on_side(c[i], c[(i + 1) % 3]), least);
  }
}

// Takes the point s sign(n), s = n.c_0 / |n|_1, where the diagonal that the normal's signs choose meets the
// plane, and moves it into the hull.
template <class V, int K>
inline V least_inside(const V (&c)[K][3], const V (&e1)[3], const V (&e2)[3], const V (&n)[3]) {
  const V s = dot(n, c[0]) / ((abs(n[0]) + abs(n[1])) + abs(n[2]));
  V r[3], f[3];
  for (int a = 0; a < 3; ++a)  // where n[a] is 0, any of [-s, s] will do
    r[a] = select(n[a] < zero<V>(), zero<V>() - s, select(n[a] > zero<V>(), s, zero<V>())) - c[0][a];
  const V aa = dot(e1, e1), ab = dot(e1, e2), bb = dot(e2, e2), p = dot(e1, r), q = dot(e2, r);
  const V det = aa * bb - ab * ab;
  const auto valid = (det > V::all(Thresholds<V>::tiny)) & (s == s);
  const V safe = select(valid, det, one<V>());
  V u = select(valid, (bb * p - ab * q) / safe, zero<V>());
  V v = select(valid, (aa * q - ab * p) / safe, zero<V>());
  clamp_parameters(c, u, v);
  evaluate(c, u, v, f);
  return largest_component_of(f);
}

// The best direction, of Euclidean length 1, and the largest component of the closest point found.
template <class V, int K>
inline V closest_direction_in_maximum_norm(const V (&c)[K][3], const V (&e1)[3], const V (&e2)[3],
                                           V (&w)[3]) {
  V margin = V::all(-0x1p1000), least = V::all(0x1p1000), n[3];
  for (V& x : w) x = zero<V>();
  for (int a = 0; a < 3; ++a) {
    V axis[3] = {zero<V>(), zero<V>(), zero<V>()};
    axis[a] = one<V>();
    consider(c, axis, w, margin);
  }
  cross(e1, e2, n);
  consider(c, n, w, margin);
  sides(c, w, margin, least);
  normalise(w);
  return min(least_inside(c, e1, e2, n), least);
}
