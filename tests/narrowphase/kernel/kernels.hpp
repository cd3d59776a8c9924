// The kernels that this machine can run.
#pragma once

#include <vector>

#include "base/instruction_set.hpp"

namespace onset::tests {

inline std::vector<InstructionSet> kernels() {
  std::vector<InstructionSet> all{InstructionSet::scalar};
  if (has_avx2()) all.push_back(InstructionSet::avx2);
  if (has_avx512()) all.push_back(InstructionSet::avx512);
  return all;
}

}  // namespace onset::tests
