// The kernel text for AVX2; compiled with -mavx2, entered only where the processor has it.
#define ONSET_ISA diagonals_avx2
#include "broadphase/diagonals/write.inl"
