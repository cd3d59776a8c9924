// The packs for code outside of kernels, which every processor runs. Only source files include this.
#pragma once

#define ONSET_ISA any_processor
#include "base/simd/pack.hpp"
#undef ONSET_ISA

namespace onset {

using any_processor::D4;

}  // namespace onset
