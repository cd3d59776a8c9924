#define ONSET_KERNEL bvh_avx2

#include "broadphase/bvh_kernel.inl"
