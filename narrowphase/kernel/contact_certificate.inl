// Kernel text: a proof that a contact is real, in double lanes (docs/theory.md, §14).
//
// The pair touches iff q = U a + V b with (U, V) in the triangle or square. Where f = q.(a x b) has opposite
// signs at lo < hi, and n.(q x b), n.(a x q) and what they leave of n.(a x b) are positive on [lo, hi] for a
// fixed n, f's root there is a contact (L34).
//
// Mq, Ma, Mb bound the components of q, a, b. F = 3 f errs by 336u Mq Ma Mb (L35); 350 covers second order,
// 2^-900 underflow.
constexpr double kCubicError = 350 * kU;
// Inside functions carry 26 roundings of |n|_1 in the middle, 30 with the subtractions of N - U - V; 32
// covers second order. Within w <= 1/64 they change by at most 8.25 w (L36).
constexpr double kInsideError = 32 * kU, kInsideSlope = 8.25;

template <class V>
struct RelativeMotion {
  V q[2][3], a[2][3], b[2][3];
  V scale;
};

template <int K>
inline void set_relative(const KernelPairs& pairs, const int* rows, RelativeMotion<Doubles>& r) {
  Points<Doubles> p;
  gather(pairs, rows, p);
  Doubles largest = zero<Doubles>();
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < 3; ++i) {
      const Doubles(&x)[4][3] = p.p[end];
      r.q[end][i] = K == 4 ? x[2][i] - x[0][i] : x[0][i] - x[1][i];
      r.a[end][i] = K == 4 ? x[1][i] - x[0][i] : x[2][i] - x[1][i];
      r.b[end][i] = K == 4 ? x[2][i] - x[3][i] : x[3][i] - x[1][i];
      largest = max(max(abs(r.q[end][i]), abs(r.a[end][i])), max(abs(r.b[end][i]), largest));
    }
  const Doubles scale = r.scale = inverse_power_of_two(largest);
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

// Guesses the root after t and F' there by Newton's method; no proof needs them to be accurate.
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

// U N, V N and N for n = a x b at a time, and their error bounds at all times within `width` of it.
template <class V>
struct InsideFunctions {
  V n[3], u, v, big_n, eu, ev, en;
};
template <class V>
inline void set_inside(const RelativeMotion<V>& r, V time, V width, V mq, V ma, V mb,
                       InsideFunctions<V>& out) {
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
  const V each = (V::all(kInsideError) + V::all(kInsideSlope) * width) *
                 ((abs(out.n[0]) + abs(out.n[1])) + abs(out.n[2]));
  out.eu = each * (mq * mb) + underflow<V>(), out.ev = each * (ma * mq) + underflow<V>();
  out.en = each * (ma * mb) + underflow<V>();
}

// Returns the time by which pairs, one a lane, apart before t, have certainly touched; 2: not certain.
template <int K>
inline Doubles touched_by(const KernelPairs& pairs, const int* rows, Doubles t) {
  using V = Doubles;
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
  const auto changes =
      ((at_lo > error) & (zero<V>() - at_hi > error)) | ((at_hi > error) & (zero<V>() - at_lo > error));
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

// Sets touched_by of results that are contacts without separation, by `touched_by_of` of as many pairs at
// once as there are lanes.
template <class TouchedBy>
inline void certify_contacts(const KernelPairs& pairs, const int* subset, int count, KernelResult* results,
                             TouchedBy&& touched_by_of) {
  int owner[Doubles::lanes], waiting = 0;
  const auto flush = [&] {
    if (waiting == 0) return;
    int rows[Doubles::lanes];
    double t[Doubles::lanes], touched[Doubles::lanes];
    for (int l = 0; l < Doubles::lanes; ++l) {
      const int i = owner[l < waiting ? l : 0];
      rows[l] = subset[i];
      t[l] = results[i].t;
    }
    touched_by_of(pairs, rows, Doubles::load(t)).store(touched);
    for (int l = 0; l < waiting; ++l) results[owner[l]].touched_by = touched[l];
    waiting = 0;
  };
  for (int i = 0; i < count; ++i) {
    if (results[i].verdict != Verdict::contact || pairs.separation[subset[i]] != 0) continue;
    owner[waiting++] = i;
    if (waiting == Doubles::lanes) flush();
  }
  flush();
}

template <int K>
inline void certify_all(const KernelPairs& pairs, const int* subset, int count, KernelResult* results) {
  certify_contacts(pairs, subset, count, results, [](const KernelPairs& p, const int* rows, Doubles t) {
    return touched_by<K>(p, rows, t);
  });
}
