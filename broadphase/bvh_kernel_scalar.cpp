#define ONSET_KERNEL bvh_scalar
#include "broadphase/bvh_kernel.inl"
