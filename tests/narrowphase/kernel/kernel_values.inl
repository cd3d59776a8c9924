// Included once per way of compiling, with ONSET_ISA, ONSET_KERNEL_VALUES, ONSET_CERTIFICATES and
// ONSET_CONTACT_VALUES defined.
#include "narrowphase/kernel/kernel_text.inl"
#include "tests/narrowphase/kernel/kernel_values.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

double first(const Doubles& v) {
  double lanes[4];
  v.store(lanes);
  return lanes[0];
}
float first(const Floats& v) {
  float lanes[8];
  v.store(lanes);
  return lanes[0];
}

template <int K>
void double_values(const KernelPairs& pairs, int row, const tests::ValuesWanted& in,
                   tests::KernelValues& out) {
  using V = Doubles;
  const int rows[4] = {row, row, row, row};
  State<V, K> s;
  set_up(pairs, rows, s);
  V w[3], wb[3], c[K][3], direction[3], dist, point[3];
  for (int a = 0; a < 3; ++a) w[a] = V::all(in.w[a]), wb[a] = V::all(in.wb[a]);
  const V t = V::all(in.t), tb = V::all(in.tb);
  for (int k = 0; k < K; ++k) {  // as in certify_fixed and certify_moving
    const V g0 = dot(w, s.c[0][k]), g1 = dot(w, s.c[1][k]), h0 = dot(wb, s.c[0][k]), h1 = dot(wb, s.c[1][k]);
    out.g[0][k] = first(g0), out.g[1][k] = first(g1);
    out.at_t[k] = out.b[0][k] = first(lerp(g0, g1, t));
    out.b[1][k] = first(V::all(0.5) * (lerp(g0, g1, tb) + lerp(h0, h1, t)));
    out.b[2][k] = first(lerp(h0, h1, tb));
    for (int a = 0; a < 3; ++a) c[k][a] = lerp(s.c[0][k][a], s.c[1][k][a], t);
  }
  V f[4] = {s.f[0], s.f[1], s.f[2], s.f[3]};
  right_part(f, t);
  left_part(f, V::all(in.u));
  for (int i = 0; i < 4; ++i) out.f[i] = first(f[i]);
  evaluate(c, V::all(in.u), V::all(in.v), point);
  closest_direction(s, t, false, direction, dist);
  for (int a = 0; a < 3; ++a) out.witness[a] = first(point[a]);
  out.unit = first(s.unit), out.rho = first(s.rho), out.distance = first(dist);
  out.f_error = first(s.f_error), out.n_largest = first(s.n_largest);
}

// As in cull_eight and separates: the coefficients on [0, 1], then on [0, 1/2].
template <int K>
void float_values(const KernelPairs& pairs, int row, const tests::ValuesWanted& in,
                  tests::KernelValues& out) {
  using V = Floats;
  const int rows[8] = {row, row, row, row, row, row, row, row};
  FloatPairs<K> s;
  if (pairs.rounded != nullptr)
    rounded_corners(pairs, Listed{rows}, s);
  else
    float_corners(pairs, Listed{rows}, s);
  V w[3], wb[3], middle[3];
  for (int a = 0; a < 3; ++a) {
    w[a] = to_float(Doubles::all(in.w[a]), Doubles::all(in.w[a]));
    wb[a] = to_float(Doubles::all(in.wb[a]), Doubles::all(in.wb[a]));
    out.wf[a] = first(w[a]), out.wbf[a] = first(wb[a]);
  }
  out.f_bound = first(s.error);
  const V half = V::all(0.5f);
  for (int k = 0; k < K; ++k) {
    for (int a = 0; a < 3; ++a) middle[a] = half * (s.c[0][k][a] + s.c[1][k][a]);
    out.bf[0][k] = first(dot(w, s.c[0][k])), out.bf[2][k] = first(dot(wb, s.c[1][k]));
    out.bf[1][k] = first(half * (dot(w, s.c[1][k]) + dot(wb, s.c[0][k])));
    out.bf[3][k] = first(half * (dot(w, middle) + dot(wb, s.c[0][k])));
    out.bf[4][k] = first(dot(wb, middle));
  }
}

template <int K>
tests::Certificates certificates(const KernelPairs& pairs, int row, const tests::CertificateState& in) {
  using V = Doubles;
  const int rows[4] = {row, row, row, row};
  State<V, K> s;
  set_up(pairs, rows, s);
  V w[3], g0[K], g1[K];
  for (int a = 0; a < 3; ++a) w[a] = V::all(in.w[a]), s.w_prev[a] = V::all(in.w_prev[a]);
  s.t = V::all(in.t), s.t_prev = V::all(in.t_prev), s.d = V::all(in.separation), s.delta = V::all(in.delta);
  tests::Certificates r;
  r.fixed = first(certify_fixed(s, w, pairs.maximum_norm, g0, g1));
  r.moving = first(certify_moving(s, w, pairs.maximum_norm, g0, g1));
  r.normal = first(certify_normal(s));
  r.wanted_distance = in.separation + 0.5 * in.delta;
  r.unit = first(s.unit);
  return r;
}

// As in touched_by.
template <int K>
tests::ContactValues contact(const KernelPairs& pairs, int row, double time, double width) {
  using V = Doubles;
  const int rows[4] = {row, row, row, row};
  RelativeMotion<V> r;
  set_relative<K>(pairs, rows, r);
  V f[4];
  set_contact_cubic(r, f);
  const V mq = largest_of(r.q), ma = largest_of(r.a), mb = largest_of(r.b);
  InsideFunctions<V> at;
  set_inside(r, V::all(time), V::all(width), mq, ma, mb, at);
  tests::ContactValues out;
  out.scale = first(r.scale);
  out.cubic = first(cubic_at(f, V::all(time)));
  out.cubic_error = first(V::all(kCubicError) * (mq * ma * mb) + underflow<V>());
  for (int a = 0; a < 3; ++a) out.n[a] = first(at.n[a]);
  out.u = first(at.u), out.v = first(at.v), out.big_n = first(at.big_n);
  out.eu = first(at.eu), out.ev = first(at.ev), out.en = first(at.en);
  return out;
}

}  // namespace
}  // namespace ONSET_ISA

namespace tests {

KernelValues ONSET_KERNEL_VALUES(bool edge_edge, const KernelPairs& pairs, int row,
                                 const ValuesWanted& wanted) {
  KernelValues out = {};
  if (edge_edge) {
    ONSET_ISA::double_values<4>(pairs, row, wanted, out);
    ONSET_ISA::float_values<4>(pairs, row, wanted, out);
  } else {
    ONSET_ISA::double_values<3>(pairs, row, wanted, out);
    ONSET_ISA::float_values<3>(pairs, row, wanted, out);
  }
  return out;
}

Certificates ONSET_CERTIFICATES(bool edge_edge, const KernelPairs& pairs, int row,
                                const CertificateState& state) {
  return edge_edge ? ONSET_ISA::certificates<4>(pairs, row, state)
                   : ONSET_ISA::certificates<3>(pairs, row, state);
}

ContactValues ONSET_CONTACT_VALUES(bool edge_edge, const KernelPairs& pairs, int row, double time,
                                   double width) {
  return edge_edge ? ONSET_ISA::contact<4>(pairs, row, time, width)
                   : ONSET_ISA::contact<3>(pairs, row, time, width);
}

}  // namespace tests
}  // namespace onset
