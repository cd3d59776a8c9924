#define ONSET_KERNEL pack_test_scalar
#define ONSET_PACK_OPERATIONS pack_operations_scalar
#include "tests/narrowphase/pack_operations.inl"
