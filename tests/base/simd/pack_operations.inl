// Included once per instruction set, with ONSET_ISA and ONSET_PACK_OPERATIONS defined.
#include "base/simd/pack.hpp"
#include "tests/base/simd/pack_operations.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

template <class V, class T>
void all_operations(const T* pa, const T* pb, const T* pc, T (*arithmetic)[V::lanes], T (*exact)[V::lanes],
                    int* masks) {
  const V a = V::load(pa), b = V::load(pb), c = V::load(pc), zero = V::all(0);
  const V results[] = {a + b, a - b, a * b, a / b, sqrt(a), lerp(a, b, c), (a * b + c) - a, c - a * b};
  for (const V& r : results) r.store(*arithmetic++);
  const V u[3] = {a, b, c}, v[3] = {c, a, b};
  V w[3];
  cross(u, v, w);
  const auto less = a < b, equal = a == b;
  const V bits_only[] = {
      min(a, b), max(a, b), abs(a), select(less, a, c), select(less | equal, b, c), select(a <= b, a, b)};
  for (const V& r : bits_only) r.store(*exact++);
  const int all[] = {bits(a < b),
                     bits(a <= b),
                     bits(a > b),
                     bits(a >= b),
                     bits(a == b),
                     bits(less & equal),
                     bits(less | equal),
                     bits((a < c) & (b > c)),
                     bits(dot(u, v) > zero),
                     bits(w[1] >= w[2])};
  for (int m : all) *masks++ = m;
}

}  // namespace
}  // namespace ONSET_ISA

namespace tests {

PackResults ONSET_PACK_OPERATIONS(const PackInputs& in) {
  using namespace ONSET_ISA;
  PackResults r{};
  all_operations<D4>(in.a, in.b, in.c, r.arithmetic_d, r.exact_d, r.masks);
  all_operations<F8>(in.x, in.y, in.z, r.arithmetic_f, r.exact_f, r.masks + 10);
  to_float(D4::load(in.a), D4::load(in.b)).store(r.arithmetic_f[7]);
  inverse_power_of_two(abs(D4::load(in.a))).store(r.exact_d[5]);
  D4 columns[3];
  transpose(in.a, in.b, in.c, in.a, columns);
  for (int i = 0; i < 3; ++i) columns[i].store(r.exact_d[i + 1]);
  return r;
}

}  // namespace tests
}  // namespace onset
