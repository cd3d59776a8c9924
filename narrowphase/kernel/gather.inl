// Kernel text: from vertex records to corners in lanes.

template <class V>
struct Points {
  V p[2][4][3];  // [end][vertex][axis]
};

// Lane l holds the pair rows[l].
template <class Rows>
inline void gather(const KernelPairs& pairs, const Rows& rows, Points<Doubles>& out) {
  for (int i = 0; i < 4; ++i) {
    const double* v[Doubles::lanes];
    for (int l = 0; l < Doubles::lanes; ++l)
      v[l] = pairs.x + static_cast<long long>(pairs.vertices[rows[l]][i]) * 8;
    for (int end = 0; end < 2; ++end) transpose(v, 4 * end, out.p[end][i]);
  }
}

template <class V>
inline void corners_of(const V (&p)[4][3], V (&c)[3][3]) {  // vertex-face
  for (int k = 0; k < 3; ++k)
    for (int a = 0; a < 3; ++a) c[k][a] = p[0][a] - p[1 + k][a];
}
template <class V>
inline void corners_of(const V (&p)[4][3], V (&c)[4][3]) {  // edge-edge
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int a = 0; a < 3; ++a) c[2 * i + j][a] = p[i][a] - p[2 + j][a];
}
// The two edges whose cross product is the pair's normal, one rounding each.
template <class V, int K>
inline void edges_of(const V (&p)[4][3], V (&e1)[3], V (&e2)[3]) {
  for (int a = 0; a < 3; ++a) {
    e1[a] = K == 4 ? p[1][a] - p[0][a] : p[2][a] - p[1][a];
    e2[a] = K == 4 ? p[3][a] - p[2][a] : p[3][a] - p[1][a];
  }
}

template <class V, int K>
inline V largest_component(const V (&c)[2][K][3]) {
  V m = zero<V>();
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < K; ++k)
      for (int a = 0; a < 3; ++a) m = max(abs(c[end][k][a]), m);
  return m;
}
