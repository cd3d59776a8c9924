// The kernel text for AVX2; compiled with -mavx2, entered only where the processor has it.
#define ONSET_ISA bvh_avx2
#include "broadphase/bvh/fit.inl"
#include "broadphase/bvh/traversal.inl"
