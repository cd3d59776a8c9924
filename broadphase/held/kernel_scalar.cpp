// The kernel text for any processor.
#define ONSET_ISA held_scalar
#include "broadphase/held/pair_test.inl"
