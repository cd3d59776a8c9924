// Included once per instruction set, with ONSET_ISA and ONSET_PACK_OPERATIONS defined.
#include "base/simd/pack.hpp"
#include "tests/base/simd/pack_operations.hpp"

namespace onset {
namespace ONSET_ISA {
namespace {

// Of the lanes from `first` on; N numbers are in a row.
template <class V, class T, int N>
void all_operations(int first, const T* pa, const T* pb, const T* pc, T (*arithmetic)[N], T (*exact)[N],
                    int* masks) {
  const V a = V::load(pa + first), b = V::load(pb + first), c = V::load(pc + first), zero = V::all(0);
  const V results[] = {a + b, a - b, a * b, a / b, sqrt(a), lerp(a, b, c), (a * b + c) - a, c - a * b};
  for (const V& r : results) r.store(*arithmetic++ + first);
  const V u[3] = {a, b, c}, v[3] = {c, a, b};
  V w[3];
  cross(u, v, w);
  const auto less = a < b, equal = a == b;
  const V bits_only[] = {
      min(a, b), max(a, b), abs(a), select(less, a, c), select(less | equal, b, c), select(a <= b, a, b)};
  for (const V& r : bits_only) r.store(*exact++ + first);
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
  for (int m : all) *masks++ |= m << first;
}

void operations_of_doubles(int first, const tests::PackInputs& in, tests::PackResults& r) {
  using V = Doubles;
  all_operations<V>(first, in.a, in.b, in.c, r.arithmetic_d, r.exact_d, r.masks);
  inverse_power_of_two(abs(V::load(in.a + first))).store(r.exact_d[5] + first);
  const double* const arrays[] = {in.a, in.b, in.c};
  const double* points[V::lanes];
  for (int l = 0; l < V::lanes; ++l) points[l] = arrays[(first + l) % 3] + (first + l) % 4;
  V columns[3];
  transpose(points, 1, columns);
  for (int i = 0; i < 3; ++i) columns[i].store(r.exact_d[6 + i] + first);
}

void operations_of_floats(int first, const tests::PackInputs& in, tests::PackResults& r) {
  using V = Floats;
  all_operations<V>(first, in.x, in.y, in.z, r.arithmetic_f, r.exact_f, r.masks + 10);
  const float* const arrays[] = {in.x, in.y, in.z};
  const float* rows[V::lanes];
  for (int l = 0; l < V::lanes; ++l) rows[l] = arrays[(first + l) % 3] + (first + l) % 8;
  V columns[7];
  transpose(rows, columns);
  for (int i = 0; i < 7; ++i) columns[i].store(r.exact_f[6 + i] + first);
  int kept[V::lanes];
  const int mask = bits(V::load(in.x + first) < V::load(in.y + first));
  compress(Ints::all(first) + Ints::lane_numbers(), mask).store(kept);
  for (int i = 0; i < count_lanes(mask); ++i) r.compressed[r.compressed_count++] = kept[i];
}

}  // namespace
}  // namespace ONSET_ISA

namespace tests {

PackResults ONSET_PACK_OPERATIONS(const PackInputs& in) {
  using namespace ONSET_ISA;
  PackResults r{};
  for (int first = 0; first < kDoubles; first += Doubles::lanes) operations_of_doubles(first, in, r);
  for (int first = 0; first < kFloats; first += Floats::lanes) operations_of_floats(first, in, r);
  const double* const halves[] = {in.a, in.b};
  for (int first = 0; first < kFloats; first += Floats::lanes) {
    const double* lo = halves[first / kDoubles] + first % kDoubles;
    const double* hi = Doubles::lanes == kDoubles ? in.b : lo + Doubles::lanes;
    to_float(Doubles::load(lo), Doubles::load(hi)).store(r.arithmetic_f[8] + first);
  }
  return r;
}

}  // namespace tests
}  // namespace onset
