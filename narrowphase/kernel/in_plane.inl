// Kernel text: contacts of a vertex and an edge in the plane, in double lanes (docs/two-dimensions.md).
//
// With q = p - e0 and e = e1 - e0 the two touch iff q = U e with U in [0, 1]. g = 2 q x e is a quadratic, and
// where it has opposite signs at lo < hi while q.e and (e - q).e are positive on [lo, hi], its root there is
// a contact: q is then parallel to e, which is not 0, and 0 < U < 1.
//
// Errors, in u = 2^-53, Mq and Me the largest components of q and e at both ends. These are rounded once
// each. A coefficient of g carries 20 roundings of Mq Me (two products of 3, their sum 2; the middle one
// twice that and 4), and is at most 4 Mq Me; two levels of mixing add 3 * 4 each: 44 in all, and 48 covers
// second order. q.e at a time: components mixed err by 4, products by 9, their sum by 20; (e - q).e by 22, in
// Me (Mq + Me); 24 covers second order. In w they change by at most 8 w, as components do by at most 2 w of
// the largest.
constexpr double kInPlaneError = 48 * kU, kAlongError = 24 * kU, kAlongSlope = 8.25;

template <class V>
struct RelativeInPlane {
  V q[2][2], e[2][2];
  V scale;
};

inline void set_relative_in_plane(const KernelPairs& pairs, const int* rows, RelativeInPlane<Doubles>& r) {
  Points<Doubles> p;
  gather(pairs, rows, p);
  Doubles largest = zero<Doubles>();
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < 2; ++i) {
      const Doubles(&x)[4][3] = p.p[end];
      r.q[end][i] = x[0][i] - x[1][i];
      r.e[end][i] = x[2][i] - x[1][i];
      largest = max(max(abs(r.q[end][i]), abs(r.e[end][i])), largest);
    }
  const Doubles scale = r.scale = inverse_power_of_two(largest);
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < 2; ++i) {
      r.q[end][i] = r.q[end][i] * scale;
      r.e[end][i] = r.e[end][i] * scale;
    }
}

template <class V>
inline V dot_in_plane(const V (&x)[2], const V (&y)[2]) {
  return x[0] * y[0] + x[1] * y[1];
}
template <class V>
inline V cross_in_plane(const V (&x)[2], const V (&y)[2]) {
  return x[0] * y[1] - x[1] * y[0];
}
template <class V>
inline V largest_in_plane(const V (&x)[2][2]) {
  return max(max(abs(x[0][0]), abs(x[0][1])), max(abs(x[1][0]), abs(x[1][1])));
}
template <class V>
inline V quadratic_at(const V (&g)[3], V t) {
  return lerp(lerp(g[0], g[1], t), lerp(g[1], g[2], t), t);
}

// Guesses the first root after t and the slope there; no proof needs them to be accurate.
template <class V>
inline void guess_root(const V (&g)[3], V t, V& root, V& slope) {
  const V two = V::all(2), rest = one<V>() - t;
  const V middle = lerp(lerp(g[0], g[1], t), lerp(g[1], g[2], t), t), last = g[2];
  const V between = lerp(g[1], g[2], t);
  const auto flipped = middle < zero<V>();
  const V x0 = abs(middle), x1 = select(flipped, zero<V>() - between, between),
          x2 = select(flipped, zero<V>() - last, last);
  const V disc = sqrt(max(x1 * x1 - x0 * x2, zero<V>()));
  const auto falling = x1 < zero<V>();
  const V over = select(falling, x0, x1 + disc);
  const V s = over / select(falling, (x0 - x1) + disc, (x1 + disc) - x2);
  V at = min(max(t + s * rest, zero<V>()), one<V>());
  slope = two * lerp(g[1] - g[0], g[2] - g[1], at);
  at = at - quadratic_at(g, at) / slope;
  root = min(max(at, zero<V>()), one<V>());
}

// Returns the time by which pairs, one a lane, apart before t, have certainly touched; 2: not certain.
inline Doubles touched_by_in_plane(const KernelPairs& pairs, const int* rows, Doubles t) {
  using V = Doubles;
  RelativeInPlane<V> r;
  set_relative_in_plane(pairs, rows, r);
  const V two = V::all(2);
  const V g[3] = {two * cross_in_plane(r.q[0], r.e[0]),
                  cross_in_plane(r.q[0], r.e[1]) + cross_in_plane(r.q[1], r.e[0]),
                  two * cross_in_plane(r.q[1], r.e[1])};
  V root, slope;
  guess_root(g, t, root, slope);
  const V mq = largest_in_plane(r.q), me = largest_in_plane(r.e);
  const V error = V::all(kInPlaneError) * (mq * me) + underflow<V>();
  const V half = V::all(4) * error / abs(slope) + V::all(0x1p-52);
  const V lo = max(root - half, zero<V>()), hi = min(root + half, one<V>());
  const V at_lo = quadratic_at(g, lo), at_hi = quadratic_at(g, hi);
  const auto changes =
      ((at_lo > error) & (zero<V>() - at_hi > error)) | ((at_hi > error) & (zero<V>() - at_lo > error));
  const V width = max(hi - root, root - lo) * V::all(1 + 0x1p-50);
  V q[2], e[2], rest[2];
  for (int i = 0; i < 2; ++i) {
    q[i] = lerp(r.q[0][i], r.q[1][i], root);
    e[i] = lerp(r.e[0][i], r.e[1][i], root);
    rest[i] = e[i] - q[i];
  }
  const V each = (V::all(kAlongError) + V::all(kAlongSlope) * width) * me;
  const auto inside = (dot_in_plane(q, e) > each * mq + underflow<V>()) &
                      (dot_in_plane(rest, e) > each * (mq + me) + underflow<V>());
  return select(changes & inside & (width <= V::all(1.0 / 64)), hi, V::all(2));
}

inline void certify_in_plane(const KernelPairs& pairs, const int* subset, int count, KernelResult* results) {
  certify_contacts(pairs, subset, count, results, [](const KernelPairs& p, const int* rows, Doubles t) {
    return touched_by_in_plane(p, rows, t);
  });
}

// The geometry of ordinary contacts, as contact_geometry.inl has it with V = 0: p1 - p2 = q - U e errs by
// less than 12u (|q| + 2 longest), and e is 2^30 times its noise long.
template <class V>
inline void geometry_in_plane(const RelativeInPlane<V>& r, V t, Geometry<V>& f) {
  V q[2], e[2];
  for (int i = 0; i < 2; ++i) {
    q[i] = lerp(r.q[0][i], r.q[1][i], t);
    e[i] = lerp(r.e[0][i], r.e[1][i], t);
  }
  const V longest = sqrt(max(dot_in_plane(r.e[0], r.e[0]), dot_in_plane(r.e[1], r.e[1])));
  const V farthest = sqrt(max(dot_in_plane(r.q[0], r.q[0]), dot_in_plane(r.q[1], r.q[1])));
  const V noise = V::all(12 * kU) * (farthest + (longest + longest)), certain = V::all(4) * noise;
  const V size = dot_in_plane(e, e), resolution = V::all(0x1p30 * 4 * kU) * longest;
  const auto has_length = (size > V::all(0x1p-200)) & (size > resolution * resolution);
  const V safe = select(has_length, size, one<V>()), length = sqrt(safe);
  V u = dot_in_plane(q, e) / safe;
  const V left[2] = {q[0] - u * e[0], q[1] - u * e[1]};
  u = u + dot_in_plane(left, e) / safe;
  f.u = (one<V>() + u) - one<V>();
  f.v = zero<V>();
  const V to_end = min(f.u, one<V>() - f.u);
  V apart[2], moved[2];
  for (int i = 0; i < 2; ++i) {
    apart[i] = q[i] - f.u * e[i];
    moved[i] = (r.q[1][i] - f.u * r.e[1][i]) - (r.q[0][i] - f.u * r.e[0][i]);
  }
  const V n[2] = {(zero<V>() - e[1]) / length, e[0] / length};
  const V here = dot_in_plane(n, apart), speed = dot_in_plane(n, moved);
  f.ordinary =
      has_length & (to_end * length > certain + certain) & (abs(here) > certain) & (abs(speed) > certain);
  const auto below = here < zero<V>();
  for (int i = 0; i < 2; ++i) f.normal[i] = select(below, zero<V>() - n[i], n[i]);
  f.normal[2] = zero<V>();
  f.gap = sqrt(dot_in_plane(apart, apart));
  f.speed = select(below, zero<V>() - speed, speed);
}

inline void contact_geometry_in_plane(const KernelPairs& pairs, const double* t, KernelContact* contacts) {
  using V = Doubles;
  for (int first = 0; first < pairs.count; first += V::lanes) {
    int rows[V::lanes];
    double times[V::lanes], u[V::lanes], n[2][V::lanes], gap[V::lanes], speed[V::lanes], unit[V::lanes];
    for (int l = 0; l < V::lanes; ++l) {
      rows[l] = first + l < pairs.count ? first + l : pairs.count - 1;
      times[l] = t[rows[l]];
    }
    RelativeInPlane<V> r;
    set_relative_in_plane(pairs, rows, r);
    Geometry<V> f;
    geometry_in_plane(r, V::load(times), f);
    f.u.store(u), f.gap.store(gap), f.speed.store(speed);
    (one<V>() / r.scale).store(unit);
    for (int i = 0; i < 2; ++i) f.normal[i].store(n[i]);
    const int ordinary = bits(f.ordinary);
    for (int l = 0; l < V::lanes && first + l < pairs.count; ++l) {
      KernelContact& out = contacts[first + l];
      out.ordinary = ordinary >> l & 1;
      out.weight[0] = 1, out.weight[1] = -(1 - u[l]), out.weight[2] = -u[l], out.weight[3] = 0;
      out.normal[0] = n[0][l], out.normal[1] = n[1][l], out.normal[2] = 0;
      out.gap = gap[l] * unit[l];
      out.speed = speed[l] * unit[l];
    }
  }
}
