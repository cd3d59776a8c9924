// The machine that figures were measured on.
#pragma once

#include <string>

namespace app {

// "AMD EPYC 7452 32-Core Processor, 64 cores, onset kernel avx2": the CPU's own name (/proc/cpuinfo), the
// cores that this process may use, the kernel that the library picks.
std::string machine();

}  // namespace app
