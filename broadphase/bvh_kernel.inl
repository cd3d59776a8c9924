// The text of bvh_kernel.hpp, compiled once per instruction set: see base/pack8f.hpp.
#include "broadphase/bvh_fit.inl"
#include "broadphase/bvh_traversal.inl"
