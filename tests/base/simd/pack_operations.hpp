// Every operation of base/simd/pack.hpp on one set of inputs, from two translation units: plain arrays and
// registers.
#pragma once

namespace onset::tests {

// Results of arithmetic may be NaN with any payload; `exact` ones are compared bit for bit.
struct PackResults {
  double arithmetic_d[8][4];
  double exact_d[6][4];
  float arithmetic_f[8][8];
  float exact_f[6][8];
  int masks[20];
};

struct PackInputs {
  double a[4], b[4], c[4];
  float x[8], y[8], z[8];
};

PackResults pack_operations_scalar(const PackInputs& in);
PackResults pack_operations_avx2(const PackInputs& in);

// Whether the table of base/simd/lane_table.hpp that the compiler made is the one made now.
bool lane_table_is_made_again();

}  // namespace onset::tests
