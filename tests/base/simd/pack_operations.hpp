// Every operation of base/simd/pack.hpp that texts of generic width use, on one set of inputs, from a
// translation unit for each kind of pack; narrow packs take the inputs in two parts.
#pragma once

namespace onset::tests {

constexpr int kDoubles = 8, kFloats = 16;

// Results of arithmetic may be NaN with any payload; `exact` ones are compared bit for bit.
struct PackResults {
  double arithmetic_d[8][kDoubles];
  double exact_d[9][kDoubles];
  float arithmetic_f[9][kFloats];
  float exact_f[13][kFloats];
  int masks[20];
  int compressed[kFloats], compressed_count;
};

struct PackInputs {
  double a[kDoubles], b[kDoubles], c[kDoubles];
  float x[kFloats], y[kFloats], z[kFloats];
};

PackResults pack_operations_scalar(const PackInputs& in);
PackResults pack_operations_avx2(const PackInputs& in);
PackResults pack_operations_avx512(const PackInputs& in);

// Whether the table of base/simd/lane_table.hpp that the compiler made is the one made now.
bool lane_table_is_made_again();

}  // namespace onset::tests
