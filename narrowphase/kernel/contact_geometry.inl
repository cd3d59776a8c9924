// Kernel text: geometry of ordinary contacts, in double lanes: closest points are certainly inside, and the
// cross product, the gap and the motion along it are more than rounding. Others are left to scalar code
// (distance/contact_geometry.hpp).
//
// p1 - p2 = +-(q - U a - V b) errs by less than 12u (|q| + 2 longest); four times that tells sides apart. A
// width of 2^30 times the edges' noise leaves a normal good to 2^-30 (docs/theory.md, §16.4).

template <class V>
inline V squared_size(const V (&x)[2][3]) {
  return max(dot(x[0], x[0]), dot(x[1], x[1]));
}

template <class V>
struct Geometry {
  V u, v, normal[3], gap, speed;  // gap and speed are scaled, u and v multiples of 2^-52
  typename V::Mask ordinary;
};

template <class V, int K>
inline void geometry_at(const RelativeMotion<V>& r, V t, Geometry<V>& f) {
  V q[3], a[3], b[3], along[3], other[3], across[3], left[3];
  for (int i = 0; i < 3; ++i) {
    q[i] = lerp(r.q[0][i], r.q[1][i], t);
    a[i] = lerp(r.a[0][i], r.a[1][i], t);
    b[i] = lerp(r.b[0][i], r.b[1][i], t);
  }
  const V longest = sqrt(max(squared_size(r.a), squared_size(r.b)));
  const V edge_noise = V::all(4 * kU) * longest,
          noise = V::all(12 * kU) * (sqrt(squared_size(r.q)) + (longest + longest));

  // The plane is built from the longer edge; the second round takes back what the first lost to a thin
  // primitive.
  const auto swapped = dot(b, b) > dot(a, a);
  for (int i = 0; i < 3; ++i) along[i] = select(swapped, b[i], a[i]), other[i] = select(swapped, a[i], b[i]);
  const V size = dot(along, along), share = dot(other, along) / size;
  for (int i = 0; i < 3; ++i) across[i] = other[i] - share * along[i];
  const V rest = dot(across, along) / size;
  for (int i = 0; i < 3; ++i) across[i] = across[i] - rest * along[i];
  const V width = dot(across, across), resolution = V::all(0x1p30) * edge_noise;
  auto ordinary = (size > V::all(0x1p-200)) & (width > V::all(0x1p-200)) & (width > resolution * resolution);

  V x = zero<V>(), y = zero<V>();
  for (int i = 0; i < 3; ++i) left[i] = q[i];
  for (int round = 0; round < 2; ++round) {
    const V dy = dot(left, across) / width;
    x = x + (dot(left, along) / size - dy * share);
    y = y + dy;
    for (int i = 0; i < 3; ++i) left[i] = (q[i] - x * along[i]) - y * other[i];
  }
  f.u = (one<V>() + select(swapped, y, x)) - one<V>();
  f.v = (one<V>() + select(swapped, x, y)) - one<V>();
  // The foot is at least half a coordinate times the width away from that coordinate's side.
  const V to_side = K == 3 ? min((one<V>() - f.u) - f.v, min(f.u, f.v))
                           : min(min(f.u, f.v), min(one<V>() - f.u, one<V>() - f.v));
  const V certain = V::all(4) * noise;
  ordinary = ordinary & (to_side * sqrt(width) > certain + certain);

  const V sign = V::all(K == 3 ? 1 : -1);
  V apart[3], moved[3], n[3];
  for (int i = 0; i < 3; ++i) {
    apart[i] = sign * ((q[i] - f.u * a[i]) - f.v * b[i]);
    moved[i] = sign * (((r.q[1][i] - f.u * r.a[1][i]) - f.v * r.b[1][i]) -
                       ((r.q[0][i] - f.u * r.a[0][i]) - f.v * r.b[0][i]));
  }
  cross(along, across, n);
  normalise(n);
  const V here = dot(n, apart), speed = dot(n, moved);
  f.ordinary = ordinary & (abs(here) > certain) & (abs(speed) > certain);
  const auto below = here < zero<V>();
  for (int i = 0; i < 3; ++i) f.normal[i] = select(below, zero<V>() - n[i], n[i]);
  f.gap = sqrt(dot(apart, apart));
  f.speed = select(below, zero<V>() - speed, speed);
}

template <int K>
inline void contact_geometry_all(const KernelPairs& pairs, const double* t, KernelContact* contacts) {
  using V = Doubles;
  for (int first = 0; first < pairs.count; first += V::lanes) {
    int rows[V::lanes];
    double times[V::lanes], u[V::lanes], v[V::lanes], n[3][V::lanes], gap[V::lanes], speed[V::lanes],
        unit[V::lanes];
    for (int l = 0; l < V::lanes; ++l) {
      rows[l] = first + l < pairs.count ? first + l : pairs.count - 1;
      times[l] = t[rows[l]];
    }
    RelativeMotion<V> r;
    set_relative<K>(pairs, rows, r);
    Geometry<V> f;
    geometry_at<V, K>(r, V::load(times), f);
    f.u.store(u), f.v.store(v), f.gap.store(gap), f.speed.store(speed);
    (one<V>() / r.scale).store(unit);
    for (int i = 0; i < 3; ++i) f.normal[i].store(n[i]);
    const int ordinary = bits(f.ordinary);
    for (int l = 0; l < V::lanes && first + l < pairs.count; ++l) {
      KernelContact& out = contacts[first + l];
      out.ordinary = ordinary >> l & 1;
      const double weights[2][4] = {{1, -(1 - u[l] - v[l]), -u[l], -v[l]},
                                    {1 - u[l], u[l], -(1 - v[l]), -v[l]}};
      for (int i = 0; i < 4; ++i) out.weight[i] = weights[K == 4][i];
      for (int i = 0; i < 3; ++i) out.normal[i] = n[i][l];
      out.gap = gap[l] * unit[l];
      out.speed = speed[l] * unit[l];
    }
  }
}
