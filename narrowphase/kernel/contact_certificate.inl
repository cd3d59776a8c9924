// Kernel text: a proof that a contact is real, in double lanes.
//
// The pair touches at t iff q = U a + V b with (U, V) in the triangle (vertex-face) or square (edge-edge); q, a, b relative
// vectors, linear in t, Mq, Ma, Mb bounds of their components at both ends. f = q.(a x b) is zero then. Two times lo < hi in
// [0, 1] at which f certainly has opposite signs enclose a root; for any fixed vector n, at that root
// U = n.(q x b) / N and V = n.(a x q) / N with N = n.(a x b), so where those three, N - U - V (vertex-face) or N - U, N - V
// (edge-edge) are positive throughout [lo, hi], the root is a contact.
//
// F = 3 f has Bernstein coefficients 3 q0.n00, q1.n00 + q0.m, q0.n11 + q1.m, 3 q1.n11 with n_ij = a(t_i) x b(t_j),
// m = n01 + n10. In units of u Mq Ma Mb: a component of n_ij has size 2 and error 2 (2 inputs + 1) + 2 = 8; of m size 4 and
// error 8 + 8 + 4 = 20; q.n_ij has size 6 and error 3 (8 + 2 + 2) + 2 * 6 = 48; q.m size 12, error 3 (20 + 4 + 4) + 2 * 12 =
// 108. So a coefficient has size at most 18 and error at most max(3 * 48 + 18, 48 + 108 + 18) = 174. Three lerps of error
// 3 * 18 make it 336; 350 covers second order. 2^-900 covers products that underflow.
constexpr double kCubicError = 350 * kU;
// Inside functions at the middle of [lo, hi]: a component of q has error 1 (end) + 3 (lerp) = 4, a product of two 9, two of
// them and the difference of size 2 make 20, n's product 2 more, two sums 2 * 2: 26 for each unit of |n|_1; 32 covers second
// order. Away from the middle by w a component of q moves by at most 2 w Mq: a product by 4w + 4w^2, two of them by
// 8w (1 + w) < 8.2 w for w <= 1/64.
constexpr double kInsideError = 32 * kU, kInsideSlope = 8.25;

template <class V>
struct RelativeMotion {
  V q[2][3], a[2][3], b[2][3];
  V scale;  // a power of two
};

template <int K>
inline void set_relative(const KernelPairs& pairs, const int* rows, RelativeMotion<D4>& r) {
  Points<D4> p;
  gather(pairs, rows, p);
  D4 largest = zero<D4>();
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < 3; ++i) {
      const D4(&x)[4][3] = p.p[end];
      r.q[end][i] = K == 4 ? x[2][i] - x[0][i] : x[0][i] - x[1][i];
      r.a[end][i] = K == 4 ? x[1][i] - x[0][i] : x[2][i] - x[1][i];
      r.b[end][i] = K == 4 ? x[2][i] - x[3][i] : x[3][i] - x[1][i];
      largest = max(max(abs(r.q[end][i]), abs(r.a[end][i])), max(abs(r.b[end][i]), largest));
    }
  const D4 scale = r.scale = inverse_power_of_two(largest);
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < 3; ++i) {
      r.q[end][i] = r.q[end][i] * scale;
      r.a[end][i] = r.a[end][i] * scale;
      r.b[end][i] = r.b[end][i] * scale;
    }
}

template <class V>
inline V largest_of(const V (&x)[2][3]) {
  V m = zero<V>();
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < 3; ++i) m = max(abs(x[end][i]), m);
  return m;
}

// Bernstein coefficients of F on [0, 1].
template <class V>
inline void set_contact_cubic(const RelativeMotion<V>& r, V (&f)[4]) {
  V n00[3], n01[3], n10[3], n11[3], m[3];
  cross(r.a[0], r.b[0], n00);
  cross(r.a[0], r.b[1], n01);
  cross(r.a[1], r.b[0], n10);
  cross(r.a[1], r.b[1], n11);
  for (int i = 0; i < 3; ++i) m[i] = n01[i] + n10[i];
  f[0] = V::all(3) * dot(r.q[0], n00);
  f[1] = dot(r.q[1], n00) + dot(r.q[0], m);
  f[2] = dot(r.q[0], n11) + dot(r.q[1], m);
  f[3] = V::all(3) * dot(r.q[1], n11);
}
template <class V>
inline V cubic_at(const V (&f)[4], V t) {
  const V a = lerp(f[0], f[1], t), b = lerp(f[1], f[2], t), c = lerp(f[2], f[3], t);
  return lerp(lerp(a, b, t), lerp(b, c, t), t);
}

// Newton's method from t on, where advancement left the pair: the root and F' there. No accuracy is needed.
template <class V>
inline void first_guess(const V (&f)[4], V t, V& root, V& slope) {
  V x[4] = {f[0], f[1], f[2], f[3]};
  right_part(x, t);
  const V three = V::all(3), c1 = three * (x[1] - x[0]), c2 = three * ((x[0] - x[1]) + (x[2] - x[1]));
  const V c3 = (x[3] - x[0]) - three * (x[2] - x[1]);
  V s = zero<V>(), rate = c1;
  for (int i = 0; i < 3; ++i) {
    const V value = ((c3 * s + c2) * s + c1) * s + x[0];
    rate = (three * c3 * s + V::all(2) * c2) * s + c1;
    s = min(max(s - value / rate, zero<V>()), one<V>());
  }
  const V rest = one<V>() - t;
  root = min(t + s * rest, one<V>());
  slope = rate / rest;
}

template <class V>
inline V underflow() {
  return V::all(0x1p-900);
}

// U, V and N for the vector n = a x b at a time, and the bounds of their errors as those at any time within `width`.
template <class V>
struct InsideFunctions {
  V n[3], u, v, big_n, eu, ev, en;
};
template <class V>
inline void set_inside(const RelativeMotion<V>& r, V time, V width, V mq, V ma, V mb, InsideFunctions<V>& out) {
  V q[3], a[3], b[3], qb[3], aq[3];
  for (int i = 0; i < 3; ++i) {
    q[i] = lerp(r.q[0][i], r.q[1][i], time);
    a[i] = lerp(r.a[0][i], r.a[1][i], time);
    b[i] = lerp(r.b[0][i], r.b[1][i], time);
  }
  cross(a, b, out.n);
  cross(q, b, qb);
  cross(a, q, aq);
  out.big_n = dot(out.n, out.n), out.u = dot(out.n, qb), out.v = dot(out.n, aq);
  const V each = (V::all(kInsideError) + V::all(kInsideSlope) * width) * ((abs(out.n[0]) + abs(out.n[1])) + abs(out.n[2]));
  out.eu = each * (mq * mb) + underflow<V>(), out.ev = each * (ma * mq) + underflow<V>();
  out.en = each * (ma * mb) + underflow<V>();
}

// The time by which four pairs have certainly touched, 2 where that is not certain; t: they are apart before it.
template <int K>
inline D4 touched_by(const KernelPairs& pairs, const int* rows, D4 t) {
  using V = D4;
  RelativeMotion<V> r;
  set_relative<K>(pairs, rows, r);
  V f[4], root, slope;
  set_contact_cubic(r, f);
  first_guess(f, t, root, slope);
  const V mq = largest_of(r.q), ma = largest_of(r.a), mb = largest_of(r.b);
  const V error = V::all(kCubicError) * (mq * ma * mb) + underflow<V>();
  const V half = V::all(4) * error / abs(slope) + V::all(0x1p-52);
  const V lo = max(root - half, zero<V>()), hi = min(root + half, one<V>());
  const V at_lo = cubic_at(f, lo), at_hi = cubic_at(f, hi);
  const auto changes = ((at_lo > error) & (zero<V>() - at_hi > error)) | ((at_hi > error) & (zero<V>() - at_lo > error));
  const V width = max(hi - root, root - lo) * V::all(1 + 0x1p-50);

  InsideFunctions<V> at;
  set_inside(r, root, width, mq, ma, mb, at);
  const V up = V::all(1 + 0x1p-48);
  auto inside = (at.u > at.eu) & (at.v > at.ev);
  if (K == 3)
    inside = inside & (at.big_n - at.u - at.v > (at.eu + at.ev + at.en) * up);
  else
    inside = inside & (at.big_n - at.u > (at.eu + at.en) * up) & (at.big_n - at.v > (at.ev + at.en) * up);
  return select(changes & inside & (width <= V::all(1.0 / 64)), hi, V::all(2));
}

template <int K>
inline void certify_all(const KernelPairs& pairs, const int* subset, int count, KernelResult* results) {
  int owner[4], waiting = 0;
  const auto flush = [&] {
    if (waiting == 0) return;
    int rows[4];
    double t[4], touched[4];
    for (int l = 0; l < 4; ++l) {
      const int i = owner[l < waiting ? l : 0];
      rows[l] = subset[i];
      t[l] = results[i].t;
    }
    touched_by<K>(pairs, rows, D4::load(t)).store(touched);
    for (int l = 0; l < waiting; ++l) results[owner[l]].touched_by = touched[l];
    waiting = 0;
  };
  for (int i = 0; i < count; ++i) {
    if (results[i].verdict != Verdict::contact || pairs.separation[subset[i]] != 0) continue;
    owner[waiting++] = i;
    if (waiting == 4) flush();
  }
  flush();
}
