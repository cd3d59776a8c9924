#define ONSET_ISA pack_test_avx512
#define ONSET_WIDE_PACKS
#define ONSET_PACK_OPERATIONS pack_operations_avx512
#include "tests/base/simd/pack_operations.inl"
