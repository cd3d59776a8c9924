#define ONSET_KERNEL pack_test_avx2
#define ONSET_PACK_OPERATIONS pack_operations_avx2
#include "tests/narrowphase/pack_operations.inl"
