// How much memory one call takes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace app {

// Bytes resident at the highest point of `work`, beyond those resident before it. Memory that earlier calls
// freed is first handed back to the system, so that it counts again. None where the system cannot tell (it
// needs Linux's /proc/self/clear_refs).
std::optional<std::int64_t> peak_bytes(const std::function<void()>& work);

}  // namespace app
