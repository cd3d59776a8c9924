// Kernel text: the closest point of the hull of a pair's corners c_j = p - v_j (K = 3) or c_2i+j = a_i - b_j
// (K = 4) to the origin, and the direction that separates it best. F(t, ., .) fills the hull (paper, eq. 1
// and 2). Any direction is safe: a poor one costs steps (docs/theory.md, §4).

template <class V>
struct Thresholds;  // smallest and largest square that may be normalised without under- or overflow
template <>
struct Thresholds<Doubles> {
  static constexpr double tiny = 0x1p-900, huge = 0x1p900;
};
template <>
struct Thresholds<Floats> {
  static constexpr float tiny = 0x1p-100f, huge = 0x1p100f;
};

template <class V>
inline V zero() {
  return V::all(0);
}
template <class V>
inline V one() {
  return V::all(1);
}

// Makes |w| <= 1 + 5u, or w = 0 where |w| is out of range (docs/theory.md, L7).
template <class V>
inline void normalise(V (&w)[3]) {
  const V ww = dot(w, w);
  const auto valid = (ww >= V::all(Thresholds<V>::tiny)) & (ww <= V::all(Thresholds<V>::huge));
  const V inverse = select(valid, one<V>() / sqrt(select(valid, ww, one<V>())), zero<V>());
  for (V& x : w) x = x * inverse;
}

template <class V, int K>
inline V least(const V (&w)[3], const V (&c)[K][3]) {
  V r = dot(w, c[0]);
  for (int k = 1; k < K; ++k) r = min(dot(w, c[k]), r);
  return r;
}

template <class V>
struct Nearest {
  V f[3];                   // the closest point of the boundary to the origin
  V f2;                     // |f|^2
  V e[3], ee;               // its segment, and the square of that one's length
  typename V::Mask inside;  // strictly inside the segment
};

// The segment is measured from the nearer end, whose tiny gap then does not drown in the far end's rounding.
template <class V>
inline Nearest<V> nearest_on_segment(const V (&p)[3], V p2, const V (&q)[3], V q2) {
  Nearest<V> r;
  const auto p_nearer = p2 <= q2;
  V base[3];
  for (int a = 0; a < 3; ++a) {
    base[a] = select(p_nearer, p[a], q[a]);
    r.e[a] = select(p_nearer, q[a], p[a]) - base[a];
  }
  r.ee = dot(r.e, r.e);
  const auto has_length = r.ee > V::all(Thresholds<V>::tiny);
  const V s = zero<V>() - dot(base, r.e) / select(has_length, r.ee, one<V>());
  r.inside = has_length & (s > zero<V>()) & (s < one<V>());
  const V clamped = select(has_length & (s > zero<V>()), min(s, one<V>()), zero<V>());
  for (int a = 0; a < 3; ++a) r.f[a] = base[a] + clamped * r.e[a];
  r.f2 = dot(r.f, r.f);
  return r;
}

template <class V>
inline void keep_nearer(Nearest<V>& best, const Nearest<V>& other) {
  const auto nearer = other.f2 < best.f2;
  for (int a = 0; a < 3; ++a) {
    best.f[a] = select(nearer, other.f[a], best.f[a]);
    best.e[a] = select(nearer, other.e[a], best.e[a]);
  }
  best.ee = select(nearer, other.ee, best.ee);
  best.inside = (nearer & other.inside) | ((other.f2 >= best.f2) & best.inside);
  best.f2 = min(other.f2, best.f2);
}

template <class V>
inline Nearest<V> nearest_on_boundary(const V (&c)[4][3]) {  // the four sides of the parallelogram
  const V n[4] = {dot(c[0], c[0]), dot(c[1], c[1]), dot(c[2], c[2]), dot(c[3], c[3])};
  Nearest<V> r = nearest_on_segment(c[0], n[0], c[1], n[1]);
  keep_nearer(r, nearest_on_segment(c[2], n[2], c[3], n[3]));
  keep_nearer(r, nearest_on_segment(c[0], n[0], c[2], n[2]));
  keep_nearer(r, nearest_on_segment(c[1], n[1], c[3], n[3]));
  return r;
}
template <class V>
inline Nearest<V> nearest_on_boundary(const V (&c)[3][3]) {  // the three sides of the triangle
  const V n[3] = {dot(c[0], c[0]), dot(c[1], c[1]), dot(c[2], c[2])};
  Nearest<V> r = nearest_on_segment(c[0], n[0], c[1], n[1]);
  keep_nearer(r, nearest_on_segment(c[1], n[1], c[2], n[2]));
  keep_nearer(r, nearest_on_segment(c[2], n[2], c[0], n[0]));
  return r;
}

template <class V>
inline void spanning_edges(const V (&c)[4][3], V (&e1)[3], V (&e2)[3]) {
  for (int a = 0; a < 3; ++a) e1[a] = c[2][a] - c[0][a], e2[a] = c[1][a] - c[0][a];
}
template <class V>
inline void spanning_edges(const V (&c)[3][3], V (&e1)[3], V (&e2)[3]) {
  for (int a = 0; a < 3; ++a) e1[a] = c[1][a] - c[0][a], e2[a] = c[2][a] - c[0][a];
}

// Takes the boundary's direction or the hull's normal, whichever has the larger margin min_k w.c_k: no inside
// test is needed.
template <class V, int K>
inline void best_direction(const V (&c)[K][3], const Nearest<V>& nearest, const V (&e1)[3], const V (&e2)[3],
                           V (&w)[3]) {
  for (int a = 0; a < 3; ++a) w[a] = nearest.f[a];
  // Inside a segment w is made perpendicular to it twice, so that its error is relative to the edge and not
  // to the gap.
  const V inverse =
      select(nearest.inside, one<V>() / select(nearest.inside, nearest.ee, one<V>()), zero<V>());
  for (int pass = 0; pass < 2; ++pass) {
    const V along = dot(w, nearest.e) * inverse;
    for (int a = 0; a < 3; ++a) w[a] = w[a] - along * nearest.e[a];
  }
  normalise(w);

  V n[3], sum[3];
  cross(e1, e2, n);
  normalise(n);
  for (int a = 0; a < 3; ++a) {
    sum[a] = c[0][a] + c[1][a];
    for (int k = 2; k < K; ++k) sum[a] = sum[a] + c[k][a];
  }
  const auto towards = dot(n, sum) < zero<V>();
  for (int a = 0; a < 3; ++a) n[a] = select(towards, zero<V>() - n[a], n[a]);
  const auto normal_wins = least(n, c) > least(w, c);
  for (int a = 0; a < 3; ++a) w[a] = select(normal_wins, n[a], w[a]);
}

// Finds a point near the closest one where that is inside: a convex mean of the corners, which bounds the
// distance whatever the rounding of u and v.
template <class V>
inline void clamp_parameters(const V (&)[4][3], V& u, V& v) {
  u = min(max(u, zero<V>()), one<V>());
  v = min(max(v, zero<V>()), one<V>());
}
template <class V>
inline void clamp_parameters(const V (&)[3][3], V& u, V& v) {
  u = min(max(u, zero<V>()), one<V>());
  v = min(max(v, zero<V>()), one<V>() - u);
}
template <class V>
inline void evaluate(const V (&c)[4][3], V u, V v, V (&f)[3]) {
  for (int a = 0; a < 3; ++a) f[a] = lerp(lerp(c[0][a], c[1][a], v), lerp(c[2][a], c[3][a], v), u);
}
template <class V>
inline void evaluate(const V (&c)[3][3], V u, V v, V (&f)[3]) {
  for (int a = 0; a < 3; ++a) f[a] = (((one<V>() - u) - v) * c[0][a] + u * c[1][a]) + v * c[2][a];
}
template <class V, int K>
inline void interior_point(const V (&c)[K][3], const V (&e1)[3], const V (&e2)[3], V (&f)[3]) {
  const V aa = dot(e1, e1), ab = dot(e1, e2), bb = dot(e2, e2), p = dot(e1, c[0]), q = dot(e2, c[0]);
  const V det = aa * bb - ab * ab;
  const auto valid = det > V::all(Thresholds<V>::tiny);
  const V inverse = select(valid, one<V>() / select(valid, det, one<V>()), zero<V>());
  V u = (ab * q - bb * p) * inverse;
  V v = (ab * p - aa * q) * inverse;
  clamp_parameters(c, u, v);
  evaluate(c, u, v, f);
}
