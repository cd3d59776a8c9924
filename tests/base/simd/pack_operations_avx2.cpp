#define ONSET_ISA pack_test_avx2
#define ONSET_PACK_OPERATIONS pack_operations_avx2
#include "tests/base/simd/pack_operations.inl"
