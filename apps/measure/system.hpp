// What the system tells: how much memory a call takes, and on which machine.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace app {

// Bytes resident at the highest point of `work`, beyond those resident before it. Memory that earlier calls
// freed is first handed back to the system, so that it counts again. None where the system cannot tell (it
// needs Linux's /proc/self/clear_refs).
std::optional<std::int64_t> peak_bytes(const std::function<void()>& work);

// "AMD EPYC 7452 32-Core Processor, 64 cores, onset kernel avx2": the CPU's own name (/proc/cpuinfo), the
// cores that this process may use, the kernel that the library picks.
std::string machine();

}  // namespace app
