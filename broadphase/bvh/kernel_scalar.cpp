// The kernel text for any processor.
#define ONSET_ISA bvh_scalar
#include "broadphase/bvh/fit.inl"
#include "broadphase/bvh/traversal.inl"
