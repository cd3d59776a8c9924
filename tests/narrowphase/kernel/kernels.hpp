// The kernels that this machine can run.
#pragma once

#include <vector>

#include "base/dispatch.hpp"

namespace onset::tests {

inline std::vector<Kernel> kernels() {
  std::vector<Kernel> all{Kernel::scalar};
  if (has_avx2()) all.push_back(Kernel::avx2);
  return all;
}

}  // namespace onset::tests
