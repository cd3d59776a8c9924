// The kernel text for any processor.
#define ONSET_ISA diagonals_scalar
#include "broadphase/diagonals/write.inl"
