// The kernel text for any processor.
#define ONSET_KERNEL bvh_scalar
#include "broadphase/bvh/fit.inl"
#include "broadphase/bvh/traversal.inl"
