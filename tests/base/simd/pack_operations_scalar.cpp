#define ONSET_ISA pack_test_scalar
#define ONSET_PACK_OPERATIONS pack_operations_scalar
#include "tests/base/simd/pack_operations.inl"
