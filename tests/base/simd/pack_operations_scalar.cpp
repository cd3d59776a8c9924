#include <cstring>

#define ONSET_ISA pack_test_scalar
#define ONSET_PACK_OPERATIONS pack_operations_scalar
#include "tests/base/simd/pack_operations.inl"

bool onset::tests::lane_table_is_made_again() {
  onset::pack_test_scalar::LaneTable made;  // no constant, which the compiler would make
  made = onset::pack_test_scalar::make_lane_table();
  return std::memcmp(&made, &onset::pack_test_scalar::kLaneTable, sizeof made) == 0;
}
