// Kernel text: the culls, in single precision, a pair a lane; u = 2^-24 here (docs/theory.md, §12).
//
// Corner differences are formed in double, scaled alike for the scene and rounded to float once. A Bernstein
// coefficient errs by 6u |w| rho; 7u covers second order and |w| <= 1 + 5u, 2^-140 underflow (L23). d is
// rounded up by 2^-22 (L24).

template <int K>
struct FloatPairs {
  Floats c[2][K][3];  // corners at both ends
  Floats d;           // separation
  Floats error;       // bound of a coefficient's error
};

// Moves the far end to t_max. A pair beyond d + reach until then is not reported earlier unless it spends its
// checks, so the limiting pair stays the same. In double the lerp's 3u is far below float's rounding.
template <class V, int K>
inline void cut_short(const V (&c0)[K][3], V (&c1)[K][3], V t_max) {
  for (int k = 0; k < K; ++k)
    for (int a = 0; a < 3; ++a) c1[k][a] = lerp(c0[k][a], c1[k][a], t_max);
}

// The rows in the lanes: consecutive ones, whose addresses need less arithmetic, or a list.
struct InOrder {
  int first;
  int operator[](int lane) const { return first + lane; }
  InOrder from(int lane) const { return {first + lane}; }
  Ints in_lanes() const { return Ints::all(first) + Ints::lane_numbers(); }
};
struct Listed {
  const int* rows;
  int operator[](int lane) const { return rows[lane]; }
  Listed from(int lane) const { return {rows + lane}; }
  Ints in_lanes() const { return Ints::load(rows); }
};

template <class Rows>
inline Floats float_separation(const KernelPairs& pairs, Rows rows) {
  const double beyond = pairs.cull_t_max < 1 ? pairs.reach : 0;
  double of_pair[Floats::lanes];
  for (int l = 0; l < Floats::lanes; ++l)
    of_pair[l] = (pairs.separation[rows[l]] + pairs.cull_beyond + beyond) * pairs.scale;
  return to_float(Doubles::load(of_pair), Doubles::load(of_pair + Doubles::lanes)) *
         Floats::all(1 + 0x1p-22f);
}

template <int K>
inline Floats rho_of(const Floats (&c)[2][K][3]) {
  Floats R[3] = {zero<Floats>(), zero<Floats>(), zero<Floats>()};
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < K; ++k)
      for (int a = 0; a < 3; ++a) R[a] = max(abs(c[end][k][a]), R[a]);
  return sqrt(dot(R, R));
}

template <int K, class Rows>
inline void float_corners(const KernelPairs& pairs, Rows rows, FloatPairs<K>& out) {
  using V = Floats;
  Doubles lanes[2][2][K][3];
  const Doubles scale = Doubles::all(pairs.scale);
  for (int half = 0; half < 2; ++half) {
    Points<Doubles> p;
    gather(pairs, rows.from(Doubles::lanes * half), p);
    for (int end = 0; end < 2; ++end) corners_of(p.p[end], lanes[half][end]);
    if (pairs.cull_t_max < 1) cut_short(lanes[half][0], lanes[half][1], Doubles::all(pairs.cull_t_max));
  }
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < K; ++k)
      for (int a = 0; a < 3; ++a)
        out.c[end][k][a] = to_float(lanes[0][end][k][a] * scale, lanes[1][end][k][a] * scale);
  out.d = float_separation(pairs, rows);
  out.error = V::all(7 * 0x1p-24f) * rho_of(out.c) * V::all(1 + 0x1p-20f) + V::all(0x1p-140f);
}

// Makes the same from rounded positions: a difference errs by what these do and rounds once. A corner that is
// cut short errs by 10u rho, 2u of it t's own rounding, and a coefficient by 14u; 16u covers second order,
// and a t_max below 2^-126 (docs/theory.md, L25).
template <int K, class Rows>
inline void rounded_corners(const KernelPairs& pairs, Rows rows, FloatPairs<K>& out) {
  using V = Floats;
  V p[2][4][3], of_vertex[4];
  for (int i = 0; i < 4; ++i) {
    const float* row[Floats::lanes];
    for (int l = 0; l < Floats::lanes; ++l)
      row[l] = pairs.rounded + static_cast<long long>(pairs.vertices[rows[l]][i]) * 8;
    V x[7];
    transpose(row, x);
    for (int a = 0; a < 3; ++a) p[0][i][a] = x[a], p[1][i][a] = x[4 + a];
    of_vertex[i] = x[3];
  }
  for (int end = 0; end < 2; ++end) corners_of(p[end], out.c[end]);
  const bool is_cut = pairs.cull_t_max < 1;
  if (is_cut) cut_short(out.c[0], out.c[1], V::all(static_cast<float>(pairs.cull_t_max)));
  out.d = float_separation(pairs, rows);
  const V of_positions = K == 3 ? of_vertex[0] + max(of_vertex[1], max(of_vertex[2], of_vertex[3]))
                                : max(of_vertex[0], of_vertex[1]) + max(of_vertex[2], of_vertex[3]);
  out.error = (V::all((is_cut ? 16 : 7) * 0x1p-24f) * rho_of(out.c) + of_positions) * V::all(1 + 0x1p-20f) +
              V::all(0x1p-140f);
}

// Tells whether the direction that turns linearly from w0 at t = 0 to w1 at t = 1 separates throughout: for
// each corner x0, x2 > 0 and x1 > -sqrt(x0 x2) (docs/theory.md, L12, L24).
template <class V, int K>
inline typename V::Mask separates(const V (&c0)[K][3], const V (&c1)[K][3], const V (&w0)[3],
                                  const V (&w1)[3], V m0, V m2) {
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

// Any direction near the closest one is safe, so plain clamped closest points do: of the parallelogram c0 + u
// e1 + v e2 ...
template <class V>
inline V clamp01(V x) {
  return min(max(x, zero<V>()), one<V>());
}
template <class V>
inline void cheap_direction(const V (&c)[4][3], V (&w)[3]) {
  V e1[3], e2[3];
  spanning_edges(c, e1, e2);
  const V floor = V::all(0x1p-100f);
  const V aa = dot(e1, e1), ab = dot(e1, e2), bb = dot(e2, e2), p = dot(e1, c[0]), q = dot(e2, c[0]);
  const V det = max(aa * bb - ab * ab, floor);
  V u = clamp01((ab * q - bb * p) / det);
  const V v = clamp01((zero<V>() - (q + ab * u)) / max(bb, floor));
  u = clamp01((zero<V>() - (p + ab * v)) / max(aa, floor));
  for (int a = 0; a < 3; ++a) w[a] = (c[0][a] + u * e1[a]) + v * e2[a];
}
// ... and of the triangle: the normal where its foot is inside, else the closest point of the three sides.
template <class V>
inline V side_point(const V (&p)[3], const V (&q)[3], V (&f)[3]) {
  V e[3];
  for (int a = 0; a < 3; ++a) e[a] = q[a] - p[a];
  const V s = clamp01((zero<V>() - dot(p, e)) / max(dot(e, e), V::all(0x1p-100f)));
  for (int a = 0; a < 3; ++a) f[a] = p[a] + s * e[a];
  return dot(f, f);
}
template <class V>
inline void cheap_direction(const V (&c)[3][3], V (&w)[3]) {
  V e1[3], e2[3], n[3], f[3];
  V nearest = side_point(c[0], c[1], w);
  for (int k = 1; k < 3; ++k) {
    const V here = side_point(c[k], c[(k + 1) % 3], f);
    const auto nearer = here < nearest;
    for (int a = 0; a < 3; ++a) w[a] = select(nearer, f[a], w[a]);
    nearest = min(here, nearest);
  }
  spanning_edges(c, e1, e2);
  cross(e1, e2, n);
  const V aa = dot(e1, e1), ab = dot(e1, e2), bb = dot(e2, e2), p = dot(e1, c[0]), q = dot(e2, c[0]);
  const V det = aa * bb - ab * ab, u = ab * q - bb * p, v = ab * p - aa * q;
  const auto inside = (u > zero<V>()) & (v > zero<V>()) & (u + v < det);
  const V height = dot(n, c[0]);
  const auto below = height < zero<V>();
  for (int a = 0; a < 3; ++a) w[a] = select(inside, select(below, zero<V>() - n[a], n[a]), w[a]);
}

// Returns what is demanded along w: error and d, which contains what is to be kept (docs/theory.md, L24).
template <class V>
inline V demand(const V (&w)[3], V d, V error, bool maximum_norm) {
  return (error + d * norm_factor(w, maximum_norm)) * V::all(1 + 0x1p-19f);
}
template <class V, int K>
inline V initial_gap(const V (&c)[K][3], V error) {  // the point errs by < 10u rho < 2 error
  return (sqrt(nearest_on_boundary(c).f2) + V::all(2) * error) * V::all(1 + 0x1p-19f);
}

// Tells whether the pair's boxes, moving linearly, are apart at every time on one axis or another. On an axis
// the pair is within m = d + error only where the line from s0 to s1 is not negative, for s = max_k c_k + m
// and s = m - min_k c_k. Roots are known within 4u; 2^-20 = 16u is taken off (docs/theory.md, L26).
template <int K>
inline Floats::Mask moving_boxes_apart(const Floats (&c0)[K][3], const Floats (&c1)[K][3], Floats m) {
  using V = Floats;
  V begin = zero<V>(), end = one<V>();
  for (int a = 0; a < 3; ++a) {
    V most[2] = {c0[0][a], c1[0][a]}, least[2] = {c0[0][a], c1[0][a]};
    for (int k = 1; k < K; ++k) {
      most[0] = max(c0[k][a], most[0]), most[1] = max(c1[k][a], most[1]);
      least[0] = min(c0[k][a], least[0]), least[1] = min(c1[k][a], least[1]);
    }
    const V s[2][2] = {{most[0] + m, most[1] + m}, {m - least[0], m - least[1]}};
    for (const auto& [s0, s1] : s) {
      const auto out0 = s0 < zero<V>(), out1 = s1 < zero<V>();
      const V root = s0 / (s0 - s1);
      begin = max(select(out0, select(out1, V::all(2), root), zero<V>()), begin);
      end = min(select(out1, root, one<V>()), end);
    }
  }
  return begin * V::all(1 - 0x1p-20f) > end * V::all(1 + 0x1p-20f);
}

// Returns the mask of pairs that are apart; `refined` tries two halves, each with its own turning direction.
template <int K, class Rows>
inline int cull_lanes(const KernelPairs& pairs, Rows rows, bool refined) {
  using V = Floats;
  FloatPairs<K> s;
  if (!refined && pairs.rounded != nullptr)
    rounded_corners(pairs, rows, s);
  else
    float_corners(pairs, rows, s);
  V d = s.d;
  if (pairs.gap_share > 0)
    d = d + V::all(static_cast<float>(pairs.gap_share) * (1 + 0x1p-20f)) * initial_gap(s.c[0], s.error);
  V w0[3], w1[3];
  cheap_direction(s.c[0], w0);
  cheap_direction(s.c[1], w1);
  normalise(w0);
  normalise(w1);
  const V m0 = demand(w0, d, s.error, pairs.maximum_norm), m1 = demand(w1, d, s.error, pairs.maximum_norm);
  if (!refined) return bits(separates(s.c[0], s.c[1], w0, w1, m0, m1));
  V middle[K][3], wm[3];
  for (int k = 0; k < K; ++k)
    for (int a = 0; a < 3; ++a) middle[k][a] = V::all(0.5f) * (s.c[0][k][a] + s.c[1][k][a]);
  cheap_direction(middle, wm);
  normalise(wm);
  const V mm = demand(wm, d, s.error, pairs.maximum_norm);
  return bits((separates(s.c[0], middle, w0, wm, m0, mm) & separates(middle, s.c[1], wm, w1, mm, m1)) |
              moving_boxes_apart(s.c[0], s.c[1], d + s.error));
}

// Writes a whole pack, of which the survivors are the first lanes; returns their number.
template <class Rows>
inline int write_survivors(int apart, Rows rows, int valid, int* out) {
  const int survivors = ~apart & valid;
  compress(rows.in_lanes(), survivors).store(out);
  return count_lanes(survivors);
}

constexpr int kAllFloats = (1 << Floats::lanes) - 1;

// Fills the lanes of too few rows with the last one.
template <int K, class Rows>
inline int cull_few(const KernelPairs& pairs, Rows rows, int count, bool refined, int* out) {
  int here[Floats::lanes], kept[Floats::lanes];
  for (int l = 0; l < Floats::lanes; ++l) here[l] = rows[l < count ? l : count - 1];
  const int survivors =
      write_survivors(cull_lanes<K>(pairs, Listed{here}, refined), Listed{here}, (1 << count) - 1, kept);
  for (int l = 0; l < survivors; ++l) out[l] = kept[l];
  return survivors;
}

// `out` may be the list of rows itself: no pack is written beyond what was read.
template <int K, class Rows>
inline int cull_rows(const KernelPairs& pairs, Rows rows, int count, bool refined, int* out) {
  int survivors = 0, first = 0;
  for (; first + Floats::lanes <= count; first += Floats::lanes) {
    const Rows here = rows.from(first);
    survivors += write_survivors(cull_lanes<K>(pairs, here, refined), here, kAllFloats, out + survivors);
  }
  if (first == count) return survivors;
  return survivors + cull_few<K>(pairs, rows.from(first), count - first, refined, out + survivors);
}

template <int K>
inline int cull_all(const KernelPairs& pairs, int* survivors) {
  const int coarse = cull_rows<K>(pairs, InOrder{0}, pairs.count, false, survivors);
  return cull_rows<K>(pairs, Listed{survivors}, coarse, true, survivors);
}
